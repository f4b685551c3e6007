//! The shared library as programs in other languages link and load it.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use crate::process::{temporary, this_program, this_program_name};

/// A folder with the library that was built beside these tests, under the name for the linker (`libbespoke.so`) and the
/// one for the loader (`libbespoke.so.2`).
pub fn folder() -> &'static Path {
    static FOLDER: OnceLock<PathBuf> = OnceLock::new();
    FOLDER.get_or_init(|| {
        let program = this_program();
        let built = program.with_file_name(name(""));
        assert!(built.is_file(), "{} is not there: cargo builds it with the tests", built.display());
        // One folder for each test program, since they may run side by side.
        let folder = temporary().join(format!("library-{}", this_program_name()));
        let _ = fs::remove_dir_all(&folder);
        fs::create_dir_all(&folder).expect("a folder for the library");
        for version in ["", &bespoke::capi::version::BESPOKE_ABI_VERSION.to_string()] {
            std::os::unix::fs::symlink(&built, folder.join(name(version))).expect("a link to the library");
        }
        folder
    })
}

/// The library's file name with this version.
fn name(version: &str) -> String {
    let dot = if version.is_empty() { "" } else { "." };
    if cfg!(target_os = "macos") {
        format!("libbespoke{dot}{version}.dylib")
    } else {
        format!("libbespoke.so{dot}{version}")
    }
}
