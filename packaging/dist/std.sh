#!/bin/sh
# Sees that Rust's standard library for another system is at hand: std.sh FOLDER TARGET
#
# Says as its last line with which `--sysroot` rustc finds it, or nothing where the toolchain has it itself. Where rustup
# cannot bring it, it is built once into FOLDER, from the sources of the very version of rustc that is used, which Debian
# has as a package. Ends with 77 where it cannot be had.
set -eu
export LC_ALL=C
target=$2
mkdir -p "$1"
folder=$(cd "$1" && pwd)
here=$(cd "$(dirname "$0")" && pwd)

has_std() {
    ls "$("$@" --print target-libdir --target "$target")"/libstd-*.rlib >/dev/null 2>&1
}
has_std rustc && exit 0
# It may say that it has it already, where somebody has taken the files away.
if command -v rustup >/dev/null 2>&1 && rustup target add "$target" >"$folder/rustup.log" 2>&1 && has_std rustc; then
    exit 0
fi

version=$(rustc --version | cut -d ' ' -f 2)
sysroot=$folder/sysroot-$version
if has_std rustc --sysroot "$sysroot"; then
    echo "$sysroot"
    exit 0
fi

# Debian's package rust-src of that version, from whichever suite has it; unpacked here, never installed.
fetch() {
    keyring=/usr/share/keyrings/debian-archive-keyring.gpg
    if ! command -v apt-get >/dev/null 2>&1 || [ ! -f "$keyring" ]; then
        return 1
    fi
    # What stands in braces is for apt to fill in.
    # shellcheck disable=SC2016
    uri=$(apt-get indextargets --format '$(REPO_URI)' 'Origin: Debian' 'Codename: bookworm' 'Component: main' \
        'Created-By: Packages' | head -n 1)
    mkdir -p "$folder/apt/lists/partial" "$folder/apt/cache/archives/partial"
    : >"$folder/apt/status"
    for suite in trixie-backports forky sid; do
        echo "deb [signed-by=$keyring] ${uri:-http://deb.debian.org/debian} $suite main" >"$folder/apt/sources.list"
        set -- -o "Dir::Etc::sourcelist=$folder/apt/sources.list" -o Dir::Etc::sourceparts=- \
            -o "Dir::State::lists=$folder/apt/lists" -o "Dir::State::status=$folder/apt/status" \
            -o "Dir::Cache=$folder/apt/cache" -o APT::Sandbox::User="$(id -un)" -o Acquire::Languages=none
        apt-get -qq "$@" update || continue
        found=$(apt-cache "$@" madison rust-src | awk -F ' *[|] *' -v want="$version+" 'index($2, want) == 1 { print $2; exit }')
        [ -n "$found" ] || continue
        (cd "$folder" && apt-get -qq "$@" download "rust-src=$found") && return 0
    done
    return 1
}
sources=$folder/source-$version
if [ ! -f "$sources/.unpacked" ]; then
    if ! fetch >&2; then
        echo "std: neither rustup nor Debian has Rust's standard library $version for $target" >&2
        exit 77
    fi
    rm -rf "$sources"
    dpkg -x "$folder"/rust-src_"$version"*.deb "$sources"
    touch "$sources/.unpacked"
fi
# Where the package has it; other folders of that name are of tests.
library=$(find "$sources/usr/src" -maxdepth 1 -name 'rustc-*')
if [ ! -d "$library/library/std" ]; then
    echo "std: Debian's rust-src $version has no standard library in $sources/usr/src" >&2
    exit 1
fi

echo "std: Rust's standard library for $target, once" >&2
# A toolchain like the one that is used, with the sources where cargo looks for them.
toolchain=$folder/toolchain-$version
rm -rf "$toolchain"
cp -al "$(rustc --print sysroot)" "$toolchain" 2>/dev/null || { rm -rf "$toolchain"; cp -a "$(rustc --print sysroot)" "$toolchain"; }
mkdir -p "$toolchain/lib/rustlib/src"
ln -sfn "$library" "$toolchain/lib/rustlib/src/rust"
rm -rf "$folder/empty"
cp -r "$here/empty" "$folder/empty"
(
    cd "$folder/empty"
    PATH=$toolchain/bin:$PATH RUSTC=$toolchain/bin/rustc RUSTC_BOOTSTRAP=1 CARGO_TARGET_DIR=$folder/built \
        CARGO_ENCODED_RUSTFLAGS="--remap-path-prefix=$library=rust" \
        "$toolchain/bin/cargo" build --release -Z build-std=std,panic_unwind --target "$target" >&2
)
place=$sysroot.new/lib/rustlib/$target/lib
rm -rf "$sysroot.new" "$sysroot"
mkdir -p "$place"
cp "$folder/built/$target/release/deps"/*.rlib "$place"
rm -f "$place"/libempty-*.rlib
# What is linked before and after everything else, on Windows.
parts="rsbegin rsend"
case $target in *-windows-gnu) ;; *) parts="" ;; esac
for part in $parts; do
    RUSTC_BOOTSTRAP=1 rustc --target "$target" --crate-type rlib --emit=obj="$place/$part.o" "$library/library/rtstartup/$part.rs"
done
mv "$sysroot.new" "$sysroot"
rm -rf "$folder/built" "$toolchain"
echo "$sysroot"
