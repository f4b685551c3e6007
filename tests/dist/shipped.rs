//! Where the libraries lie that are looked at.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::OnceLock;

use testing::library;
use testing::process::{scratch, succeed};

/// The folder to ship. An archive is unpacked elsewhere than where it was made.
pub fn folder() -> Option<&'static Path> {
    static FOLDER: OnceLock<Option<PathBuf>> = OnceLock::new();
    let found = FOLDER.get_or_init(|| {
        let given = PathBuf::from(std::env::var_os("BESPOKE_DIST")?);
        if given.is_dir() {
            return Some(given);
        }
        let place = scratch("dist-unpacked");
        succeed(Command::new("tar").arg("-xzf").arg(&given).arg("-C").arg(&place));
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
