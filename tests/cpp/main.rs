//! The header for C++, compiled and run as programs in C++ do, and its example.

mod dress;
mod header;

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use testing::library;
use testing::process::root;

/// Warnings that a program may ask for, and has to get none.
const WARNINGS: &[&str] = &[
    "-pedantic",
    "-Wall",
    "-Wextra",
    "-Werror",
    "-Wconversion",
    "-Wsign-conversion",
    "-Wshadow",
    "-Wold-style-cast",
    "-Wnon-virtual-dtor",
];

/// A compiler and how it is told to compile.
struct Flavour {
    name: &'static str,
    compiler: &'static str,
    flags: &'static [&'static str],
}

const GCC: Flavour = Flavour { name: "gcc", compiler: "g++", flags: &["-std=c++17"] };
const GCC_WITHOUT: Flavour =
    Flavour { name: "gcc-without", compiler: "g++", flags: &["-std=c++17", "-fno-exceptions", "-fno-rtti"] };
const GCC_20: Flavour = Flavour { name: "gcc-20", compiler: "g++", flags: &["-std=c++20"] };
const CLANG: Flavour = Flavour { name: "clang", compiler: "clang++", flags: &["-std=c++17"] };
const CLANG_WITHOUT: Flavour =
    Flavour { name: "clang-without", compiler: "clang++", flags: &["-std=c++17", "-fno-exceptions", "-fno-rtti"] };
const CLANG_20: Flavour = Flavour { name: "clang-20", compiler: "clang++", flags: &["-std=c++20"] };
const SANITIZED: Flavour = Flavour {
    name: "sanitized",
    compiler: "g++",
    flags: &["-std=c++17", "-g", "-fsanitize=address,undefined", "-fno-sanitize-recover=all"],
};

impl Flavour {
    /// The program that these sources make, with headers from `include`; none where there is no such compiler.
    fn compile(&self, program: &str, sources: &[PathBuf], include: &Path) -> Option<PathBuf> {
        let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("cpp-{program}-{}", self.name));
        let library = library::folder();
        let run = Command::new(self.compiler)
            .args(self.flags)
            .args(WARNINGS)
            .arg("-I")
            .arg(include)
            .args(sources)
            .arg("-o")
            .arg(&path)
            .arg(format!("-L{}", library.display()))
            .args(["-lbespoke", "-pthread"])
            .arg(format!("-Wl,-rpath,{}", library.display()))
            .output();
        match run {
            Err(reason) => {
                println!("SKIPPED: {} cannot be run: {reason}", self.compiler);
                None
            }
            Ok(output) => {
                assert!(output.status.success(), "{}: {}", self.name, String::from_utf8_lossy(&output.stderr));
                Some(path)
            }
        }
    }

    /// The program of all the tests in C++ comes to its end, and each mistake ends it with a sentence.
    fn passes(&self, names: &[&str]) {
        let folder = root().join("tests/cpp");
        let sources: Vec<_> = names.iter().map(|name| folder.join(name)).collect();
        let Some(program) = self.compile("tests", &sources, &root().join("include")) else { return };
        let whole = run(&program, &[]);
        assert!(whole.status.success(), "{}: {}", self.name, String::from_utf8_lossy(&whole.stderr));
        assert_eq!(String::from_utf8_lossy(&whole.stdout), "all good\n");
        for (mistake, sentence) in [
            ("value", "bespoke: value of a result without a value: not now\n"),
            ("star", "bespoke: value of a result without a value: not now\n"),
            ("void", "bespoke: value of a result without a value: not now\n"),
            ("session", "bespoke: value of a result without a value: not now\n"),
            ("error", "bespoke: error() of a result without an error\n"),
        ] {
            let ended = run(&program, &[mistake]);
            assert!(!ended.status.success(), "{}: {mistake} does not end the program", self.name);
            let said = String::from_utf8_lossy(&ended.stderr);
            assert!(said.starts_with(sentence), "{}: {mistake}: {said}", self.name);
        }
    }
}

/// An object for each file: `bespoke.hpp` goes into several of one program.
const APART: &[&str] =
    &["main.cpp", "views.cpp", "results.cpp", "inputs.cpp", "rigs.cpp", "sessions.cpp", "stops.cpp", "follow.cpp"];

/// The same in two objects, in half the time: most of it goes to the headers of the standard library.
const TOGETHER: &[&str] = &["together.cpp", "views.cpp"];

/// Runs a program as a shell would, whatever this process was told about Ctrl-C.
fn command(program: &Path) -> Command {
    let mut command = Command::new("env");
    command.arg("--default-signal=INT").arg(program);
    command.env("ASAN_OPTIONS", "detect_leaks=1").env("UBSAN_OPTIONS", "print_stacktrace=1");
    command
}

fn run(program: &Path, arguments: &[&str]) -> Output {
    command(program).args(arguments).output().expect("what was compiled can be run")
}

#[test]
fn gcc_17() {
    GCC.passes(APART);
}

#[test]
fn gcc_without_exceptions_and_rtti() {
    GCC_WITHOUT.passes(TOGETHER);
}

#[test]
fn gcc_20() {
    GCC_20.passes(TOGETHER);
}

#[test]
fn clang_17() {
    CLANG.passes(APART);
}

#[test]
fn clang_without_exceptions_and_rtti() {
    CLANG_WITHOUT.passes(TOGETHER);
}

#[test]
fn clang_20() {
    CLANG_20.passes(TOGETHER);
}

#[test]
fn address_and_undefined_behaviour_sanitizers() {
    SANITIZED.passes(TOGETHER);
}
