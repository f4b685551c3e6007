//! Where that lies which is looked at.

use std::path::{Path, PathBuf};
use std::sync::OnceLock;

/// What MinGW's programs are called.
pub const CROSS: &str = "x86_64-w64-mingw32-";

/// The folder to ship; none, with a word about it, where it was not made.
pub fn folder() -> Option<&'static Path> {
    static FOLDER: OnceLock<Option<PathBuf>> = OnceLock::new();
    let found = FOLDER.get_or_init(|| std::env::var_os("BESPOKE_WINDOWS").map(PathBuf::from));
    match found {
        Some(folder) => {
            assert!(folder.join("bin/bespoke.dll").is_file(), "there is no library in {}", folder.display())
        }
        None => {
            println!("SKIPPED: what is shipped for Windows (make dist-windows, and name its folder in BESPOKE_WINDOWS)")
        }
    }
    found.as_deref()
}
