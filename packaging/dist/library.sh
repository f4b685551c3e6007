#!/bin/sh
# Builds the library with OpenVDB, oneTBB and the C++ runtime inside: library.sh FOLDER
#
# FOLDER gets the sources and the static libraries. Leaves the library where its last line says.
set -eu
# shellcheck source=packaging/dist/environment.sh
. "$(dirname "$0")/environment.sh"

sh "$here/sources.sh" "$folder/sources" >&2
echo "dist: OpenVDB and oneTBB as static libraries" >&2
make --silent -f "$here/static.mk" -j"$(nproc)" SOURCES="$folder/sources" OUT="$static" CROSS="$tools" >&2

echo "dist: the library" >&2
touch "$folder/asked"
sh "$here/cargo.sh" "$folder" --lib
# The date since which no source has changed.
mv "$folder/asked" "$folder/fresh"
realpath "$built/libbespoke.so"
