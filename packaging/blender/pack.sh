#!/bin/sh
# Makes the Blender extension, a zip with the wheel inside: pack.sh ENVIRONMENT WHEELS FOLDER
#
# ENVIRONMENT is what environment.sh has made, WHEELS the folder with the wheel that wheel.sh has made. Blender's own tool judges and
# packs it. Leaves one zip in FOLDER and prints its path.
set -eu
umask 022
export LC_ALL=C
root=$(cd "$(dirname "$0")/../.." && pwd)
python=$1/bin/python
wheel=$(echo "$2"/*.whl)
[ -f "$wheel" ] || { echo "blender: there is no wheel in $2, or several; make wheel makes it" >&2; exit 1; }
tool=$(echo "$1"/lib/python*/site-packages/bpy/*/scripts/addons_core/bl_pkg/cli/blender_ext.py)
[ -f "$tool" ] || { echo "blender: there is no Blender in $1" >&2; exit 1; }
mkdir -p "$3"
folder=$(cd "$3" && pwd)

version=$(sed -n 's/^version = "\(.*\)"$/\1/p' "$root/Cargo.toml" | head -n 1)
stage=$folder/stage
rm -rf "$stage" "$folder"/*.zip
mkdir -p "$stage/wheels"
cp "$root"/bindings/blender/extension/*.py "$stage"
cp "$wheel" "$stage/wheels"
cp "$root/docs/troubleshooting.md" "$root/LICENSE-MIT" "$root/LICENSE-APACHE" "$stage"
sed -e "s|^version = .*|version = \"$version\"|" -e "s|^wheels = .*|wheels = [\"./wheels/$(basename "$wheel")\"]|" \
    -e '/^#/d' "$root/bindings/blender/extension/blender_manifest.toml" >"$stage/blender_manifest.toml"

# Which tags there are is in another file of Blender's.
tags=$(dirname "$tool")/../../../modules/_bpy_internal/extensions/tags.py
set --
[ ! -f "$tags" ] || set -- --valid-tags "$tags"
"$python" "$tool" validate "$@" "$stage" >&2
"$python" "$tool" build "$@" --source-dir "$stage" --output-dir "$folder" >&2
rm -rf "$stage"
zip=$(echo "$folder"/*.zip)
"$python" "$tool" validate "$zip" >&2
echo "blender: $(wc -c <"$zip") bytes" >&2
echo "$zip"
