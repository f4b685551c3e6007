//! Files that appear whole or not at all.

use std::ffi::OsString;
use std::fs;
use std::io::Write;
use std::path::Path;

use crate::failure::{Failure, Result};

/// Writes a file beside its place and moves it there.
///
/// # Errors
/// A sentence; what was there stays.
pub fn write(path: &Path, bytes: &[u8]) -> Result<()> {
    let fail = |what: &str, e: std::io::Error| Failure::no_result(format!("{}: {what}: {e}", path.display()));
    let mut name = OsString::from(".");
    name.push(path.file_name().unwrap_or_default());
    name.push(format!(".{}.new", std::process::id()));
    let beside = path.with_file_name(name);
    let written = fs::File::create(&beside).and_then(|mut file| {
        file.write_all(bytes)?;
        file.sync_all()
    });
    let moved = written
        .map_err(|e| fail("it cannot be written", e))
        .and_then(|()| fs::rename(&beside, path).map_err(|e| fail("it cannot take the place of what is there", e)));
    if moved.is_err() {
        // What is half written must not stay; that it cannot be removed is not what has gone wrong.
        let _ = fs::remove_file(&beside);
    }
    moved
}
