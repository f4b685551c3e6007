#!/bin/sh
# Makes the folder to ship, and its archive: dist.sh FOLDER
#
# Leaves FOLDER/bespoke-VERSION-linux-MACHINE and the same as .tar.gz: the same bytes for the same sources on the same
# system. docs/dist.md says what is in it and why it is built in this way.
set -eu
# shellcheck source=packaging/dist/environment.sh
. "$(dirname "$0")/environment.sh"

if [ "$(uname)" != Linux ]; then
    echo "dist: only Linux has a folder to ship so far" >&2
    exit 1
fi
version=$(sed -n 's/^version = "\(.*\)"$/\1/p' Cargo.toml | head -n 1)
name=bespoke-$version-linux-$machine
stage=$folder/$name
# Git's answers also where the sources belong to somebody else; none where they came without their history.
ours() {
    git -c safe.directory="$root" "$@" 2>/dev/null
}
# The age of every file in the archive: that of the commit.
epoch=${SOURCE_DATE_EPOCH:-$(ours log -1 --format=%ct || stat -c %Y Cargo.toml)}
export SOURCE_DATE_EPOCH="$epoch"

library=$(sh "$here/library.sh" "$folder")

echo "dist: the programs"
sh "$here/cargo.sh" "$folder" -p bespoke-cli
# What the linker looks for by its plain name, the loader by the name within.
link=$folder/link${tools:+-$machine}
mkdir -p "$link"
ln -sf "$library" "$link/libbespoke.so"
floor=""
# The older C library has what the library asks for in other files; that it is there says stubs.sh.
[ "$machine" != x86_64 ] || floor="-L$folder/floor -lfloor -Wl,--allow-shlib-undefined"
# The flags are words.
# shellcheck disable=SC2016,SC2086
"$CC" -std=c99 -O2 -Iinclude examples_c/*.c -o "$link/retarget" -L"$link" -lbespoke -lm $floor \
    '-Wl,-rpath,$ORIGIN/../lib'

rm -rf "$stage"
env -u DESTDIR -u BINDIR -u LIBDIR -u INCLUDEDIR PREFIX="$stage" DOCDIR="$stage" \
    sh packaging/install.sh install "$library" "$link/retarget"
install -m 755 "$built/bespoke" "$stage/bin/bespoke"
# What a plugin author reads and copies from: the files of the project, without what was built among them.
for sources in examples_c bindings; do
    [ -d "$sources" ] || continue
    { ours ls-files -z "$sources" || find "$sources" -type f -print0; } | xargs -0 cp --parents -t "$stage"
done
sh "$here/licences.sh" "$folder/sources" "$stage/licences"

archive=$folder/$name.tar.gz
# Without the name and the date that gzip would put in.
tar -C "$folder" --sort=name --owner=0 --group=0 --numeric-owner --mtime="@$epoch" --mode=u+rw,go+r,go-w --format=gnu \
    -cf - "$name" | gzip -9n >"$archive.new"
mv "$archive.new" "$archive"
OBJDUMP=${tools}objdump sh "$here/needs.sh" "$stage"
echo "dist: $archive"
echo "dist: $(wc -c <"$archive") bytes, SHA-256 $(sha256sum <"$archive" | cut -d ' ' -f 1)"
