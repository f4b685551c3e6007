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
    let package_tests = "bindings/unity/Tests/Runtime/*.cs";
    let cases = ["tests/unity/*.cs", "tests/unity/stubs/NUnit.cs", package_tests, "tests/csharp/Check.cs"];
    library("Cases.exe", &[], &["Bespoke.dll", core], &cases);
    // The rest is compiled against stubs, which says that it is C# and fits together, and nothing about the engine.
    let is_library = &["-target:library"];
    library("UnityEngine.dll", is_library, &[], &["tests/unity/stubs/UnityEngine.cs"]);
    library("UnityEditor.dll", is_library, &["UnityEngine.dll"], &["tests/unity/stubs/UnityEditor.cs"]);
    library("nunit.framework.dll", is_library, &[], &["tests/unity/stubs/NUnit.cs"]);
    let engine = ["Bespoke.dll", core, "UnityEngine.dll"];
    let documented = format!("-doc:{}", folder.join("engine.xml").display());
    library("Bespoke.Unity.dll", &["-target:library", &documented], &engine, &["bindings/unity/Runtime/Engine/*.cs"]);
    let engine = [&engine[..], &["Bespoke.Unity.dll"]].concat();
    let editor = [&engine[..], &["UnityEditor.dll"]].concat();
    library("Bespoke.Unity.Editor.dll", is_library, &editor, &["bindings/unity/Editor/*.cs"]);
    library("Sample.dll", is_library, &engine, &["bindings/unity/Samples~/DressFromScript/*.cs"]);
    let tests = [&engine[..], &["nunit.framework.dll"]].concat();
    library("Bespoke.Unity.Tests.dll", is_library, &tests, &[package_tests]);
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
    dressed_as_in_rust goes_along turned stopped refused_and_over_it joint_map
    figures impossible_figures influences package_tests pairs transforms dials stages troubleshooting
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
