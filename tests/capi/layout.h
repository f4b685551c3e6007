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
/* Not through PINNED, which would see the number in place of the name of a constant. */
#ifdef __cplusplus
#define VALUE(name, number) static_assert(name == number, "the value differs: " #name);
#else
#define VALUE(name, number) typedef char pinned_##name[(name == number) ? 1 : -1];
#endif
#include "layout.inc"
#undef STRUCT
#undef FIELD
#undef VALUE
