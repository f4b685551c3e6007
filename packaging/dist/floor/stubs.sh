#!/bin/sh
# Makes libraries to link against in place of the system's C library, so that what is linked runs with older ones:
#
#   stubs.sh FOLDER VERSION
#
# A name in the C library has a version for each change of it, and the linker takes the newest. The libraries in FOLDER have
# the same names, each with its newest version up to VERSION (such as 2.28), and no code: the linker reads no more of a
# shared library than that. Which names there were in libpthread and libdl, which newer ones have taken in, follows from
# the versions. What older C libraries have no name for comes from floor.c.
set -eu
export LC_ALL=C
here=$(cd "$(dirname "$0")" && pwd)
mkdir -p "$1"
folder=$(cd "$1" && pwd)
version=$2
cc=${CC:-cc}

# stub NAME SONAME: reads lines of name, type and version
stub() {
    awk -v soname="$2" '
    function node(version) { if (!(version in seen)) { seen[version] = 1; nodes[++count] = version } }
    {
        # What is hidden behind a number cannot clash with the names of others.
        printf ".globl stub_%d\n.type stub_%d, %%%s\n.size stub_%d, 8\nstub_%d: .quad 0\n", NR, NR, $2, NR, NR
        printf ".symver stub_%d, %s@@@GLIBC_%s\n", NR, $1, $3
        node($3)
    }
    END { for (k = 1; k <= count; k++) printf "# GLIBC_%s { };\n", nodes[k] }' >"$folder/$1.s"
    { sed -n 's/^# //p' "$folder/$1.s" | sed '1s/{ }/{ local: stub_*; }/'; } >"$folder/$1.map"
    sed '1i .data' "$folder/$1.s" | "$cc" -x assembler -c - -o "$folder/$1.o"
    "$cc" -shared -nostdlib -Wl,-soname,"$2" -Wl,--version-script,"$folder/$1.map" "$folder/$1.o" -o "$folder/$1.so"
    rm "$folder/$1.s" "$folder/$1.map" "$folder/$1.o"
}

# The names of a library with their newest version that is old enough, and "moved" where a newer one says so.
names() {
    readelf --dyn-syms --wide "$("$cc" -print-file-name="$1")" | awk -v limit="$version" '
    function value(version, parts) { split(version, parts, "."); return parts[1] * 1000000 + parts[2] * 1000 + parts[3] }
    $7 != "UND" && $8 ~ /@GLIBC_[0-9]/ {
        split($8, word, /@+GLIBC_/)
        at = value(word[2])
        if (at > value(limit)) { newer[word[1]] = 1; next }
        if (at >= best[word[1]]) { best[word[1]] = at; version[word[1]] = word[2] }
        type[word[1]] = $4 == "OBJECT" ? "object" : $4 == "TLS" ? "tls_object" : "function"
    }
    END { for (name in version) print name, type[name], version[name], (name in newer) ? "moved" : "" }' | sort
}

names libc.so.6 >"$folder/names"
grep -E '^(__)?(pthread|sem)_.* moved$' "$folder/names" | stub libpthread libpthread.so.0
grep -E '^dl.* moved$' "$folder/names" | stub libdl libdl.so.2
grep -vE '^((__)?(pthread|sem)|dl.*)_?.* moved$' "$folder/names" | grep -v tls_object | stub libfloor-c libc.so.6
# As in the system's, whose loader has what threads need for their own variables. Nothing in it is newer.
echo "GROUP ( $folder/libfloor-c.so AS_NEEDED ( $("$cc" -print-file-name=ld-linux-x86-64.so.2) ) )" >"$folder/libc.so"
names libm.so.6 | stub libm libm.so.6
rm "$folder/names"
"$cc" -O2 -fPIC -fvisibility=hidden -c "$here/floor.c" -o "$folder/floor.o"
rm -f "$folder/libfloor.a"
ar -rcsD "$folder/libfloor.a" "$folder/floor.o"
rm "$folder/floor.o"
