//! What goes wrong is told in a sentence, and leaves no half of anything.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};

use crate::prefix::{command, folder, install, installer, refused, tree};
use testing::process::root;

/// All files and what is in them.
fn contents(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    tree(folder).into_iter().map(|name| (name.clone(), fs::read(folder.join(&name)).unwrap_or_default())).collect()
}

/// Files and links, without the empty folders that a failed installation may leave.
fn files(folder: &Path) -> BTreeSet<String> {
    tree(folder).into_iter().filter(|name| !name.ends_with('/')).collect()
}

/// A program to call instead of strip.
fn stripper(folder: &Path, script: &str) -> PathBuf {
    let path = folder.join("stripper");
    fs::write(&path, format!("#!/bin/sh\n{script}\n")).expect("a script");
    fs::set_permissions(&path, PermissionsExt::from_mode(0o755)).expect("its mode");
    path
}

#[test]
fn places_that_cannot_be_are_refused() {
    let place = folder("bad places");
    for (name, value, words) in [
        ("PREFIX", "out", &["PREFIX", "\"out\""][..]),
        ("PREFIX", "/opt/../etc", &["PREFIX", "\"/opt/../etc\""]),
        ("LIBDIR", "lib64", &["LIBDIR", "\"lib64\""]),
        ("BINDIR", "./bin", &["BINDIR", "\"./bin\""]),
        ("INCLUDEDIR", "/opt/.", &["INCLUDEDIR", "\"/opt/.\""]),
    ] {
        refused(&mut installer(&place, &[(name, value)]), words);
    }
    fs::write(place.join("file"), "").expect("a file");
    let below = place.join("file/prefix");
    refused(&mut installer(&below, &[]), &["file/prefix", "cannot be made", "nothing was installed"]);
    assert_eq!(files(&place), BTreeSet::from(["file".to_owned()]));
}

#[test]
fn wrong_words_and_missing_files_are_refused() {
    let place = folder("bad words");
    let script = || {
        let mut script = command("sh");
        script.arg(root().join("packaging/install.sh")).env("PREFIX", &place);
        script
    };
    refused(&mut script(), &["install LIBRARY PROGRAM"]);
    refused(script().arg("nonsense"), &["install LIBRARY PROGRAM"]);
    refused(script().args(["install", "one"]), &["library", "program"]);
    refused(script().args(["install", "no-library", "no-program"]), &["no-library", "run make first"]);
    assert!(tree(&place).is_empty());
}

/// The last file cannot be installed: the first ones are not, either.
#[test]
fn a_folder_in_the_way_leaves_the_older_installation() {
    let place = folder("in the way");
    let prefix = place.join("prefix");
    install(&prefix, &[]);
    let readme = prefix.join("share/doc/bespoke/README.md");
    fs::remove_file(&readme).expect("it is there");
    fs::create_dir(&readme).expect("a folder");
    fs::write(prefix.join("include/bespoke.h"), "older").expect("it can be written");
    let before = contents(&prefix);
    refused(&mut installer(&prefix, &[]), &["README.md", "is a folder", "nothing was installed"]);
    assert_eq!(contents(&prefix), before);
}

#[test]
fn a_stripper_that_fails_is_told() {
    let place = folder("stripper");
    let prefix = place.join("prefix");
    let failing = stripper(&place, "exit 3");
    for program in [failing.to_str().expect("UTF-8"), "no-such-program"] {
        refused(
            &mut installer(&prefix, &[("STRIP", program)]),
            &["cannot be stripped", "STRIP", "nothing was installed"],
        );
        assert!(files(&prefix).is_empty(), "{:?}", files(&prefix));
    }
}

/// Stopped by a signal while the program is worked on, after the library.
#[test]
fn a_signal_leaves_the_older_installation() {
    let place = folder("signal");
    let prefix = place.join("prefix");
    let stopping = stripper(&place, "case $2 in *retarget*) kill -TERM $PPID ;; esac; exit 0");
    let stopping = [("STRIP", stopping.to_str().expect("UTF-8"))];
    let stopped = || {
        let output = refused(&mut installer(&prefix, &stopping), &["stopped by a signal", "nothing was installed"]);
        assert_eq!(output.status.code(), Some(130));
    };
    stopped();
    assert!(files(&prefix).is_empty(), "{:?}", files(&prefix));

    install(&prefix, &[]);
    fs::write(prefix.join("include/bespoke.h"), "older").expect("it can be written");
    let before = contents(&prefix);
    stopped();
    assert_eq!(contents(&prefix), before);
}
