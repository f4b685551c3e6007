//! The wheel as it is installed: what is in it, for which systems it says it is, and that it dresses by itself.

use std::env;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use testing::process::{root, scratch, succeed};
use testing::sample;

use crate::interpreter;

/// The wheel, if there is one to try.
fn wheel() -> Option<PathBuf> {
    let Some(folder) = env::var_os("BESPOKE_WHEEL") else {
        println!("SKIPPED: BESPOKE_WHEEL names no folder with a wheel (make wheel)");
        return None;
    };
    let files = fs::read_dir(&folder).expect("BESPOKE_WHEEL is a folder").map(|entry| entry.expect("an entry").path());
    let wheels: Vec<_> = files.filter(|path| path.extension().is_some_and(|end| end == "whl")).collect();
    assert_eq!(wheels.len(), 1, "{folder:?} holds one wheel: {wheels:?}");
    wheels.into_iter().next()
}

/// The newest version of the C library that a shared library asks for.
fn glibc(library: &Path) -> (u32, u32) {
    let text = succeed(Command::new("objdump").arg("-T").arg(library));
    let versions = text.split("GLIBC_").skip(1).filter_map(|rest| {
        let mut numbers = rest.split([')', ' ']).next()?.split('.').map(str::parse::<u32>);
        Some((numbers.next()?.ok()?, numbers.next()?.ok()?))
    });
    versions.max().expect("it asks for the C library")
}

#[test]
fn installed_it_dresses_by_itself() {
    let (Some(path), Some(wheel)) = (interpreter(), wheel()) else { return };
    let name = wheel.file_name().expect("a name").to_string_lossy().into_owned();
    let site = scratch("python-wheel");
    let mut install = Command::new(path);
    install.args(["-m", "pip", "--quiet", "--disable-pip-version-check", "install", "--no-deps", "--no-index"]);
    succeed(install.arg("--target").arg(&site).arg(&wheel));

    let library = site.join("bespoke/libbespoke.so");
    let (major, minor) = glibc(&library).max(glibc(&site.join("bespoke/bin/bespoke")));
    assert!(name.ends_with(&format!("-py3-none-manylinux_{major}_{minor}_{}.whl", env::consts::ARCH)), "{name}");
    // All sources of the package, and no others.
    let names = |folder: &Path| {
        let files = fs::read_dir(folder).expect("a folder").map(|entry| entry.expect("an entry").file_name());
        let mut names: Vec<_> =
            files.filter(|name| name != "__pycache__" && name != "libbespoke.so" && name != "bin").collect();
        names.sort_unstable();
        names
    };
    assert_eq!(names(&site.join("bespoke")), names(&root().join("bindings/python/src/bespoke")));
    // The texts that come with what is inside of the library.
    let licences = fs::read_dir(&site).expect("a folder").map(|entry| entry.expect("an entry").path());
    let licences = licences.filter(|path| path.extension().is_some_and(|end| end == "dist-info")).last();
    let licences = licences.expect("what pip knows of it").join("licenses");
    for text in ["LICENSE-MIT", "LICENSE-APACHE", "licences/README.md", "licences/openvdb/LICENSE"] {
        assert!(licences.join(text).is_file(), "{text} is not in the wheel");
    }

    let mut tests = Command::new(path);
    tests.current_dir(root().join("tests/python")).env("PYTHONPATH", &site).env("PYTHONDONTWRITEBYTECODE", "1");
    tests.env_remove("BESPOKE_LIBRARY").env("BESPOKE_SAMPLE", sample::folder());
    succeed(tests.args(["-m", "unittest", "test_bits", "test_views"]));
    // The program for files, by its module and by the name that pip gives it.
    let mut program = Command::new(path);
    let said = succeed(program.env("PYTHONPATH", &site).args(["-m", "bespoke", "--version"]));
    assert_eq!(said.trim(), concat!("bespoke ", env!("CARGO_PKG_VERSION")));
    let mut program = Command::new(path);
    program.env("PYTHONPATH", &site).args(["-m", "bespoke", "dress", "no-such-file.glb"]);
    assert_eq!(program.output().expect("Python runs").status.code(), Some(2), "a missing argument is a fault of usage");
    assert!(site.join("bin/bespoke").is_file(), "pip makes no program bespoke");
    let mut place = Command::new(path);
    place.env("PYTHONPATH", &site).env_remove("BESPOKE_LIBRARY");
    let said =
        succeed(place.args(["-c", "import bespoke; print(bespoke.library_path()); print(bespoke.library_version())"]));
    assert_eq!(said.lines().collect::<Vec<_>>(), [library.to_str().expect("a path"), env!("CARGO_PKG_VERSION")]);
}
