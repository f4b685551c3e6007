#!/bin/sh
# Makes an environment with what the tests of the Python package try it with: environment.sh FOLDER
#
# It is made once, and again where requirements.txt changes. What cannot be had but NumPy is skipped with a word: tests that
# need it skip themselves.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
stamp=$1/.complete
if [ -f "$stamp" ] && cmp -s "$here/requirements.txt" "$stamp"; then
    exit
fi
rm -rf "$1"
python3 -m venv "$1"
install() {
    "$1/bin/pip" --quiet --disable-pip-version-check install --only-binary=:all: "$2"
}
# By word: one that has no wheel for this interpreter takes no other with it.
for wanted in $(sed 's/#.*//' "$here/requirements.txt"); do
    install "$1" "$wanted" && continue
    # The version is that for Debian 12's Python.
    install "$1" "${wanted%%==*}" || echo "skipped: tests of the Python package that need $wanted, which cannot be had" >&2
done
"$1/bin/python" -c 'import numpy'
cp "$here/requirements.txt" "$stamp"
