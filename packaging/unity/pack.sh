#!/bin/sh
# Makes the Unity package: pack.sh SHIPPED WINDOWS FOLDER
#
# SHIPPED is the folder that `make dist` has made, WINDOWS the one of `make dist-windows`, or none (a path that is not there). Leaves
# FOLDER/NAME, which can be added to a project from disk, and the same as NAME-VERSION.tgz, made by `npm pack`, for "Add package from
# tarball". Every path has a .meta file: the same one in every package, for its GUID follows from the path.
set -eu
umask 022
export LC_ALL=C
root=$(cd "$(dirname "$0")/../.." && pwd)
here=$root/packaging/unity
shipped=$(cd "$1" && pwd)
windows=$2
case $windows in /*) ;; *) windows=$(pwd)/$windows ;; esac
mkdir -p "$3"
folder=$(cd "$3" && pwd)

version=$(sed -n 's/^version = "\(.*\)"$/\1/p' "$root/Cargo.toml" | head -n 1)
name=$(sed -n 's/^ *"name": "\(com\.[^"]*\)".*/\1/p' "$root/bindings/unity/package.json")
stage=$folder/$name
rm -rf "$stage" "$folder"/*.tgz
mkdir -p "$stage/Runtime/Binding" "$stage/Documentation~"

cd "$root/bindings/unity"
find . -type f ! -name '*.meta' -print0 | xargs -0 cp --parents -t "$stage"
sed -i "s/^\( *\"version\": \)\"[^\"]*\"/\1\"$version\"/" "$stage/package.json"
# The binding as it is, and the pages that the window shows.
cp "$root"/bindings/csharp/Bespoke/*.cs "$root"/bindings/csharp/Bespoke/*.asmdef "$stage/Runtime/Binding"
cp "$root/docs/troubleshooting.md" "$root/docs/options.md" "$stage/Documentation~"
for licence in MIT APACHE; do cp "$root/LICENSE-$licence" "$stage/LICENSE-$licence.md"; done
# What is inside of the library; a folder that ends in ~ is none of the engine's assets.
[ ! -d "$shipped/licences" ] || cp -r "$shipped/licences" "$stage/Licences~"

plugins=$stage/Runtime/Plugins
mkdir -p "$plugins/Linux/x86_64"
cp "$(readlink -f "$shipped/lib/libbespoke.so")" "$plugins/Linux/x86_64/libbespoke.so"
library=$(find "$windows" -name bespoke.dll 2>/dev/null | head -n 1)
if [ -n "$library" ]; then
    mkdir -p "$plugins/Windows/x86_64"
    cp "$library" "$plugins/Windows/x86_64/bespoke.dll"
else
    echo "skipped: the Windows library in the Unity package, for there is no bespoke.dll in $2 (make dist-windows)" >&2
fi
chmod -R u=rwX,go=rX "$stage"
sh "$here/meta.sh" "$stage" "$name"

if ! command -v npm >/dev/null 2>&1; then
    echo "skipped: the tarball of the Unity package, for there is no npm; $stage can be added from disk" >&2
    exit
fi
cd "$folder"
npm pack --silent --ignore-scripts "./$name" >/dev/null
echo "unity: $folder/$name-$version.tgz, $(wc -c <"$folder/$name-$version.tgz") bytes"
