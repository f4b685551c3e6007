#!/bin/sh
# Prints which library is to be installed: library.sh OPENVDB BUILT SOURCE...
#
# OPENVDB is `inside` or `system`; BUILT is the library that `make` has built over the system's OpenVDB, and SOURCE what a
# library is built from. With `inside` it is the one that the folder to ship has, built where it is older than a source;
# where that cannot be done, BUILT, with a word about it.
set -eu
openvdb=$1 built=$2
shift 2
case $openvdb in
system)
    echo "$built"
    exit
    ;;
inside) ;;
*)
    echo "library.sh: OPENVDB is \"$openvdb\", and can be inside or system" >&2
    exit 1
    ;;
esac
root=$(dirname "$0")/..
library=${CARGO_TARGET_DIR:-target}/dist/libbespoke.so
# Not built again where nothing is newer: root may have no cargo, and is not to build.
if [ -f "$library" ] && [ -z "$(find "$@" -newer "$root/build/dist/fresh" 2>&1)" ]; then
    echo "$library"
    exit
fi
why="there is no cargo"
if command -v cargo >/dev/null 2>&1; then
    why="a library with OpenVDB inside could not be built"
    if sh "$root/packaging/dist/library.sh" "$root/build/dist"; then
        exit
    fi
fi
echo "install: $why, so what is installed loads the system's OpenVDB. Debian's brings a logger that starts four threads" \
    "when it is loaded, and ends the process where it cannot; OPENVDB=system asks for it without these words" >&2
echo "$built"
