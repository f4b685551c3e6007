// Preprocessed by build.rs to check for the headers before the long compilation.
// Debian's package of OpenVDB does not depend on the Boost headers that Math.h includes.
#include <openvdb/math/Math.h>
#include <openvdb/version.h>
#include <tbb/version.h>

#if OPENVDB_LIBRARY_MAJOR_VERSION_NUMBER < 10
#error "OpenVDB 10 or later is needed"
#endif
