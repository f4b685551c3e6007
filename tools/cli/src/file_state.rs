//! Whether a file is still what it was when it was read.

use std::path::{Path, PathBuf};
use std::time::UNIX_EPOCH;

/// A file by its path, with its size and age.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FileState {
    path: PathBuf,
    length: u64,
    age: u128,
}

impl FileState {
    /// As it is now; one that is not there has neither size nor age.
    pub fn of(path: &Path) -> Self {
        let known = std::fs::metadata(path).ok();
        let age = known.as_ref().and_then(|known| known.modified().ok()?.duration_since(UNIX_EPOCH).ok());
        Self {
            path: path.to_path_buf(),
            length: known.map_or(0, |known| known.len()),
            age: age.unwrap_or_default().as_nanos(),
        }
    }
}
