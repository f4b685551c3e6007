//! The shipped programs give the very files that those of Linux give.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::wine::{Wine, said, same, wine};
use testing::process::{root, scratch, succeed};
use testing::{retarget, sample};

/// Dresses by both programs, with files by their whole names, and compares what they write.
#[track_caller]
fn compare(wine: &Wine, place: &Path, words: &[&str]) {
    let here = place.join("linux.obj");
    succeed(Command::new(retarget::program()).args(words).args(["--quiet", "-o"]).arg(&here).current_dir(place));
    let output = wine.retarget(&[words, &["--quiet", "-o", "windows.obj"]].concat(), place);
    assert!(output.status.success(), "{words:?} ended with {}", said(&output));
    same(&here, &place.join("windows.obj"));
}

#[test]
fn the_sample_is_the_one_of_linux() {
    let Some(wine) = wine() else { return };
    let place = scratch("windows-sample");
    let files = sample::write_obj(&place);
    let names: Vec<String> = files.iter().map(|file| file.display().to_string()).collect();
    let [garment, source, avatar, target, ..] = &names[..] else { panic!("the sample is {names:?}") };
    let words = [
        "--garment",
        garment,
        "--source-skeleton",
        source,
        "--avatar",
        avatar,
        "--target-skeleton",
        target,
        "--threads",
        "2",
    ];
    compare(wine, &place, &words);
}

/// The pairs of real meshes, where these are.
#[test]
fn real_pairs_are_those_of_linux() {
    let Some(wine) = wine() else { return };
    let assets = std::env::var_os("BESPOKE_ASSETS").map_or_else(|| root().join("../shared/assets"), PathBuf::from);
    let folders = |kind: &str| {
        let mut found: Vec<PathBuf> = fs::read_dir(assets.join(kind))
            .into_iter()
            .flatten()
            .map(|entry| entry.expect("an entry").path())
            .collect();
        found.retain(|folder| folder.is_dir());
        found.sort();
        found
    };
    let (garments, avatars) = (folders("garments"), folders("avatars"));
    if garments.is_empty() || avatars.is_empty() {
        println!("SKIPPED: real pairs under Wine, for there are none in {}", assets.display());
        return;
    }
    let pairs = garments.iter().flat_map(|garment| avatars.iter().map(move |avatar| [garment, avatar]));
    for [garment, avatar] in pairs {
        let place = scratch("windows-pair");
        let mut words = Vec::new();
        let mut take = |option: &str, file: PathBuf| {
            if file.is_file() {
                words.extend([option.to_owned(), file.display().to_string()]);
            }
        };
        take("--garment", garment.join("garment.obj"));
        take("--source-skeleton", garment.join("skeleton.obj"));
        take("--avatar", avatar.join("avatar.obj"));
        take("--target-skeleton", avatar.join("skeleton.obj"));
        take("--skin-weights", avatar.join("skin.txt"));
        take("--no-fit", garment.join("no-fit.txt"));
        let words: Vec<&str> = words.iter().map(String::as_str).collect();
        compare(wine, &place, &[&words[..], &["--threads", "2"]].concat());
        println!("the same bits: {} on {}", garment.display(), avatar.display());
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
