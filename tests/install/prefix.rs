//! A place to install in, and the script that does it.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::OnceLock;

use testing::library;
use testing::process::{root, scratch, succeed};

/// An empty folder for one test, with a blank in its name.
pub fn folder(test: &str) -> PathBuf {
    scratch(&format!("install of {test}"))
}

/// A command that knows of no library, prefix or package but those it is told about.
pub fn command(program: impl AsRef<std::ffi::OsStr>) -> Command {
    let mut command = Command::new(program);
    for name in [
        "DESTDIR",
        "PREFIX",
        "BINDIR",
        "LIBDIR",
        "INCLUDEDIR",
        "DOCDIR",
        "STRIP",
        "LD_LIBRARY_PATH",
        "PKG_CONFIG_PATH",
        "PKG_CONFIG_LIBDIR",
        "CMAKE_PREFIX_PATH",
        "Bespoke_DIR",
        "CFLAGS",
        "CXXFLAGS",
        "LDFLAGS",
        "MAKEFLAGS",
        "MAKELEVEL",
    ] {
        command.env_remove(name);
    }
    command
}

/// The script, to which an action is still to be told.
fn script() -> Command {
    let mut script = command("sh");
    script.arg(root().join("packaging/install.sh"));
    script
}

/// The library that was built beside the tests, and the program, compiled with the run path that the script says.
fn built() -> [&'static Path; 2] {
    static PROGRAM: OnceLock<PathBuf> = OnceLock::new();
    static LIBRARY: OnceLock<PathBuf> = OnceLock::new();
    let library = LIBRARY.get_or_init(|| library::folder().join("libbespoke.so"));
    let program = PROGRAM.get_or_init(|| {
        let program = Path::new(env!("CARGO_TARGET_TMPDIR")).join("install-retarget");
        let entries = fs::read_dir(root().join("examples_c")).expect("examples_c exists");
        let sources = entries.map(|entry| entry.expect("an entry").path());
        succeed(
            command("cc")
                .args(["-std=c99", "-g", "-I"])
                .arg(root().join("include"))
                .args(sources.filter(|path| path.extension() == Some("c".as_ref())))
                .arg("-o")
                .arg(&program)
                .arg(format!("-L{}", library::folder().display()))
                .args(["-lbespoke", "-lm"])
                .arg(format!("-Wl,-rpath,$ORIGIN/{}", succeed(script().arg("run-path")))),
        );
        program
    });
    [library, program]
}

/// Installs there, with these further variables.
pub fn installer(prefix: &Path, variables: &[(&str, &str)]) -> Command {
    let mut installer = script();
    installer.arg("install").args(built()).env("PREFIX", prefix).envs(variables.iter().copied());
    installer
}

#[track_caller]
pub fn install(prefix: &Path, variables: &[(&str, &str)]) {
    let said = succeed(&mut installer(prefix, variables));
    assert!(said.contains(env!("CARGO_PKG_VERSION")), "{said}");
}

#[track_caller]
pub fn uninstall(prefix: &Path, variables: &[(&str, &str)]) {
    succeed(script().arg("uninstall").env("PREFIX", prefix).envs(variables.iter().copied()));
}

/// The script fails, and says a sentence with these words.
#[track_caller]
pub fn refused(command: &mut Command, words: &[&str]) -> Output {
    let output = command.output().expect("sh can be run");
    let sentence = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(!output.status.success(), "it went well: {}", String::from_utf8_lossy(&output.stdout));
    let last = sentence.lines().last().unwrap_or_default();
    assert!(last.starts_with("install.sh: "), "no sentence: {sentence}");
    for word in words {
        assert!(last.contains(word), "\"{last}\" does not hold \"{word}\"");
    }
    output
}

/// All that lies below a folder, by its path from there: files, links and, with a slash at the end, empty folders.
pub fn tree(folder: &Path) -> BTreeSet<String> {
    let mut found = BTreeSet::new();
    let mut waiting = vec![folder.to_owned()];
    while let Some(here) = waiting.pop() {
        let entries: Vec<_> = fs::read_dir(&here).expect("a folder").map(|e| e.expect("an entry").path()).collect();
        let name = |path: &Path| path.strip_prefix(folder).expect("below the folder").display().to_string();
        if entries.is_empty() && here != folder {
            found.insert(name(&here) + "/");
        }
        for path in entries {
            if path.is_dir() && !path.is_symlink() {
                waiting.push(path);
            } else {
                found.insert(name(&path));
            }
        }
    }
    found
}

/// The file name of the library, such as `libbespoke.so.2.0.1.0`.
pub fn library_file() -> String {
    format!("{}.{}", library_name(), env!("CARGO_PKG_VERSION"))
}

/// The name by which the loader looks for it.
pub fn library_name() -> String {
    format!("libbespoke.so.{}", bespoke::capi::version::BESPOKE_ABI_VERSION)
}
