//! What the library depends on has the same features whether it is built alone, with the program or with all tests: else all
//! of it would be built once more for each, which takes minutes.

use std::collections::BTreeSet;
use std::process::Command;

use testing::process::root;

/// The packages that cargo builds for these arguments, with their features.
fn packages(arguments: &[&str]) -> BTreeSet<String> {
    let mut cargo = Command::new(env!("CARGO"));
    cargo.args(["tree", "--locked", "--prefix", "none", "--format", "{p} {f}"]).args(arguments).current_dir(root());
    let output = cargo.output().expect("cargo");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let text = String::from_utf8(output.stdout).expect("UTF-8");
    text.lines().map(|line| line.trim_end_matches(" (*)").to_string()).collect()
}

#[test]
fn the_library_is_the_same_alone_and_beside_all_else() {
    let alone = packages(&["--package", "bespoke", "--edges", "normal,build"]);
    assert!(alone.iter().any(|package| package.starts_with("faer ")), "{alone:?}");
    let program = packages(&["--package", "bespoke-cli", "--edges", "normal,build"]);
    let all = packages(&["--workspace", "--edges", "normal,build,dev"]);
    for (beside, packages) in [("the program", &program), ("all tests", &all)] {
        let missing: Vec<&String> = alone.difference(packages).collect();
        assert!(missing.is_empty(), "built anew beside {beside}, with other features: {missing:?}");
    }
}
