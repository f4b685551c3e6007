# Read by the scripts here that build: what comes out does not depend on what the caller prefers. `$1` is their FOLDER; sets
# root, here, folder and cross, the prefix of MinGW's tools, and goes to the first of them.
umask 022
export LC_ALL=C
unset CFLAGS CXXFLAGS MAKEFLAGS MFLAGS CARGO_BUILD_TARGET OPENVDB_ROOT
root=$(cd "$(dirname "$0")/../.." && pwd)
here=$root/packaging/windows
cross=x86_64-w64-mingw32-
mkdir -p "$1"
folder=$(cd "$1" && pwd)
cd "$root"
