#!/bin/sh
# Makes the Python wheel out of the folder to ship: wheel.sh PYTHON SHIPPED FOLDER
#
# PYTHON is an interpreter that has hatchling, SHIPPED the folder that dist.sh has made. Leaves one wheel in FOLDER, for every
# CPython from 3.9 on, and prints its path. The same commit gives the same bytes on the same system.
set -eu
umask 022
export LC_ALL=C
root=$(cd "$(dirname "$0")/../.." && pwd)
python=$(command -v "$1") || { echo "wheel: there is no $1; make python-environment makes one" >&2; exit 1; }
python=$(cd "$(dirname "$python")" && pwd)/$(basename "$python")
shipped=$(cd "$2" && pwd)
mkdir -p "$3"
folder=$(cd "$3" && pwd)

library=$(readlink -f "$shipped/lib/libbespoke.so")
version=$(sed -n 's/^version = "\(.*\)"$/\1/p' "$root/Cargo.toml" | head -n 1)
# The oldest C library that has all that is asked for: the platform of the wheel.
glibc=$(for file in "$library" "$shipped/bin/bespoke"; do objdump -T "$file"; done | sed -n 's/.*(\{0,1\}GLIBC_\([0-9.]*\))\{0,1\} .*/\1/p' | sort -uV | tail -n 1)
machine=$(uname -m)

stage=$folder/stage
rm -rf "$stage"
mkdir -p "$stage/src/bespoke"
cd "$root/bindings/python"
cp pyproject.toml hatch_build.py README.md "$stage"
find src -name '*.py' -o -name py.typed | xargs cp --parents -t "$stage"
cp "$library" "$stage/src/bespoke/libbespoke.so"
chmod 755 "$stage/src/bespoke/libbespoke.so"
install -D -m 755 "$shipped/bin/bespoke" "$stage/src/bespoke/bin/bespoke"
cp "$root/LICENSE-MIT" "$root/LICENSE-APACHE" "$stage"
cp -r "$shipped/licences" "$stage"

cd "$stage"
rm -f "$folder"/*.whl
# The age of every file in it: that of the commit, as in the archive.
epoch=$(git -C "$root" -c safe.directory="$root" log -1 --format=%ct 2>/dev/null || stat -c %Y "$root/Cargo.toml")
SOURCE_DATE_EPOCH=${SOURCE_DATE_EPOCH:-$epoch} BESPOKE_VERSION=$version \
    BESPOKE_WHEEL_PLATFORM=$(echo "manylinux_${glibc}_$machine" | tr . _) \
    "$python" -m hatchling build --target wheel --directory "$folder" >&2
rm -rf "$stage"
wheel=$(echo "$folder"/*.whl)
echo "wheel: $(wc -c <"$wheel") bytes" >&2
echo "$wheel"
