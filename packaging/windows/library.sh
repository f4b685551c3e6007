#!/bin/sh
# Builds the library for Windows, with OpenVDB, oneTBB and the C++ runtime inside: library.sh FOLDER [cargo's arguments]
#
# FOLDER gets the static libraries and, where rustup cannot bring it, Rust's standard library. Leaves what cargo made
# where the last line says. Arguments replace `--lib`: what else to build.
set -eu
# shellcheck source=packaging/windows/environment.sh
. "$(dirname "$0")/environment.sh"
shift

sh packaging/dist/sources.sh build/dist/sources >&2
echo "windows: OpenVDB and oneTBB as static libraries" >&2
make --silent -f packaging/dist/static.mk -j"$(nproc)" SOURCES=build/dist/sources OUT="$folder/static" CROSS="$cross" >&2

sysroot=$(sh packaging/dist/std.sh "$folder/rust" x86_64-pc-windows-gnu)
echo "windows: the library" >&2
# As packaging/dist/library.sh: sentences of a defect name places in the sources as they are called everywhere.
cargo=${CARGO_HOME:-$HOME/.cargo}
flags=$(printf -- '--remap-path-prefix=%s\037' "$cargo=cargo" "$(rustc --print sysroot)=rust" "$root=bespoke")
[ -z "$sysroot" ] || flags=$(printf -- '%s--sysroot\037%s\037' "$flags" "$sysroot")
export CARGO_TARGET_X86_64_PC_WINDOWS_GNU_LINKER="${cross}gcc-posix"
export CXX_x86_64_pc_windows_gnu="${cross}g++-posix" AR_x86_64_pc_windows_gnu="${cross}ar"
[ $# -gt 0 ] || set -- --lib
CARGO_ENCODED_RUSTFLAGS=${flags%?} BESPOKE_STATIC_OPENVDB=$folder/static \
    cargo build --locked --profile dist --target x86_64-pc-windows-gnu "$@" >&2
realpath "${CARGO_TARGET_DIR:-target}/x86_64-pc-windows-gnu/dist"
