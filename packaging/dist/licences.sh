#!/bin/sh
# Gathers the licences of everything that is inside the shipped library and programs: licences.sh SOURCES FOLDER [windows]
#
# SOURCES is what sources.sh left. FOLDER gets README.md, which lists all parts, and a folder with texts for each. A
# part without a text is an error: an answer to it is a line in licences/crates.txt.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
sources=$1
folder=$2
rm -rf "$folder"
mkdir -p "$folder/crates"

# part NAME VERSION LICENCE SOURCE FILE...: a part that is no crate, with its texts
part() {
    name=$1
    line="| $1 | $2 | $3 | $4 |"
    shift 4
    mkdir "$folder/$name"
    for text in "$@"; do
        if [ ! -s "$text" ]; then
            echo "licences: $name has no text in $text" >&2
            exit 1
        fi
        cp -L "$text" "$folder/$name/"
        chmod 644 "$folder/$name/${text##*/}"
    done
    echo "$line"
}

# The only archive of that package that sources.sh lets through.
version() { # PACKAGE
    archive=$(cd "$sources" && ls "$1"_*.orig.tar.xz)
    archive=${archive#*_}
    echo "${archive%.orig.tar.xz}"
}

debian=https://snapshot.debian.org/package
boost=$(dpkg -S /usr/include/boost/version.hpp | cut -d : -f 1)
gcc=$(basename "$(dirname "$(c++ -print-file-name=libstdc++.a)")")
sysroot=$(rustc --print sysroot)
{
    # The programs of Windows have the same inside, and crates of their own.
    if [ "${3:-}" = windows ]; then
        sed 's/libbespoke\.so/bespoke.dll, bespoke.exe and retarget.exe/; s/its shared library/them/' "$here/licences/head.md"
    else
        cat "$here/licences/head.md"
    fi
    part openvdb "$(version openvdb)" MPL-2.0 \
        "source: $debian/openvdb (\`openvdb_$(version openvdb).orig.tar.xz\`), unchanged; <https://www.openvdb.org>" \
        "$sources/openvdb/LICENSE"
    # The notice at the head of its sources is the licence of OpenVDB's half floats.
    half=$sources/openvdb/openvdb/openvdb/math/Half.h
    sed -n '1,/^\/*$/d; /^\/\/\/\//q; s/^\/\/ \{0,1\}//p' "$half" >"$folder/LICENSE"
    part half "as in OpenVDB" BSD-3-Clause "\`openvdb/math/Half.h\` of OpenVDB" "$folder/LICENSE"
    rm "$folder/LICENSE"
    part onetbb "$(version onetbb)" Apache-2.0 "$debian/onetbb, <https://github.com/uxlfoundation/oneTBB>" \
        "$sources/onetbb/LICENSE.txt" "$sources/onetbb/third-party-programs.txt"
    number=$(sed -n 's/^#define BOOST_LIB_VERSION "\(.*\)"/\1/p' /usr/include/boost/version.hpp | tr _ .)
    part boost "$number" BSL-1.0 \
        "headers that OpenVDB uses; <https://www.boost.org>" "/usr/share/doc/$boost/copyright"
    if [ "${3:-}" = windows ]; then
        mingw=$(dpkg-query --show --showformat '${Version}' mingw-w64-x86-64-dev)
        part mingw-w64 "$mingw" "ZPL-2.1, MIT and others for parts" "<https://www.mingw-w64.org>" \
            /usr/share/doc/mingw-w64-x86-64-dev/copyright
    fi
    part libstdc++ "$gcc" "GPL-3.0 with the GCC Runtime Library Exception 3.1" "<https://gcc.gnu.org>" \
        "/usr/share/doc/gcc-$gcc-base/copyright" /usr/share/common-licenses/GPL-3
    part rust "$(rustc --version | cut -d ' ' -f 2)" "MIT OR Apache-2.0, and others for parts" \
        "<https://www.rust-lang.org>" "$sysroot/share/doc/rust/COPYRIGHT-library.html"
    set -- ${3:+--target x86_64-pc-windows-gnu} --package bespoke --package bespoke-cli
    cargo tree "$@" --locked --edges normal --prefix none --format '{p}|{l}' >"$folder/tree"
    sed '/^$/d; s/ (\*)$//; s/ (proc-macro)//' "$folder/tree" | sort -u | while IFS='|' read -r crate licence; do
        name=${crate%% *}
        number=${crate#* v}
        # Those of this project.
        case $name in bespoke | bespoke-cli | bespoke-gltf) continue ;; esac
        package=$(find "${CARGO_HOME:-$HOME/.cargo}/registry/src" -maxdepth 2 -type d -name "$name-$number" | head -n 1)
        if [ -z "$package" ]; then
            echo "licences: the sources of $name $number are not in cargo's registry; run cargo fetch" >&2
            exit 1
        fi
        mkdir "$folder/crates/$name-$number"
        find "$package" -maxdepth 1 -type f \( -iname 'licen*' -o -iname 'copying*' -o -iname 'notice*' \) \
            -exec cp {} "$folder/crates/$name-$number/" \;
        # A text of its own replaces the one for those without.
        instead=$(sed -n "s/^$name //p" "$here/licences/crates.txt")
        if [ -n "$instead" ] && [ ! -f "$package/LICENSE" ]; then
            cp "$here/licences/$instead" "$folder/crates/$name-$number/LICENSE"
        fi
        if [ -z "$(ls "$folder/crates/$name-$number")" ]; then
            echo "licences: the crate $name $number has no text of its licence ($licence);" \
                "give it one in packaging/dist/licences/crates.txt" >&2
            exit 1
        fi
        chmod 644 "$folder/crates/$name-$number"/*
        echo "| $name | $number | $licence | <https://crates.io/crates/$name/$number> |"
    done
    rm "$folder/tree"
} >"$folder.new"
mv "$folder.new" "$folder/README.md"
