//! The library as a plugin: beside another TBB, closed and opened again, and twice in one process.

use std::ffi::OsStr;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::programs::{hash, run_host};
use crate::shipped::libraries;
use testing::process::{root, scratch, succeed};

/// A TBB that a host may bring along.
struct Tbb {
    version: String,
    library: PathBuf,
    /// Of an interface that Debian's headers do not describe.
    headers: Option<PathBuf>,
}

fn below(folder: &Path, name: &str) -> Option<PathBuf> {
    let found = succeed(Command::new("find").arg(folder).args(["-name", name, "-print", "-quit"]));
    found.lines().next().map(PathBuf::from)
}

fn tbbs() -> Vec<Tbb> {
    let Some(folder) = std::env::var_os("BESPOKE_TBB") else {
        println!("SKIPPED: hosts with a TBB of their own (sh tests/dist/tbb.sh FOLDER, and name it in BESPOKE_TBB)");
        return Vec::new();
    };
    let mut tbbs = Vec::new();
    for entry in fs::read_dir(&folder).expect("the folder BESPOKE_TBB") {
        let folder = entry.expect("an entry").path();
        let library = below(&folder, "libtbb.so.12").or_else(|| below(&folder, "libtbb.so.2"));
        let version = folder.file_name().expect("a version").to_string_lossy().into_owned();
        let library = library.unwrap_or_else(|| panic!("there is no libtbb in {}", folder.display()));
        tbbs.push(Tbb { version, library, headers: below(&folder, "include") });
    }
    assert!(tbbs.len() >= 2, "{} does not hold several versions of TBB", Path::new(&folder).display());
    tbbs
}

/// work.cpp, for this TBB.
fn work(tbb: &Tbb) -> PathBuf {
    let module = scratch(&format!("dist-work-{}", tbb.version)).join("work.so");
    let mut command = Command::new("c++");
    if let Some(headers) = &tbb.headers {
        command.arg("-isystem").arg(headers);
    }
    // The old headers use what C++17 has removed.
    command.args(["-std=c++14", "-O1", "-Wall", "-Wextra", "-Werror", "-shared", "-fPIC"]);
    succeed(command.arg(root().join("tests/dist/work.cpp")).arg("-o").arg(&module));
    module
}

/// What comes out where nothing else is in the process.
fn alone(library: &Path) -> String {
    hash(&run_host(&["plain".as_ref(), library.as_os_str()])).to_owned()
}

/// Every file of TBB that the host had in memory at its end.
fn loaded(printed: &str) -> Vec<PathBuf> {
    printed.lines().filter_map(|line| line.strip_prefix("loaded ")).map(PathBuf::from).collect()
}

#[test]
fn beside_another_tbb_the_bits_are_the_same() {
    for tbb in tbbs() {
        let module = work(&tbb);
        for (name, library) in libraries() {
            let expected = alone(&library);
            for scope in ["local", "global"] {
                let words = [library.as_os_str(), tbb.library.as_os_str(), module.as_os_str(), OsStr::new(scope)];
                let printed = run_host(&[&["tbb".as_ref()], &words[..]].concat());
                let version = &tbb.version;
                let hashes = printed.lines().filter(|line| !line.starts_with("loaded "));
                for hash in hashes {
                    assert_eq!(hash, expected, "the {name} library beside TBB {version}, {scope}");
                }
                // Only the library that brings none along may lead to a second TBB.
                if name == "shipped" {
                    let home = tbb.library.parent().expect("a folder").canonicalize().expect("it is there");
                    for file in loaded(&printed) {
                        assert!(file.starts_with(&home), "{} was loaded beside TBB {version}", file.display());
                    }
                }
            }
        }
    }
}

#[test]
fn the_shipped_library_loads_no_tbb() {
    for (name, library) in libraries() {
        let loaded = loaded(&run_host(&["plain".as_ref(), library.as_os_str()]));
        // The other one shows that the question has an answer.
        assert_eq!(loaded.is_empty(), name == "shipped", "the {name} library loads {loaded:?}");
    }
}

#[test]
fn it_is_closed_and_opened_again() {
    for (name, library) in libraries() {
        let printed = run_host(&["reopen".as_ref(), library.as_os_str()]);
        assert_eq!(hash(&printed), alone(&library), "the {name} library");
        let threads = printed.lines().find_map(|line| line.strip_prefix("threads ")).expect("a number of threads");
        let threads: usize = threads.parse().expect("a number");
        // The main thread. Debian's OpenVDB brings a logger with its own.
        assert!(name != "shipped" || threads == 1, "{threads} threads are left");
    }
}

/// The library and a copy of its file.
fn copies(test: &str) -> Vec<(&'static str, PathBuf, PathBuf)> {
    let with_copy = |(name, library): (&'static str, PathBuf)| {
        let copy = scratch(&format!("dist-{test}-{name}")).join("libbespoke.so");
        fs::copy(&library, &copy).expect("a copy of the library");
        // As it is called in the list of what is in memory.
        (name, library.canonicalize().expect("the library is there"), copy)
    };
    libraries().into_iter().map(with_copy).collect()
}

#[test]
fn two_copies_work_at_once() {
    for (name, library, copy) in copies("copies") {
        let printed = run_host(&["copies".as_ref(), library.as_os_str(), copy.as_os_str()]);
        assert_eq!(hash(&printed), alone(&library), "two copies of the {name} library");
    }
}

#[test]
fn no_copy_calls_into_another() {
    for (name, library, copy) in copies("apart") {
        let printed = run_host(&["apart".as_ref(), library.as_os_str(), copy.as_os_str()]);
        assert_eq!(hash(&printed), alone(&library), "the second copy of the {name} library");
    }
}
