//! The C# binding, compiled and run by Debian's mono: its documentation is whole, its structs are those of C, and what
//! Cases.cs says of it holds; the sample comes out with the bits that it has here.

mod mono;
mod other_library;

use std::fs;
use std::path::Path;
use std::process::Command;

use mono::{binding, program};
use testing::library;
use testing::process::{root, scratch, succeed};
use testing::sample;

/// Runs one case of Cases.cs with the library in this folder.
fn case(name: &str, library: &Path) {
    if let Some(binding) = binding() {
        succeed(program(&binding.join("Cases.exe"), library).arg(name).arg(sample::folder()));
    }
}

/// A test for each case that is run with the library as it is.
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
    sample_is_dressed arrays_of_every_shape every_input every_result coordinate_systems rigs
    versions_and_names bad_arguments wrong_states busy
    progress steps cancel_by_token cancel_at_any_moment cancel_without_token failure_of_a_task
    dispose dispose_while_running control_outlives_session finalisers threads shared
}

/// Those that need another library, or none.
const FURTHER_CASES: &[&str] = &["other_interface", "no_library"];

#[test]
fn every_case_is_run() {
    if let Some(binding) = binding() {
        let listed = succeed(program(&binding.join("Cases.exe"), library::folder()).arg("--list"));
        let mut listed: Vec<&str> = listed.lines().collect();
        let mut run_here = [CASES, FURTHER_CASES].concat();
        listed.sort_unstable();
        run_here.sort_unstable();
        assert_eq!(listed, run_here);
    }
}

#[test]
fn another_binary_interface_is_refused() {
    case("other_interface", &other_library::folder());
}

#[test]
fn a_missing_library_is_the_exception_of_the_runtime() {
    case("no_library", &scratch("csharp-no-library"));
}

#[test]
fn structs_numbers_and_functions_are_those_of_c() {
    if let Some(binding) = binding() {
        let files = ["tests/capi/layout.inc", "include/bespoke.h"].map(|file| root().join(file));
        let said = succeed(program(&binding.join("Layout.exe"), library::folder()).args(files));
        assert!(said.contains(" structs, "), "{said}");
    }
}

#[test]
fn every_public_item_is_documented() {
    if let Some(binding) = binding() {
        // The compiler has refused items without; the file for editors lists what there is.
        let text = fs::read_to_string(binding.join("Bespoke.xml")).expect("the documentation");
        for item in
            ["T:Bespoke.Session", "M:Bespoke.Session.RunAsync", "P:Bespoke.Options.FitWeight", "F:Bespoke.Stage.Done"]
        {
            assert!(text.contains(item), "{item} is not there");
        }
    }
}

/// As for iOS and consoles, where nothing may be compiled while a program runs.
#[test]
fn all_of_it_compiles_ahead_of_time() {
    if let Some(binding) = binding() {
        let output = scratch("csharp-ahead").join("Bespoke.dll.so");
        let mut mono = Command::new("mono");
        let said =
            succeed(mono.arg(format!("--aot=full,outfile={}", output.display())).arg(binding.join("Bespoke.dll")));
        let compiled =
            said.lines().find_map(|line| line.strip_prefix("Compiled: ")).and_then(|line| line.split_once('/'));
        let (done, all) = compiled.unwrap_or_else(|| panic!("no count in {said}"));
        assert!(done == all && done.parse::<u32>().is_ok_and(|count| count > 100), "{said}");
        assert!(output.is_file());
    }
}

/// The example, from files to a file.
#[test]
fn example_dresses_files() {
    let Some(binding) = binding() else { return };
    let folder = scratch("csharp-dress");
    let inputs = sample::write_obj(&folder);
    let dress = || program(&binding.join("Dress.exe"), library::folder());
    let output = folder.join("dressed.obj");
    let said = succeed(dress().args(&inputs).arg(&output));
    for word in ["prepared", "inflate", "fit", "done", "verified, 0 + 0 intersections"] {
        assert!(said.contains(word), "{said}");
    }
    let [given, dressed] = [&inputs[0], &output].map(|path| fs::read_to_string(path).expect("a mesh"));
    assert_eq!(given.lines().count(), dressed.lines().count());
    for (before, after) in given.lines().zip(dressed.lines()) {
        assert_eq!(before == after, !before.starts_with("v "), "{before}\n{after}");
    }
    let positions: Vec<f32> = dressed
        .lines()
        .filter_map(|line| line.strip_prefix("v "))
        .flat_map(|line| line.split(' ').map(|word| word.parse::<f32>().expect("a number")))
        .collect();
    assert!(positions == sample::plainly_dressed(), "other bits than in Rust");

    // Errors are one sentence.
    fs::write(folder.join("bad.obj"), "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n").expect("a file");
    fs::write(folder.join("broken.obj"), "v 0 0\n").expect("a file");
    for (garment, words) in
        [("bad.obj", ["index 8", "InvalidMesh"]), ("broken.obj", ["line 1", "v 0 0"]), ("none.obj", ["none.obj", ""])]
    {
        let mut paths = inputs.clone();
        paths[0] = folder.join(garment);
        let refused = dress().args(&paths).arg(folder.join("nothing.obj")).output().expect("mono runs");
        let sentence = String::from_utf8_lossy(&refused.stderr);
        assert_eq!(refused.status.code(), Some(1), "{sentence}");
        assert!(sentence.starts_with("Dress: ") && sentence.matches('\n').count() == 1, "{sentence}");
        assert!(words.iter().all(|word| sentence.contains(word)), "{sentence}");
        assert!(!folder.join("nothing.obj").exists());
    }
}
