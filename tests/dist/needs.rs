//! What the shipped binaries ask of the machine that they run on: the C library, GCC's runtime, and nothing else.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::shipped::folder;
use testing::process::{root, succeed};

const SYSTEM: [&str; 6] =
    ["libc.so.6", "libm.so.6", "libgcc_s.so.1", "ld-linux-x86-64.so.2", "libdl.so.2", "libpthread.so.0"];

/// The values of one entry of the dynamic section.
fn dynamic(file: &Path, entry: &str) -> Vec<String> {
    let text = succeed(Command::new("objdump").arg("-p").arg(file));
    let lines = text.lines().filter_map(|line| line.trim_start().strip_prefix(entry));
    lines.filter(|rest| rest.starts_with(' ')).map(|rest| rest.trim().to_owned()).collect()
}

/// The library and the programs, as they lie in the folder.
fn binaries() -> Vec<PathBuf> {
    let Some(folder) = folder() else { return Vec::new() };
    let programs =
        fs::read_dir(folder.join("bin")).expect("the folder bin").map(|entry| entry.expect("an entry").path());
    let mut binaries: Vec<_> = programs.collect();
    assert!(!binaries.is_empty(), "there is no program");
    binaries.push(folder.join("lib/libbespoke.so"));
    binaries
}

#[test]
fn only_the_system_is_needed() {
    for file in binaries() {
        let is_library = file.ends_with("libbespoke.so");
        for needed in dynamic(&file, "NEEDED") {
            let ours = !is_library && needed.starts_with("libbespoke.so.");
            assert!(ours || SYSTEM.contains(&needed.as_str()), "{} needs {needed}", file.display());
        }
        assert!(dynamic(&file, "RPATH").is_empty(), "{} has an RPATH, which its host would inherit", file.display());
        for path in dynamic(&file, "RUNPATH") {
            assert_eq!(path, "$ORIGIN/../lib", "{} looks for libraries elsewhere", file.display());
        }
        if dynamic(&file, "NEEDED").iter().any(|needed| needed.starts_with("libbespoke.so.")) {
            assert_eq!(dynamic(&file, "RUNPATH").len(), 1, "{} does not find its library", file.display());
        }
    }
}

#[test]
fn nothing_tells_of_the_machine_that_it_was_built_on() {
    let home = std::env::var("HOME").unwrap_or_default();
    let cargo = std::env::var("CARGO_HOME").unwrap_or_else(|_| format!("{home}/.cargo"));
    let root = root().display();
    // With what follows in them: a root such as /src is in every path of a source.
    let places =
        [format!("{cargo}/registry"), format!("{root}/src/capi"), format!("{root}/target"), format!("{root}/build")];
    for file in binaries() {
        let bytes = fs::read(&file).expect("a binary can be read");
        for place in &places {
            let found = bytes.windows(place.len()).any(|window| window == place.as_bytes());
            assert!(!found, "{} holds {place}", file.display());
        }
    }
}

/// A version such as 2.34, as a pair to compare.
fn version(text: &str) -> (u32, u32) {
    let mut parts = text.split('.').map(|part| part.parse().expect("a number of a version"));
    (parts.next().unwrap_or_default(), parts.next().unwrap_or_default())
}

#[test]
fn glibc_is_as_old_as_documented() {
    let text = fs::read_to_string(root().join("docs/dist.md")).expect("docs/dist.md");
    let (_, rest) = text.split_once("**glibc ").expect("docs/dist.md says which glibc");
    let documented = version(rest.split_once("**").expect("the version ends").0);
    for file in binaries() {
        let symbols = succeed(Command::new("objdump").arg("-T").arg(&file));
        let versions = symbols
            .split("GLIBC_")
            .skip(1)
            .map(|rest| version(rest.split(|c: char| c != '.' && !c.is_ascii_digit()).next().expect("a version")));
        let newest = versions.max().expect("something of glibc is used");
        assert!(newest <= documented, "{} needs glibc {}.{}", file.display(), newest.0, newest.1);
    }
}
