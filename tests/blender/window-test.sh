#!/bin/sh
# Tests the Blender extension in Blender's own window: window-test.sh WHEELS SAMPLE VERSION
#
# Arguments as of test.sh. Blender is that of Debian's unstable suite (engine.sh), kept in build/blender/window, where the pictures
# are left too. What cannot be had is skipped with a word.
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
wheels=$1 sample=$(cd "$2" && pwd) version=$3
skip() {
    echo "skipped: the tests of the Blender extension in Blender's window, for $1"
    exit
}
unshare --map-root-user --mount true 2>/dev/null || skip "this system gives no name spaces"
status=0
sh "$root/packaging/blender/environment.sh" "$root/build/blender/bpy-$version" "$version" || status=$?
[ "$status" -ne 3 ] || skip "there is no Blender to pack it with"
[ "$status" -eq 0 ] || exit "$status"
sh "$root/tests/blender/engine.sh" "$root/build/blender/window" || skip "Blender with a window cannot be had"
zip=$(sh "$root/packaging/blender/pack.sh" "$root/build/blender/bpy-$version" "$wheels" "$root/build/blender/extension")
sh "$root/tests/blender/window.sh" "$root/build/blender/window/blender" "$zip" "$sample" "$root/build/blender/window/pictures"
