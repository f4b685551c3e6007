#!/bin/sh
# Tests the Blender extension: test.sh WHEELS SAMPLE VERSION [NAME...]
#
# WHEELS is the folder with the wheel, SAMPLE that of `make demo`, VERSION that of bpy on PyPI. What is made stays in build/blender.
# Where that Blender cannot be had, the tests are skipped with a word.
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
wheels=$1 sample=$(cd "$2" && pwd) version=$3
shift 3
environment=$root/build/blender/bpy-$version
status=0
sh "$root/packaging/blender/environment.sh" "$environment" "$version" || status=$?
if [ "$status" -eq 3 ]; then
    echo "skipped: the tests of the Blender extension, for there is no Blender to run them in"
    exit
fi
[ "$status" -eq 0 ] || exit "$status"
zip=$(sh "$root/packaging/blender/pack.sh" "$environment" "$wheels" "$root/build/blender/extension")
# What runs for ever is stopped: a Blender that hangs is no test that passes.
BESPOKE_SAMPLE=$sample PYTHONDONTWRITEBYTECODE=1 timeout -k 10 600 \
    "$environment/bin/python" "$root/tests/blender/run.py" "$zip" "$root/build/blender/profile-$version" "$@"
