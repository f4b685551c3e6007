//! The C programs of these tests, compiled once.

use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::OnceLock;

use testing::process::{root, scratch, succeed};

/// host.c: a process that loads the library as a plugin.
pub fn host() -> &'static Path {
    static HOST: OnceLock<PathBuf> = OnceLock::new();
    HOST.get_or_init(|| {
        let program = scratch("dist-host").join("host");
        let sources = ["tests/dist/host.c", "tests/dist/tube.c"].map(|source| root().join(source));
        succeed(
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

/// starve.c: lets threads fail in the process into which it is loaded first.
pub fn starve() -> &'static Path {
    static STARVE: OnceLock<PathBuf> = OnceLock::new();
    STARVE.get_or_init(|| {
        let library = scratch("dist-starve").join("starve.so");
        let mut command = Command::new("cc");
        command.args(["-std=gnu11", "-O1", "-Wall", "-Wextra", "-Werror", "-shared", "-fPIC"]);
        succeed(command.arg(root().join("tests/dist/starve.c")).arg("-o").arg(&library).arg("-ldl"));
        library
    })
}

/// What the host printed. Nothing may be said on the standard error: it belongs to the host.
#[track_caller]
pub fn run_host(words: &[&OsStr]) -> String {
    run_host_with(words, &[])
}

/// The same with variables of the environment.
#[track_caller]
pub fn run_host_with(words: &[&OsStr], variables: &[(&str, &OsStr)]) -> String {
    // A path for libraries that the caller has set would decide which TBB is found.
    let mut command = Command::new(host());
    command.args(words).env_remove("LD_LIBRARY_PATH").env_remove("LD_PRELOAD").env_remove("TBB_VERSION");
    command.envs(variables.iter().copied());
    let output = command.output().expect("the host can be run");
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success() && errors.is_empty(), "{command:?}: {}\n{errors}", output.status);
    String::from_utf8(output.stdout).expect("the host prints text")
}

/// The hash in its last line.
pub fn hash(printed: &str) -> &str {
    printed.lines().next_back().expect("the host prints a hash")
}
