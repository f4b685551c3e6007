#!/bin/sh
# What the tests of the Godot add-on need: environment.sh LIBRARY FOLDER
#
# Leaves the engine in FOLDER/godot and the add-on with this library in FOLDER/godot-addon. What cannot be had is skipped with a
# word: the tests skip themselves.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
skip() {
    rm -rf "$2/godot-addon"
    echo "skipped: the tests of the Godot add-on, for $1" >&2
    exit 0
}
minor=$(rustc --version | sed 's/^rustc 1\.\([0-9]*\).*/\1/')
[ "$minor" -ge 94 ] || skip "it takes Rust 1.94 ($(rustc --version))" "$2"
sh "$here/engine.sh" "$2/godot" || skip "the engine cannot be had" "$2"
sh "$here/../../bindings/godot/build.sh" "$1" "$2/godot-addon"
