//! The script for the editor's own Python.

use std::env;
use std::path::PathBuf;
use std::process::Command;

use testing::engine::{self, Engine};
use testing::library;
use testing::process::root;

#[test]
fn script_for_the_editors_python() {
    // As in the tests of the Python package.
    let environment = root().join("build/python/bin/python");
    let named = env::var_os("BESPOKE_PYTHON").map(PathBuf::from);
    let python = named.unwrap_or_else(|| if environment.exists() { environment } else { "python3".into() });
    let has_numpy = Command::new(&python).args(["-c", "import numpy"]).output();
    if !has_numpy.is_ok_and(|output| output.status.success()) {
        println!("SKIPPED: {} has no NumPy (make python-environment)", python.display());
        return;
    }
    // PyPI's stub of the editor's module has its name, and is read, not imported.
    let place = Command::new(&python)
        .args(["-c", "import sysconfig; print(sysconfig.get_paths()['purelib'], end='')"])
        .output()
        .expect("it has run before");
    let stub = PathBuf::from(String::from_utf8_lossy(&place.stdout).into_owned()).join("unreal");
    let paths = ["tests/unreal", "bindings/unreal/Bespoke/Content/Python", "bindings/python/src"];
    let output = Command::new(&python)
        .current_dir(root().join("tests/unreal"))
        .env("PYTHONPATH", env::join_paths(paths.map(|path| root().join(path))).expect("paths"))
        .env("PYTHONDONTWRITEBYTECODE", "1")
        .env("BESPOKE_LIBRARY", library::folder().join("libbespoke.so"))
        .env("BESPOKE_CHARACTERS", engine::folder(Engine::Unreal))
        .env("BESPOKE_UNREAL_STUB", stub)
        .args(["-m", "unittest", "--verbose", "test_script"])
        .output()
        .expect("it has run before");
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success() && !said.contains("Ran 0 tests"), "{said}");
    for line in said.lines().filter(|line| line.contains("skipped")) {
        println!("SKIPPED: {line}");
    }
}
