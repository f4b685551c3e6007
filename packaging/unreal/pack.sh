#!/bin/sh
# Makes the Unreal plugin: pack.sh SHIPPED WINDOWS FOLDER
#
# SHIPPED is the folder that `make dist` has made, WINDOWS the one of `make dist-windows`, or none (a path that is not there). Leaves
# FOLDER/Bespoke, to be put into the folder Plugins of a project: sources, the library, and the Python package beside the script for the
# editor's Python.
set -eu
umask 022
export LC_ALL=C
root=$(cd "$(dirname "$0")/../.." && pwd)
shipped=$(cd "$1" && pwd)
windows=$2
case $windows in /*) ;; *) windows=$(pwd)/$windows ;; esac
mkdir -p "$3"
plugin=$(cd "$3" && pwd)/Bespoke

version=$(sed -n 's/^version = "\(.*\)"$/\1/p' "$root/Cargo.toml" | head -n 1)
abi=$(sed -n 's/^.define BESPOKE_ABI_VERSION //p' "$root/include/bespoke.h")
rm -rf "$plugin"
mkdir -p "$plugin/Resources"
cd "$root/bindings/unreal/Bespoke"
find . -type f ! -name '*.pyc' -print0 | xargs -0 cp --parents -t "$plugin"
sed -i "s/^\( *\"VersionName\": \)\"[^\"]*\"/\1\"$version\"/" "$plugin/Bespoke.uplugin"
cp "$root/bindings/unreal/README.md" "$root/LICENSE-MIT" "$root/LICENSE-APACHE" "$plugin"
cp "$root/docs/troubleshooting.md" "$root/docs/options.md" "$plugin/Resources"
[ ! -d "$shipped/licences" ] || cp -r "$shipped/licences" "$plugin"

third=$plugin/Source/ThirdParty/BespokeLibrary
mkdir -p "$third/include" "$third/lib/Linux"
cp "$root/include/bespoke.h" "$root/include/bespoke.hpp" "$third/include"
library=$(readlink -f "$shipped/lib/libbespoke.so")
# No links: archives and version control of projects lose them.
cp "$library" "$third/lib/Linux/libbespoke.so"
cp "$library" "$third/lib/Linux/libbespoke.so.$abi"

python=$plugin/Content/Python/bespoke
mkdir -p "$python"
cp "$root"/bindings/python/src/bespoke/*.py "$root/bindings/python/src/bespoke/py.typed" "$python"
cp "$library" "$python/libbespoke.so"

dll=$(find "$windows" -name bespoke.dll 2>/dev/null | head -n 1)
import=$(find "$windows" -name bespoke.lib 2>/dev/null | head -n 1)
if [ -n "$dll" ]; then
    mkdir -p "$third/lib/Win64"
    cp "$dll" "$third/lib/Win64/bespoke.dll"
    cp "$dll" "$python/bespoke.dll"
    [ -z "$import" ] || cp "$import" "$third/lib/Win64/bespoke.lib"
    [ -n "$import" ] || echo "skipped: C++ on Windows in the Unreal plugin, for there is no bespoke.lib in $2" >&2
else
    echo "skipped: the Windows library in the Unreal plugin, for there is no bespoke.dll in $2 (make dist-windows)" >&2
fi
chmod -R u=rwX,go=rX "$plugin"
echo "unreal: $plugin"
