// Preprocessed by build.rs to find out whether the headers are there, before the long compilation.
// Debian's package of OpenVDB does not pull in the Boost headers that Math.h asks for.
#include <openvdb/math/Math.h>
#include <openvdb/version.h>
#include <tbb/version.h>

#if OPENVDB_LIBRARY_MAJOR_VERSION_NUMBER < 10
#error "OpenVDB 10 or later is needed"
#endif
