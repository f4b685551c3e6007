#!/bin/sh
# Builds the add-on and puts it together as it goes into a project: build.sh LIBRARY FOLDER
#
# LIBRARY is libbespoke.so, best that of `make dist`, which brings all it needs. Left is FOLDER/addons/bespoke.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
top=$here/../..
folder=$(cd "$(dirname "$1")" && pwd)
library=$folder/$(basename "$1")
abi=$(sed -n 's/^.define BESPOKE_ABI_VERSION //p' "$top/include/bespoke.h")
target=$top/build/godot-target
BESPOKE_LIBRARY=$folder cargo build --release --locked --manifest-path "$here/Cargo.toml" --target-dir "$target"

addon=$2/addons/bespoke
rm -rf "$addon.new"
mkdir -p "$addon.new/bin" "$addon.new/docs"
cp -r "$here/addons/bespoke/." "$addon.new"
cp -L "$library" "$addon.new/bin/libbespoke.so.$abi"
cp "$target/release/libbespoke_godot.so" "$addon.new/bin"
cp "$top/LICENSE-MIT" "$top/LICENSE-APACHE" "$addon.new"
cp "$top/docs/troubleshooting.md" "$top/docs/options.md" "$addon.new/docs"
# The page without what is about the project around it.
sed -e 's#(../../docs/#(docs/#' -e '/^## How it is made/,$d' "$here/README.md" >"$addon.new/README.md"
# The engine is not to look in there.
touch "$addon.new/docs/.gdignore"
rm -rf "$addon"
mv "$addon.new" "$addon"
