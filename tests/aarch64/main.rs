//! What is shipped for Linux on 64-bit Arm, built here and run by QEMU: BESPOKE_AARCH64 names the folder that
//! `make dist-aarch64` made. QEMU is no Arm machine; what is the same with both are the instructions' results and the calls.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use testing::process::{is_there, root, scratch, succeed};
use testing::{pairs, retarget, sample};

/// What the cross tools are called, and where their C library lies.
const CROSS: &str = "aarch64-linux-gnu-";
const SYSTEM: &str = "/usr/aarch64-linux-gnu";

/// None, with a word about it, where it was not made.
fn folder() -> Option<PathBuf> {
    let found = std::env::var_os("BESPOKE_AARCH64").map(PathBuf::from);
    if found.is_none() {
        println!("SKIPPED: what is shipped for Arm (make test-aarch64 makes and tests it)");
    }
    found
}

/// A program of what is shipped, run by QEMU; none where there is no QEMU or nothing to run.
fn program(name: &str) -> Option<Command> {
    let program = folder()?.join("bin").join(name);
    assert!(program.is_file(), "there is no {}", program.display());
    if !is_there("qemu-aarch64") {
        return None;
    }
    let mut command = Command::new("qemu-aarch64");
    command.args(["-L", SYSTEM]).arg(program);
    Some(command)
}

/// Dresses by the program of this machine and by that for Arm, and compares the files they write.
#[track_caller]
fn compare(place: &Path, words: &[String]) {
    let Some(mut theirs) = program("bespoke-retarget") else { return };
    let [here, there] = ["here.obj", "there.obj"].map(|name| place.join(name));
    succeed(Command::new(retarget::program()).args(words).args(["--quiet", "--threads", "1", "-o"]).arg(&here));
    succeed(theirs.args(words).args(["--quiet", "--threads", "1", "-o"]).arg(&there));
    let [ours, theirs] = [&here, &there].map(|file| fs::read(file).expect("a dressed garment"));
    assert!(ours == theirs, "{} and {} differ", here.display(), there.display());
}

#[test]
fn both_programs_say_their_version() {
    for name in ["bespoke", "bespoke-retarget"] {
        let Some(mut program) = program(name) else { return };
        let said = succeed(program.arg("--version"));
        assert!(said.contains(env!("CARGO_PKG_VERSION")), "{name} says {said}");
    }
}

#[test]
fn the_sample_has_the_bits_of_this_machine() {
    let place = scratch("aarch64-sample");
    compare(&place, &sample::words(&place));
}

/// BESPOKE_AARCH64_PAIRS says how many, for QEMU takes thirty times as long; one where it is silent.
#[test]
fn real_pairs_have_the_bits_of_this_machine() {
    if folder().is_none() {
        return;
    }
    let count = std::env::var("BESPOKE_AARCH64_PAIRS").ok().and_then(|count| count.parse().ok()).unwrap_or(1);
    for pair in pairs::real().into_iter().take(count) {
        compare(&scratch("aarch64-pair"), &pair.words);
        println!("the same bits: {}", pair.name);
    }
}

#[test]
fn exactly_the_functions_of_the_header_are_exported() {
    let Some(folder) = folder() else { return };
    let text = fs::read_to_string(root().join("tests/dist/symbols.txt")).expect("the list of symbols");
    let pinned: BTreeSet<&str> = text.lines().collect();
    let library = folder.join("lib/libbespoke.so");
    let listed =
        |which| succeed(Command::new(format!("{CROSS}nm")).args(["--dynamic", which, "--format=posix"]).arg(&library));
    let exported = listed("--defined-only");
    let exported: BTreeSet<&str> = exported.lines().filter_map(|line| line.split(' ').next()).collect();
    assert_eq!(exported, pinned);
    // All that is asked for is of the system: none of OpenVDB, TBB and the C++ runtime.
    for symbol in listed("--undefined-only").lines().filter_map(|line| line.split(' ').next()) {
        let of_the_system = symbol.contains("@GLIBC_") || symbol.contains("@GCC_");
        let of_a_compiler = symbol.starts_with("_ITM_") || symbol == "__gmon_start__";
        assert!(of_the_system || of_a_compiler, "{symbol} is asked for, which is not of the system");
    }
}
