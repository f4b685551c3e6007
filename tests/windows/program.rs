//! The shipped programs give the very files that those of Linux give.

use std::path::Path;
use std::process::Command;

use crate::wine::{Wine, said, same, wine};
use testing::process::{scratch, succeed};
use testing::{pairs, retarget, sample};

/// Dresses by both programs, with files by their whole names, and compares what they write.
#[track_caller]
fn compare(wine: &Wine, place: &Path, words: &[String]) {
    let here = place.join("linux.obj");
    let options = ["--quiet", "--threads", "2", "-o"];
    succeed(Command::new(retarget::program()).args(words).args(options).arg(&here).current_dir(place));
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    let output = wine.retarget(&[&words[..], &options, &["windows.obj"]].concat(), place);
    assert!(output.status.success(), "{words:?} ended with {}", said(&output));
    same(&here, &place.join("windows.obj"));
}

#[test]
fn the_sample_is_the_one_of_linux() {
    let Some(wine) = wine() else { return };
    let place = scratch("windows-sample");
    let words = sample::words(&place);
    compare(wine, &place, &words);
}

/// The pairs of real meshes, where these are.
#[test]
fn real_pairs_are_those_of_linux() {
    let Some(wine) = wine() else { return };
    for pair in pairs::real() {
        compare(wine, &scratch("windows-pair"), &pair.words);
        println!("the same bits: {}", pair.name);
    }
}

#[test]
fn both_programs_say_their_version() {
    let Some(wine) = wine() else { return };
    for program in ["retarget.exe", "bespoke.exe"] {
        let output = wine.program(&wine.bin.join(program), &wine.bin).arg("--version").output().expect("wine runs");
        assert!(output.status.success(), "{program} ended with {}", said(&output));
        let printed = String::from_utf8_lossy(&output.stdout).into_owned();
        assert!(printed.contains(env!("CARGO_PKG_VERSION")), "{program} says {printed}");
        assert!(!printed.contains('\r'), "{program} writes carriage returns");
    }
}
