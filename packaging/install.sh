#!/bin/sh
# Installs the library and what belongs to it, or removes it again:
#
#   install.sh install LIBRARY PROGRAM   the shared library and the program `retarget` as they were built
#   install.sh uninstall                 removes the same files, and what folders it leaves empty
#   install.sh run-path                  prints the way from BINDIR to LIBDIR, for the run path of PROGRAM
#
# The environment says where: PREFIX (/usr/local), BINDIR, LIBDIR, INCLUDEDIR, DOCDIR (below it), and DESTDIR, which
# goes before all of them and is in no file. STRIP is the program that takes the debug information out (strip); empty
# keeps it. docs/packaging.md lists what is installed. All files are whole under other names before the first gets its
# own.
set -eu
umask 022
root=$(dirname "$0")/..

# What a failure leaves, once there is something to say about that.
left=""
fail() {
    echo "install.sh: $*$left" >&2
    exit 1
}

# A folder as it was said, without what means nothing.
folder() { # NAME VALUE
    case $2/ in
    */../* | */./*) fail "$1 is \"$2\", and a folder is said without . and .." ;;
    /*) ;;
    *) fail "$1 is \"$2\", and a folder is said from the root on, such as /usr/local" ;;
    esac
    plain=$(printf %s "$2" | tr -s /)
    printf %s "${plain%/}"
}
prefix=$(folder PREFIX "${PREFIX:-/usr/local}") || exit 1
bindir=$(folder BINDIR "${BINDIR:-$prefix/bin}") || exit 1
libdir=$(folder LIBDIR "${LIBDIR:-$prefix/lib}") || exit 1
includedir=$(folder INCLUDEDIR "${INCLUDEDIR:-$prefix/include}") || exit 1
docdir=$(folder DOCDIR "${DOCDIR:-$prefix/share/doc/bespoke}") || exit 1
destdir=${DESTDIR:-}
cmakedir=$libdir/cmake/Bespoke
pkgconfigdir=$libdir/pkgconfig

# What installed files say of each other's places, so that all of them can be moved together.
way() { # FROM TO: such as ../lib
    from=$1 up=""
    while case $2/ in "$from"/*) false ;; esac do
        from=${from%/*} up=../$up
    done
    rest=${2#"$from"}
    rest=$up${rest#/}
    printf %s "${rest%/}"
}

version=$(sed -n 's/^version = "\(.*\)"$/\1/p' "$root/Cargo.toml" | head -n 1)
abi=$(sed -n 's/^#define BESPOKE_ABI_VERSION //p' "$root/include/bespoke.h")
if [ -z "$version" ] || [ -z "$abi" ]; then
    fail "Cargo.toml has no version, or include/bespoke.h no BESPOKE_ABI_VERSION"
fi
# The file, the name by which the loader looks for it, and the one by which the linker does.
if [ "$(uname)" = Darwin ]; then
    file=libbespoke.$abi.$version.dylib loaded=libbespoke.$abi.dylib linked=libbespoke.dylib
    soname=@rpath/$loaded
else
    file=libbespoke.so.$abi.$version loaded=libbespoke.so.$abi linked=libbespoke.so
    soname=$loaded
fi

library="" program=""
# Calls COMMAND KIND SOURCE PLACE for every file that is installed.
each() { # COMMAND
    "$1" program "$library" "$libdir/$file"
    "$1" link "$file" "$libdir/$loaded"
    "$1" link "$loaded" "$libdir/$linked"
    "$1" program "$program" "$bindir/bespoke-retarget"
    for header in "$root"/include/*.h "$root"/include/*.hpp; do
        [ ! -f "$header" ] || "$1" text "$header" "$includedir/${header##*/}"
    done
    "$1" template "$root/packaging/bespoke.pc.in" "$pkgconfigdir/bespoke.pc"
    for name in BespokeConfig BespokeConfigVersion; do
        "$1" template "$root/packaging/$name.cmake.in" "$cmakedir/$name.cmake"
    done
    for text in "$root"/*.md "$root"/LICENSE-MIT "$root"/LICENSE-APACHE; do
        "$1" text "$text" "$docdir/${text##*/}"
    done
    # Beside the README, which shows the pictures.
    for text in "$root"/docs/*; do
        [ ! -f "$text" ] || "$1" text "$text" "$docdir/docs/${text##*/}"
    done
}

# The names in a template by what they stand for.
fill() { # NAME VALUE: an expression of sed
    printf 's|@%s@|%s|g\n' "$1" "$(printf %s "$2" | sed 's/[&|\\]/\\&/g')"
}

