//! The program `retarget`.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::OnceLock;

use crate::library;
use crate::process::{root, temporary, this_program_name};

/// Its path: BESPOKE_RETARGET, or else it is compiled from examples_c.
///
/// # Panics
/// It does not compile.
pub fn program() -> &'static Path {
    static PROGRAM: OnceLock<PathBuf> = OnceLock::new();
    PROGRAM.get_or_init(|| {
        if let Some(path) = std::env::var_os("BESPOKE_RETARGET") {
            return path.into();
        }
        let library = library::folder();
        let program = temporary().join(format!("retarget-{}", this_program_name()));
        let sources = fs::read_dir(root().join("examples_c")).expect("examples_c exists");
        let sources =
            sources.map(|entry| entry.expect("an entry").path()).filter(|p| p.extension() == Some("c".as_ref()));
        let output = Command::new("cc")
            .args(["-std=c99", "-pedantic", "-Wall", "-Wextra", "-Werror", "-I"])
            .arg(root().join("include"))
            .args(sources)
            .arg("-o")
            .arg(&program)
            .arg(format!("-L{}", library.display()))
            .args(["-lbespoke", "-lm"])
            .arg(format!("-Wl,-rpath,{}", library.display()))
            .output()
            .expect("a C compiler");
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        program
    })
}
