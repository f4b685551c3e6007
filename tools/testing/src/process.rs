//! Programs that tests run, and where.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The project's folder.
pub fn root() -> &'static Path {
    let this_crate = Path::new(env!("CARGO_MANIFEST_DIR"));
    this_crate.ancestors().nth(2).expect("this crate lies in a folder of the project")
}

/// The program that runs.
pub(crate) fn this_program() -> PathBuf {
    std::env::current_exe().expect("a running program has a path")
}

/// What it is called in Cargo.toml.
pub(crate) fn this_program_name() -> String {
    let program = this_program();
    let name = program.file_stem().expect("a name").to_string_lossy();
    // Cargo ends it with a hash.
    name.rsplit_once('-').map_or(&*name, |(name, _)| name).to_string()
}

/// The folder that cargo calls `CARGO_TARGET_TMPDIR` while it builds tests, and tells no library: they lie in `deps` of
/// a profile's folder, which it is beside.
pub(crate) fn temporary() -> PathBuf {
    this_program().ancestors().nth(3).expect("cargo built this program").join("tmp")
}

/// An empty folder for one test.
pub fn scratch(name: &str) -> PathBuf {
    let folder = temporary().join(name);
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).expect("a folder for the test");
    folder
}

/// Whether the program is on this machine; `make test` installs those that the tests need.
pub fn is_there(program: &str) -> bool {
    let is_there = Command::new(program).arg("--version").output().is_ok();
    if !is_there {
        println!("SKIPPED: there is no {program}");
    }
    is_there
}

/// What a program said that has to end well.
#[track_caller]
pub fn succeed(command: &mut Command) -> String {
    let output = command.output().unwrap_or_else(|reason| panic!("{command:?} cannot be run: {reason}"));
    let [said, complained] = [&output.stdout, &output.stderr].map(|text| String::from_utf8_lossy(text).into_owned());
    assert!(output.status.success(), "{command:?} ended with {}\n{said}\n{complained}", output.status);
    said
}
