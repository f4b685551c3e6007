#!/bin/sh
# Format and clippy of the add-on's package, where each warning is an error. It is no member of the workspace, so nothing else looks
# at it. What this system lacks is skipped with a word.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
skip() {
    echo "skipped: $1 of the Godot add-on, for $2"
}
if cargo fmt --version >/dev/null 2>&1; then
    cargo fmt --manifest-path "$here/Cargo.toml" --check
else
    skip "the format" "there is no rustfmt (rustup component add rustfmt)"
fi
minor=$(rustc --version | sed 's/^rustc 1\.\([0-9]*\).*/\1/')
if ! cargo clippy --version >/dev/null 2>&1; then
    skip clippy "it is not there (rustup component add clippy)"
elif [ "$minor" -lt 94 ]; then
    skip clippy "it takes Rust 1.94 ($(rustc --version))"
elif ! cargo fetch --quiet --locked --manifest-path "$here/Cargo.toml"; then
    skip clippy "what it depends on cannot be had"
else
    # In the folder and with the settings of build.sh, so that macros and build scripts are made once.
    cargo clippy --release --locked --manifest-path "$here/Cargo.toml" --target-dir "$here/../../build/godot-target" -- -D warnings
fi
