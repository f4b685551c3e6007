# Read by the scripts here that build: what comes out does not depend on what the caller prefers. `$1` is their FOLDER; sets
# root, here and folder, and goes to the first of them. MACHINE, such as aarch64, is the one it is built for, where that is
# another than this one: sets machine, and for another tools (the prefix of its compiler) and target (cargo's word for it).
umask 022
export LC_ALL=C
unset CFLAGS CXXFLAGS MAKEFLAGS MFLAGS CARGO_BUILD_TARGET OPENVDB_ROOT
machine=${MACHINE:-$(uname -m)}
tools="" target="" static=static
export CC=cc CXX=c++
if [ "$machine" != "$(uname -m)" ]; then
    tools=$machine-linux-gnu- target=$machine-unknown-linux-gnu static=static-$machine
    export CC="${tools}gcc" CXX="${tools}g++" AR="${tools}ar" STRIP="${tools}strip"
fi
root=$(cd "$(dirname "$0")/../.." && pwd)
here=$root/packaging/dist
mkdir -p "$1"
folder=$(cd "$1" && pwd)
cd "$root"
static=$folder/$static
# Where cargo puts what is shipped.
built=${CARGO_TARGET_DIR:-target}/${target:+$target/}dist
