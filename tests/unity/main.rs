//! The Unity package as far as it goes without Unity: its engine-free half runs under Debian's mono and gives the bits of Rust, all
//! of its C# compiles against stubs of the types that it uses (tests/unity/stubs), and what is packed is laid out as the package
//! manager wants it.

mod package;

use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::OnceLock;

use testing::engine::{self, Engine};
use testing::library;
use testing::process::{is_there, root, scratch, succeed};

/// A folder with the assemblies of the package and the program of Cases.cs. None, and a line that says so, where there is no
/// mono.
fn assemblies() -> Option<&'static Path> {
    static FOLDER: OnceLock<Option<PathBuf>> = OnceLock::new();
    FOLDER.get_or_init(|| (is_there("mcs") && is_there("mono")).then(compile)).as_deref()
}

fn compile() -> PathBuf {
    let folder = scratch("unity-assemblies");
    let sources = |pattern: &str| root().join(pattern).display().to_string();
    let library = |name: &str, options: &[&str], references: &[&str], patterns: &[&str]| {
        let mut command = Command::new("mcs");
        command.args(["-langversion:7.2", "-warnaserror+", "-warn:4", "-r:System.Core"]).args(options);
        command.arg(format!("-out:{}", folder.join(name).display()));
        command.args(references.iter().map(|name| format!("-r:{}", folder.join(name).display())));
        succeed(command.args(patterns.iter().map(|pattern| sources(pattern))));
    };
    let core = "Bespoke.Unity.Core.dll";
    library("Bespoke.dll", &["-target:library", "-unsafe"], &[], &["bindings/csharp/Bespoke/*.cs"]);
    let documented = format!("-doc:{}", folder.join("core.xml").display());
    library(core, &["-target:library", &documented], &["Bespoke.dll"], &["bindings/unity/Runtime/Core/*.cs"]);
    let cases = ["tests/unity/*.cs", "tests/csharp/Check.cs"];
    library("Cases.exe", &[], &["Bespoke.dll", core], &cases);
    folder
}

fn case(name: &str, library: &Path) {
    if let Some(folder) = assemblies() {
        let mut mono = Command::new("mono");
        mono.env("LD_LIBRARY_PATH", library).env("DYLD_LIBRARY_PATH", library).arg("--debug");
        mono.arg(folder.join("Cases.exe")).arg(name).arg(engine::folder(Engine::Unity)).arg(root());
        succeed(&mut mono);
    }
}

macro_rules! cases {
    ($($name:ident)*) => {
        const CASES: &[&str] = &[$(stringify!($name)),*];
        $(
            #[test]
            fn $name() {
                case(stringify!($name), library::folder());
            }
        )*
    };
}

cases! {
    dressed_as_in_rust stopped refused_and_over_it joint_map
    figures impossible_figures influences pairs transforms dials stages troubleshooting
}

#[test]
fn a_missing_library_is_a_defect_and_no_crash() {
    case("no_library", &scratch("unity-no-library"));
}

#[test]
fn every_case_is_run() {
    let Some(folder) = assemblies() else { return };
    let listed = succeed(Command::new("mono").arg(folder.join("Cases.exe")).arg("--list"));
    let mut listed: Vec<&str> = listed.lines().collect();
    let mut run_here = [CASES, &["no_library"]].concat();
    listed.sort_unstable();
    run_here.sort_unstable();
    assert_eq!(listed, run_here);
}