prepare() { # KIND SOURCE PLACE: whole, under another name
    place=$destdir$3
    [ ! -d "$place" ] || fail "$place is a folder, where a file has to go"
    mkdir -p "${place%/*}" || fail "the folder ${place%/*} cannot be made"
    rm -f "$place.new" || fail "$place.new cannot be removed"
    case $1 in
    program)
        cp "$2" "$place.new" || fail "$place cannot be written"
        if [ -n "${STRIP-strip}" ]; then
            "${STRIP-strip}" -S "$place.new" ||
                fail "$2 cannot be stripped (an empty STRIP installs it with its debug information)"
        fi
        chmod 755 "$place.new" || fail "$place cannot be made a program"
        ;;
    link) ln -s "$2" "$place.new" || fail "the link $place cannot be made" ;;
    text)
        cp "$2" "$place.new" || fail "$place cannot be written"
        chmod 644 "$place.new" || fail "$place cannot be made readable"
        ;;
    template)
        sed "$expressions" "$2" >"$place.new" || fail "$place cannot be written"
        chmod 644 "$place.new" || fail "$place cannot be made readable"
        ;;
    esac
}

commit() { # KIND SOURCE PLACE
    mv -f "$destdir$3.new" "$destdir$3" || fail "$destdir$3 cannot be replaced"
    left="; some of the files are new and some are not: install again"
}

discard() { # KIND SOURCE PLACE
    rm -f "$destdir$3.new"
}

remove() { # KIND SOURCE PLACE
    rm -f "$destdir$3" "$destdir$3.new" || fail "$destdir$3 cannot be removed"
    left="; some of the files are gone and some are not: uninstall again"
}

# Folders that only installations make, and those that have other uses where the prefix is not the system's; never the
# prefix itself, and only what is empty.
prune() {
    for folder in "$cmakedir" "${cmakedir%/*}" "$pkgconfigdir" "$docdir/docs" "$docdir"; do
        rmdir "$destdir$folder" 2>/dev/null || true
    done
    case $prefix in "" | /usr | /usr/local) return ;; esac
    for folder in "$libdir" "$includedir" "$bindir" "${docdir%/*}"; do
        while case $folder in "$prefix"/*) ;; *) false ;; esac && rmdir "$destdir$folder" 2>/dev/null; do
            folder=${folder%/*}
        done
    done
}

# The loader knows some folders by a list of what is in them.
refresh() {
    PATH=$PATH:/sbin:/usr/sbin
    if [ -z "$destdir" ] && [ "$(id -u)" = 0 ] && ldconfig -N -X -v 2>/dev/null | grep -q "^$libdir:"; then
        ldconfig || fail "ldconfig cannot tell the loader about $libdir; call it"
    fi
}

case ${1:-} in
install)
    [ $# = 3 ] || fail "install takes the library and the program"
    library=$2 program=$3
    left="; nothing was installed"
    for built in "$library" "$program"; do
        [ -f "$built" ] || fail "$built is not there; run make first"
    done
    # The fifth byte of an ELF file is 1 for 32 bits; there is no other library with so few.
    bits=64
    [ "$(od -An -tu1 -N5 "$library" | tr -s ' ')" != " 127 69 76 70 1" ] || bits=32
    expressions="$(fill VERSION "$version")
$(fill FILE "$file")
$(fill SONAME "$soname")
$(fill POINTER_SIZE $((bits / 8)))
$(fill PKGCONFIG_TO_LIB "$(way "$pkgconfigdir" "$libdir")")
$(fill PKGCONFIG_TO_INCLUDE "$(way "$pkgconfigdir" "$includedir")")
$(fill CMAKE_TO_LIB "$(way "$cmakedir" "$libdir")")
$(fill CMAKE_TO_INCLUDE "$(way "$cmakedir" "$includedir")")"
    trap 'each discard' EXIT
    # To end here leads to the line above.
    trap 'echo "install.sh: stopped by a signal$left" >&2; exit 130' HUP INT TERM
    each prepare
    each commit
    left=""
    refresh
    echo "installed bespoke $version in $destdir$prefix"
    ;;
uninstall)
    each remove
    left=""
    prune
    refresh
    echo "removed bespoke $version from $destdir$prefix"
    ;;
run-path) way "$bindir" "$libdir" ;;
*) fail "say install LIBRARY PROGRAM, uninstall or run-path" ;;
esac
