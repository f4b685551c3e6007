#!/bin/sh
# Builds with cargo what is shipped: cargo.sh FOLDER ARGUMENTS...
#
# FOLDER is that of library.sh, which has made the static libraries in it. The arguments say what is built; library and program
# are made of the same crates, each built once.
set -eu
# shellcheck source=packaging/dist/environment.sh
. "$(dirname "$0")/environment.sh"
shift

# The C library of the VFX Reference Platform since 2023, and of RHEL 8.
if [ "$machine" = x86_64 ]; then
    sh "$here/floor/stubs.sh" "$folder/floor" 2.28
    export BESPOKE_GLIBC_FLOOR="$folder/floor"
fi
# Sentences of a defect name places in the sources: as they are called everywhere, not as on this machine. The flags are
# apart by a character that no path has.
cargo=${CARGO_HOME:-$HOME/.cargo}
sysroot=$(rustc --print sysroot)
flags=$(printf -- '--remap-path-prefix=%s\037' "$cargo=cargo" "$sysroot=rust" "$root=bespoke")
if [ -n "$target" ]; then
    std=$(sh "$here/std.sh" "$folder/rust" "$target")
    [ -z "$std" ] || flags=$(printf -- '%s--sysroot\037%s\037' "$flags" "$std")
    flags=$(printf -- '%s-Clinker=%s\037' "$flags" "$CC")
    set -- --target "$target" "$@"
fi
CARGO_ENCODED_RUSTFLAGS=${flags%?} BESPOKE_STATIC_OPENVDB=$static cargo build --locked --profile dist "$@" >&2
