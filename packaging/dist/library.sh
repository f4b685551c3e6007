#!/bin/sh
# Builds the library with OpenVDB, oneTBB and the C++ runtime inside: library.sh FOLDER
#
# FOLDER gets the sources and the static libraries. Leaves the library where its last line says.
set -eu
# shellcheck source=packaging/dist/environment.sh
. "$(dirname "$0")/environment.sh"

sh "$here/sources.sh" "$folder/sources" >&2
echo "dist: OpenVDB and oneTBB as static libraries" >&2
make --silent -f "$here/static.mk" -j"$(nproc)" SOURCES="$folder/sources" OUT="$folder/static" >&2

# The C library of the VFX Reference Platform since 2023, and of RHEL 8.
if [ "$(uname -m)" = x86_64 ]; then
    sh "$here/floor/stubs.sh" "$folder/floor" 2.28
    export BESPOKE_GLIBC_FLOOR="$folder/floor"
fi

echo "dist: the library" >&2
# Sentences of a defect name places in the sources: as they are called everywhere, not as on this machine. The flags are
# apart by a character that no path has.
cargo=${CARGO_HOME:-$HOME/.cargo}
sysroot=$(rustc --print sysroot)
flags=$(printf -- '--remap-path-prefix=%s\037' "$cargo=cargo" "$sysroot=rust" "$root=bespoke")
touch "$folder/asked"
CARGO_ENCODED_RUSTFLAGS=${flags%?} BESPOKE_STATIC_OPENVDB=$folder/static cargo build --locked --profile dist --lib >&2
# The date since which no source has changed.
mv "$folder/asked" "$folder/fresh"
realpath "${CARGO_TARGET_DIR:-target}/dist/libbespoke.so"
