//! The library as a plugin of a process of Windows.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::OnceLock;

use crate::wine::{Wine, compile, said, wine};
use testing::library;
use testing::process::{root, scratch, succeed};

fn host() -> &'static Path {
    static HOST: OnceLock<PathBuf> = OnceLock::new();
    HOST.get_or_init(|| {
        let program = scratch("windows-host").join("host.exe");
        let sources = ["tests/windows/host.c", "tests/dist/tube.c"].map(|source| root().join(source));
        compile(&sources, &["include", "tests/windows/posix"].map(|folder| root().join(folder)), &[], &program);
        program
    })
}

/// The hash that the host prints for its words.
#[track_caller]
fn hash(wine: &Wine, words: &[&str]) -> String {
    let output = wine.program(host(), &wine.bin).args(words).output().expect("wine runs");
    assert!(output.status.success(), "{words:?} ended with {}", said(&output));
    String::from_utf8_lossy(&output.stdout).lines().next_back().expect("a hash").trim().to_owned()
}

/// What the same host gets of the library that was built here.
fn on_linux() -> String {
    let program = scratch("windows-host-here").join("host");
    let sources = ["tests/dist/host.c", "tests/dist/tube.c"].map(|source| root().join(source));
    let mut command = Command::new("cc");
    command.args(["-std=gnu11", "-O1", "-I"]).arg(root().join("include")).args(sources).arg("-o").arg(&program);
    succeed(command.args(["-ldl", "-lpthread", "-lm"]));
    let printed = succeed(Command::new(program).arg("plain").arg(library::folder().join("libbespoke.so")));
    printed.lines().next_back().expect("a hash").to_owned()
}

#[test]
fn a_host_gets_the_bits_of_linux() {
    let Some(wine) = wine() else { return };
    let expected = on_linux();
    assert_eq!(hash(wine, &["plain", "bespoke.dll"]), expected);
    assert_eq!(hash(wine, &["reopen", "bespoke.dll"]), expected, "opened and closed several times");
    assert_eq!(hash(wine, &["foreign", "bespoke.dll"]), expected, "from a thread that flushes subnormal numbers");
    let copy = scratch("windows-copy").join("copy.dll");
    fs::copy(wine.bin.join("bespoke.dll"), &copy).expect("a copy of the library");
    let copy = format!("Z:{}", copy.display());
    assert_eq!(hash(wine, &["copies", "bespoke.dll", &copy]), expected, "two copies at once");
}
