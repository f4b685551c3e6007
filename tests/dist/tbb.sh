#!/bin/sh
# Fetches the TBB that a host process may bring along, from PyPI: tbb.sh FOLDER
#
# Leaves FOLDER/VERSION with the libraries of each version of the package `tbb`, and the headers of the oldest, whose
# interface is another one. What is fetched must be the very files named here.
set -eu
mkdir -p "$1"
cd "$1"
files="tbb 2020.0.133 0e7b232098cc9a7bf86b08beb21ecbc5be2ba21d2e6f0d1ac6d2917e614335dc
tbb-devel 2020.0.133 1761afdd946982cfab1ca5bd3a3cb4ad4e9fbf8623aef58e108d04c55d842298
tbb 2021.13.1 d916359dc685579d09e4b344241550afc1cc034f7f5ec7234c258b6680912d70
tbb 2023.2.0 7d80615b6e970f11671fa05b6eaa9483ac864fbfe525ac280271a78b37870b7c"

echo "$files" | while read -r package version hash; do
    [ ! -f "$version/$package.complete" ] || continue
    rm -rf wheel
    echo "$package==$version --hash=sha256:$hash" >requirement.txt
    pip3 --quiet --disable-pip-version-check download --no-deps --only-binary=:all: --require-hashes \
        -r requirement.txt -d wheel
    mkdir -p "$version"
    python3 -m zipfile -e wheel/*.whl "$version"
    touch "$version/$package.complete"
done
rm -rf wheel requirement.txt
