#!/bin/sh
# Makes the folder to ship for Windows, and its archive: dist.sh FOLDER WORK
#
# Leaves FOLDER/bespoke-VERSION-windows-x86_64 and the same as .zip: the same bytes for the same sources on the same
# system. WORK keeps what is built on the way. docs/windows.md says what is in it.
set -eu
# shellcheck source=packaging/windows/environment.sh
. "$(dirname "$0")/environment.sh"
work=$(mkdir -p "$2" && cd "$2" && pwd)

version=$(sed -n 's/^version = "\(.*\)"$/\1/p' Cargo.toml | head -n 1)
name=bespoke-$version-windows-x86_64
stage=$folder/$name
# Git's answers also where the sources belong to somebody else; none where they came without their history.
ours() {
    git -c safe.directory="$root" "$@" 2>/dev/null
}
# The age of every file in the archive: that of the commit. Not told to cargo, which would build anew for each commit.
epoch=${SOURCE_DATE_EPOCH:-$(ours log -1 --format=%ct || stat -c %Y Cargo.toml)}
unset SOURCE_DATE_EPOCH

built=$(sh "$here/library.sh" "$work" --lib --bin bespoke -p bespoke -p bespoke-cli)

rm -rf "$stage"
mkdir -p "$stage/bin" "$stage/lib/cmake/Bespoke" "$stage/include"
cp "$built/bespoke.dll" "$built/bespoke.exe" "$stage/bin/"

echo "windows: import libraries and the program"
# The functions of the header are what the DLL exports; the test compares both with tests/dist/symbols.txt.
{
    echo "LIBRARY bespoke.dll"
    echo EXPORTS
    "${cross}objdump" -p "$stage/bin/bespoke.dll" |
        sed -n '/^\[Ordinal\/Name Pointer\] Table/,/^$/s/.*[[:space:]]\(bespoke_[a-z0-9_]*\)$/    \1/p' | sort
} >"$work/bespoke.def"
cp "$work/bespoke.def" "$stage/lib/bespoke.def"
# In the short form that Microsoft's linker makes itself, and in that of MinGW.
llvm-dlltool -m i386:x86-64 -d "$work/bespoke.def" -D bespoke.dll -l "$stage/lib/bespoke.lib"
"${cross}dlltool" --deterministic-libraries -m i386:x86-64 -d "$work/bespoke.def" -D bespoke.dll -l "$stage/lib/libbespoke.dll.a"
# The printf of MinGW: that of Windows' oldest C library writes other exponents and knows no %zu.
"${cross}gcc-posix" -std=c99 -O2 -D__USE_MINGW_ANSI_STDIO=1 -Iinclude examples_c/*.c -o "$stage/bin/retarget.exe" \
    "$stage/lib/libbespoke.dll.a" -static-libgcc -Wl,--no-insert-timestamp -s

cp include/*.h include/*.hpp "$stage/include/"
sed "s/@FILE@/bespoke.dll/" packaging/windows/BespokeConfig.cmake.in >"$stage/lib/cmake/Bespoke/BespokeConfig.cmake"
sed "s/@VERSION@/$version/g; s/@POINTER_SIZE@/8/g" packaging/BespokeConfigVersion.cmake.in \
    >"$stage/lib/cmake/Bespoke/BespokeConfigVersion.cmake"
for text in *.md LICENSE-MIT LICENSE-APACHE; do
    cp "$text" "$stage/"
done
mkdir "$stage/docs"
find docs -maxdepth 1 -type f -exec cp {} "$stage/docs/" \;
# What a plugin author reads and copies from: the files of the project, without what was built among them.
for sources in examples_c bindings; do
    [ -d "$sources" ] || continue
    { ours ls-files -z "$sources" || find "$sources" -type f -print0; } | xargs -0 cp --parents -t "$stage"
done
sh packaging/dist/licences.sh build/dist/sources "$stage/licences" windows

archive=$folder/$name.zip
find "$stage" -exec touch -h -d "@$epoch" {} +
rm -f "$archive.new.zip"
(cd "$folder" && find "$name" -type f | sort | TZ=UTC zip -q -X -9 "$archive.new.zip" -@)
mv "$archive.new.zip" "$archive"
for file in "$stage"/bin/*; do
    loads=$("${cross}objdump" -p "$file" | sed -n 's/^.*DLL Name: //p' | sort -f | tr '\n' ' ')
    echo "windows: ${file##*/}: $(wc -c <"$file") bytes; loads $loads"
done
echo "windows: $archive"
echo "windows: $(wc -c <"$archive") bytes, SHA-256 $(sha256sum <"$archive" | cut -d ' ' -f 1)"
