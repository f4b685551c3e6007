# Read by the scripts here that build: what comes out does not depend on what the caller prefers. `$1` is their FOLDER; sets
# root, here and folder, and goes to the first of them.
umask 022
export LC_ALL=C
unset CFLAGS CXXFLAGS MAKEFLAGS MFLAGS CARGO_BUILD_TARGET OPENVDB_ROOT
export CC=cc CXX=c++
root=$(cd "$(dirname "$0")/../.." && pwd)
here=$root/packaging/dist
mkdir -p "$1"
folder=$(cd "$1" && pwd)
cd "$root"
