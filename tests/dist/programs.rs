//! The C programs of these tests, compiled once.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::OnceLock;

use crate::shipped::{done, root, scratch};

/// host.c: a process that loads the library as a plugin.
pub fn host() -> &'static Path {
    static HOST: OnceLock<PathBuf> = OnceLock::new();
    HOST.get_or_init(|| {
        let program = scratch("host").join("host");
        let sources = ["tests/dist/host.c", "tests/dist/tube.c"].map(|source| root().join(source));
        done(
            Command::new("cc")
                .args(["-std=gnu11", "-O1", "-Wall", "-Wextra", "-Werror", "-I"])
                .arg(root().join("include"))
                .args(sources)
                .arg("-o")
                .arg(&program)
                .args(["-ldl", "-lpthread", "-lm"]),
        );
        program
    })
}

/// What the host printed.
#[track_caller]
pub fn run_host(words: &[&std::ffi::OsStr]) -> String {
    // A path for libraries that the caller has set would decide which TBB is found.
    done(Command::new(host()).args(words).env_remove("LD_LIBRARY_PATH").env_remove("LD_PRELOAD"))
}

/// The hash in its last line.
pub fn hash(printed: &str) -> &str {
    printed.lines().next_back().expect("the host prints a hash")
}
