#!/bin/sh
# Makes an environment with Blender as a Python module: environment.sh FOLDER VERSION
#
# It has Blender's own tool for extensions, which pack.sh calls, and the tests run in it. It is made once: some 370 MB from PyPI.
# Ends with 3 where it cannot be had: no CPython 3.11, which is the only one that Blender 4.2 to 5.0 are built for, or no PyPI.
set -eu
stamp=$1/.complete
if [ -f "$stamp" ] && [ "$(cat "$stamp")" = "$2" ]; then
    exit
fi
python=$(command -v python3.11) || { echo "blender: bpy $2 needs CPython 3.11, and there is no python3.11" >&2; exit 3; }
"$python" -c 'import ensurepip, venv' || { echo "blender: python3.11 makes no environments (python3-venv)" >&2; exit 3; }
rm -rf "$1"
mkdir -p "$(dirname "$1")"
"$python" -m venv "$1"
"$1/bin/python" -m pip --quiet --disable-pip-version-check install --only-binary=:all: "bpy==$2" || {
    rm -rf "$1"
    echo "blender: bpy $2 cannot be had from PyPI" >&2
    exit 3
}
echo "$2" >"$stamp"
