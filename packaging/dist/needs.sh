#!/bin/sh
# Says what the shipped binaries ask of a machine: needs.sh FOLDER, a folder that dist.sh made
set -eu
for file in "$1"/lib/libbespoke.so "$1"/bin/*; do
    # What is asked of a library of the system is said with the version in which it came.
    glibc=$("${OBJDUMP:-objdump}" -T "$file" | sed -n 's/.*(\{0,1\}GLIBC_\([0-9.]*\))\{0,1\} .*/\1/p' | sort -uV | tail -n 1)
    needed=$("${OBJDUMP:-objdump}" -p "$file" | sed -n 's/^ *NEEDED *//p' | tr '\n' ' ')
    echo "dist: ${file##*/}: glibc $glibc or later; loads $needed"
done
