#!/bin/sh
# Fetches the sources of OpenVDB and oneTBB that Debian 12 ships, and unpacks them: sources.sh FOLDER
#
# They come from Debian's archive, whose signature apt checks, and must be the very files named here. What lies in the
# folder already is checked and used. Left are FOLDER/openvdb and FOLDER/onetbb.
set -eu
folder=$1
suite=bookworm
files="openvdb 10.0.1 776706ca285a43b53e24c28d8f8b2112aea3dbf94c3c5f399cf6ff43403f5ace
onetbb 2021.8.0 7e9111b8bb59c8800bf6d0b06afe7b0891937443d2dae1ee1101c8e2ede6a7ef"

mkdir -p "$folder"
cd "$folder"

updated=""

# The mirror that this machine uses for the suite, if it does.
mirror() {
    # What stands in braces is for apt to fill in.
    # shellcheck disable=SC2016
    apt-get indextargets --format '$(REPO_URI)' 'Origin: Debian' "Codename: $suite" 'Component: main' \
        'Created-By: Packages' | head -n 1
}

fetch() { # PACKAGE
    package=$1
    if ! command -v apt-get >/dev/null 2>&1; then
        echo "sources: $package is not in $folder, and there is no apt-get to fetch it with" >&2
        exit 1
    fi
    keyring=/usr/share/keyrings/debian-archive-keyring.gpg
    if [ ! -f "$keyring" ]; then
        echo "sources: $keyring is not there; install debian-archive-keyring" >&2
        exit 1
    fi
    uri=$(mirror)
    # Lists of our own: those of the system are not touched, and root is not needed.
    mkdir -p apt/lists/partial apt/cache
    echo "deb-src [signed-by=$keyring] ${uri:-http://deb.debian.org/debian} $suite main" >apt/sources.list
    set -- -o "Dir::Etc::sourcelist=$PWD/apt/sources.list" -o Dir::Etc::sourceparts=- \
        -o "Dir::State::lists=$PWD/apt/lists" -o "Dir::Cache=$PWD/apt/cache" -o APT::Sandbox::User="$(id -un)"
    [ -n "$updated" ] || apt-get -qq "$@" update
    updated=yes
    # Without the patches of Debian; docs/dist.md says why.
    apt-get -qq "$@" source --download-only --tar-only "$package"
}

echo "$files" | while read -r package version hash; do
    archive=${package}_$version.orig.tar.xz
    [ -f "$archive" ] || fetch "$package"
    if ! echo "$hash  $archive" | sha256sum --check --quiet -; then
        echo "sources: $folder/$archive is not the file that was asked for; remove it and try again" >&2
        exit 1
    fi
    [ -f "$package/.unpacked" ] && continue
    rm -rf "$package"
    mkdir "$package"
    tar -xJf "$archive" -C "$package" --strip-components=1
    touch "$package/.unpacked"
done
