//! The Python package, run by an interpreter with NumPy: what tests/python/*.py say of it holds with the library that was
//! built beside these tests, and the sample comes out with the bits that it has here and in C.
//!
//! BESPOKE_WHEEL names the folder in which `make wheel` has left one, which is then tried as well. BESPOKE_PYTHON names the interpreter (`make test` makes an environment with all that is tried); without it, that of
//! `make python-environment` is taken, or else the system's. Without NumPy all of this is skipped.

mod wheel;

use std::env;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::OnceLock;

use closet::{Kind, files};
use testing::library;
use testing::process::{root, scratch, succeed};
use testing::retarget;
use testing::sample;

/// An interpreter that has NumPy.
fn interpreter() -> Option<&'static Path> {
    static PATH: OnceLock<Option<PathBuf>> = OnceLock::new();
    PATH.get_or_init(|| {
        let environment = root().join("build/python/bin/python");
        let named = env::var_os("BESPOKE_PYTHON").map(PathBuf::from);
        let path = named.unwrap_or_else(|| if environment.exists() { environment } else { "python3".into() });
        let has_numpy = Command::new(&path).args(["-c", "import numpy"]).output();
        if has_numpy.is_ok_and(|output| output.status.success()) {
            return Some(path);
        }
        println!("SKIPPED: {} has no NumPy (make python-environment)", path.display());
        None
    })
    .as_deref()
}

/// The interpreter with the package from the sources, in the folder of the tests.
fn python(path: &Path) -> Command {
    let mut command = Command::new(path);
    command.current_dir(root().join("tests/python"));
    command.env("PYTHONPATH", root().join("bindings/python/src")).env("PYTHONDONTWRITEBYTECODE", "1");
    let library = library::folder().join(if cfg!(target_os = "macos") { "libbespoke.dylib" } else { "libbespoke.so" });
    command.env("BESPOKE_LIBRARY", library).env("BESPOKE_SAMPLE", sample::folder());
    command
}

/// Runs all tests of one file, and repeats what it skips.
fn passes(module: &str, variables: &[(&str, &Path)]) {
    let Some(path) = interpreter() else { return };
    let output = python(path)
        .envs(variables.iter().copied())
        .args(["-m", "unittest", "--verbose", module])
        .output()
        .expect("it has run before");
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{module}: {}\n{said}", output.status);
    assert!(!said.contains("Ran 0 tests"), "{module}: {said}");
    for line in said.lines().filter(|line| line.contains("skipped")) {
        println!("SKIPPED: {module}: {line}");
    }
}

/// A test for each file.
macro_rules! modules {
    ($($name:ident)*) => {
        const MODULES: &[&str] = &[$(stringify!($name)),*, "test_bits", "test_dress"];
        $(
            #[test]
            fn $name() {
                passes(stringify!($name), &[]);
            }
        )*
    };
}

modules! { test_layout test_views test_session test_running test_lifetime test_typing test_usd }

/// What `make demo` dresses, and docs/python.md.
fn demo() -> PathBuf {
    let folder = scratch("python-demo");
    for name in ["jacket", "heavy", "creature"] {
        fs::create_dir_all(folder.join(name)).expect("a folder");
    }
    let write = |kind: Kind, mesh: &str, bones: &str| {
        let sample = closet::sample(kind);
        let [mesh, bones] = [mesh, bones].map(|name| folder.join(name));
        let written = match kind {
            Kind::Jacket => files::write_garment(&mesh, "jacket", &sample.mesh, &sample.texture),
            _ => files::write_mesh(&mesh, &sample.mesh),
        };
        written.and_then(|()| files::write_skeleton(&bones, &sample.skeleton)).expect("the folder can be written");
    };
    write(Kind::Jacket, "jacket/garment.obj", "skeleton.obj");
    write(Kind::Mannequin, "mannequin.obj", "skeleton.obj");
    write(Kind::Heavy, "heavy/avatar.obj", "heavy/skeleton.obj");
    write(Kind::Creature, "creature/avatar.obj", "creature/skeleton.obj");
    folder
}

#[test]
fn test_dress() {
    passes("test_dress", &[("BESPOKE_DEMO", demo().as_path())]);
}

#[test]
fn every_file_is_run() {
    let files = fs::read_dir(root().join("tests/python")).expect("the folder");
    let mut found: Vec<_> = files
        .filter_map(|entry| entry.expect("an entry").file_name().into_string().ok())
        .filter_map(|name| name.strip_suffix(".py").map(str::to_string))
        .filter(|name| name.starts_with("test_"))
        .collect();
    let mut run_here = MODULES.to_vec();
    found.sort_unstable();
    run_here.sort_unstable();
    assert_eq!(found, run_here);
}

#[test]
fn same_bits_as_in_rust_and_c() {
    let Some(path) = interpreter() else { return };
    let folder = scratch("python-retargeted");
    let inputs = sample::write_obj(&folder);
    let [garment, source, avatar, target] = inputs.as_slice() else { panic!("four files") };
    let mut program = Command::new(retarget::program());
    program.arg("--garment").arg(garment).arg("--source-skeleton").arg(source).arg("--avatar").arg(avatar);
    succeed(program.arg("--target-skeleton").arg(target).arg("-o").arg(folder.join("dressed.obj")));
    let mut tests = python(path);
    let output = tests.env("BESPOKE_RETARGETED", &folder).args(["-m", "unittest", "--verbose", "test_bits"]).output();
    let output = output.expect("it has run before");
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success() && !said.contains("skipped"), "{said}");
}
