/* Proves tests/capi/layout.inc while it is compiled, as C99 and as C++17. */
#include "bespoke.h"

#ifdef __cplusplus
#define PINNED(name, condition) static_assert(condition, "the layout differs: " #name)
#else
#define PINNED(name, condition) typedef char pinned_##name[(condition) ? 1 : -1]
#endif

#define STRUCT(type, size) PINNED(type, sizeof(type) == size);
#define FIELD(type, field, offset, size) \
    PINNED(type##_##field, offsetof(type, field) == offset && sizeof(((type *)0)->field) == size);
#define VALUE(name, number) PINNED(name, name == number);
#include "layout.inc"
#undef STRUCT
#undef FIELD
#undef VALUE
