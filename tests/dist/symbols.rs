//! Exactly the functions of the header are exported, and nothing of C++ or Rust that could meet that of the host; nor
//! is anything asked for that the host may or may not have.

use std::collections::BTreeSet;
use std::fs;
use std::process::Command;

use crate::shipped::{folder, libraries};
use testing::process::{root, succeed};

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
        let listed = succeed(Command::new("nm").args(["--dynamic", "--defined-only", "--format=posix"]).arg(&library));
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

/// A symbol without a version, such as `scalable_malloc`, would be taken from whatever the host has loaded, and a
/// library that is opened by its name would be the host's.
#[test]
fn nothing_of_the_host_is_asked_for() {
    let Some(folder) = folder() else { return };
    let library = folder.join("lib/libbespoke.so");
    let listed = succeed(Command::new("nm").args(["--dynamic", "--undefined-only", "--format=posix"]).arg(&library));
    // What every compiler asks for in case that somebody profiles or has transactional memory.
    let usual = ["__gmon_start__", "_ITM_deregisterTMCloneTable", "_ITM_registerTMCloneTable"];
    for symbol in listed.lines().filter_map(|line| line.split(' ').next()) {
        let of_the_system = symbol.contains("@GLIBC_") || symbol.contains("@GCC_");
        assert!(of_the_system || usual.contains(&symbol), "{symbol} is asked for, which is not of the system");
        assert!(!symbol.starts_with("dlopen@"), "something opens libraries");
    }
    assert!(listed.contains("malloc@GLIBC_"), "malloc is not in the list: {listed}");
}

/// Their last bits differ between systems, and a result must not depend on them: the sources have their own
/// (`src/maths.rs`), and the crates beneath ask for none in what is linked. What is exact everywhere, such as `floor`, is left
/// out. With OpenVDB inside, its maps of frustums and rotations come along, since it registers all of them; a field has none but
/// a uniform scale. That no result depends on them, the Windows library shows, whose results are the same bits.
#[test]
fn no_elementary_function_of_the_system_is_asked_for() {
    let functions: Vec<&str> =
        "acos acosh asin asinh atan atan2 atanh cbrt cos cosh erf erfc exp exp10 exp2 expm1 hypot \
        lgamma log log10 log1p log2 pow sin sincos sinh tan tanh tgamma fma"
            .split_whitespace()
            .collect();
    for (name, library) in libraries() {
        let listed =
            succeed(Command::new("nm").args(["--dynamic", "--undefined-only", "--format=posix"]).arg(&library));
        let mut count = 0;
        for symbol in listed.lines().filter_map(|line| line.split([' ', '@']).next()) {
            count += 1;
            if name == "shipped" && ["pow", "sincos"].contains(&symbol) {
                continue;
            }
            let plain = symbol.strip_suffix(['f', 'l']).filter(|plain| functions.contains(plain)).unwrap_or(symbol);
            assert!(!functions.contains(&plain), "the {name} library asks the system for {symbol}");
        }
        assert!(count > 20, "only {count} symbols were listed of the {name} library");
    }
}
