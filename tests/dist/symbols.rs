//! Exactly the functions of the header are exported, and nothing of C++ or Rust that could meet that of the host.

use std::collections::BTreeSet;
use std::fs;
use std::process::Command;

use crate::shipped::{done, libraries, root};

/// The pinned list: tests/dist/symbols.txt, one name a line.
fn pinned() -> BTreeSet<String> {
    let text = fs::read_to_string(root().join("tests/dist/symbols.txt")).expect("the list of symbols");
    text.lines().map(str::to_owned).collect()
}

#[test]
fn the_list_is_what_the_header_declares() {
    let header = fs::read_to_string(root().join("include/bespoke.h")).expect("the header");
    // A declaration is what is left where comments are not.
    let code: String = header.split("/*").map(|part| part.split_once("*/").map_or(part, |(_, code)| code)).collect();
    let declared: BTreeSet<String> = code
        .split('(')
        .filter_map(|before| before.split(|c: char| !c.is_ascii_alphanumeric() && c != '_').next_back())
        .filter(|name| name.starts_with("bespoke_"))
        .map(str::to_owned)
        .collect();
    assert_eq!(declared, pinned(), "tests/dist/symbols.txt and include/bespoke.h do not hold the same functions");
}

#[test]
fn nothing_else_is_exported() {
    for (name, library) in libraries() {
        let listed = done(Command::new("nm").args(["--dynamic", "--defined-only", "--format=posix"]).arg(&library));
        let mut exported = BTreeSet::new();
        for line in listed.lines() {
            let mut words = line.split(' ');
            let (symbol, kind) = (words.next().unwrap_or_default(), words.next().unwrap_or_default());
            // T: a function of this library alone. V, W and u are what the loader makes one of several.
            assert_eq!(kind, "T", "the {name} library exports {symbol} with the kind {kind}");
            exported.insert(symbol.to_owned());
        }
        assert_eq!(exported, pinned(), "the {name} library exports another list than tests/dist/symbols.txt");
    }
}
