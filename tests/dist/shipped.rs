//! Where the libraries lie that are looked at.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::OnceLock;

use crate::library;

pub fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// An empty folder for one test.
pub fn scratch(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("dist-{name}"));
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).expect("a folder for the test");
    folder
}

/// The folder to ship. An archive is unpacked elsewhere than where it was made.
pub fn folder() -> Option<&'static Path> {
    static FOLDER: OnceLock<Option<PathBuf>> = OnceLock::new();
    let found = FOLDER.get_or_init(|| {
        let given = PathBuf::from(std::env::var_os("BESPOKE_DIST")?);
        if given.is_dir() {
            return Some(given);
        }
        let place = scratch("unpacked");
        done(Command::new("tar").arg("-xzf").arg(&given).arg("-C").arg(&place));
        let mut entries = fs::read_dir(&place).expect("the unpacked archive");
        let only = entries.next().expect("the archive holds something").expect("an entry").path();
        assert!(entries.next().is_none(), "{} holds more than one folder", given.display());
        Some(only)
    });
    if found.is_none() {
        println!("SKIPPED: the folder to ship (make dist makes it and runs these tests, or name it in BESPOKE_DIST)");
    }
    found.as_deref()
}

/// Every library that there is to look at, with a name for it.
pub fn libraries() -> Vec<(&'static str, PathBuf)> {
    let mut libraries = vec![("built", library::folder().join("libbespoke.so"))];
    libraries.extend(folder().map(|folder| ("shipped", folder.join("lib/libbespoke.so"))));
    libraries
}

/// What a program printed that has to end well.
#[track_caller]
pub fn done(command: &mut Command) -> String {
    let output = command.output().unwrap_or_else(|reason| panic!("{command:?} cannot be run: {reason}"));
    let (text, errors) = (String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
    assert!(output.status.success(), "{command:?}: {}\n{text}{errors}", output.status);
    text.into_owned()
}

/// Whether there is such a program; says what is skipped where there is none.
pub fn there_is(program: &str, what: &str) -> bool {
    let there = Command::new(program).arg("--version").output().is_ok();
    if !there {
        println!("SKIPPED: {what}, for there is no {program}");
    }
    there
}
