//! Programs of others that judge the files that are written.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::LazyLock;

use serde_json::Value;

/// A folder with the judges that run in Node; none where Node or a package cannot be had, which is said.
static NODE: LazyLock<Option<PathBuf>> = LazyLock::new(|| {
    let home = Path::new(env!("CARGO_TARGET_TMPDIR")).join("judges");
    std::fs::create_dir_all(&home).unwrap();
    let sources = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/judges");
    for name in ["package.json", "package-lock.json", "validate.mjs", "three.mjs"] {
        std::fs::copy(sources.join(name), home.join(name)).unwrap();
    }
    let install =
        Command::new("npm").args(["ci", "--ignore-scripts", "--no-audit", "--no-fund"]).current_dir(&home).output();
    match install {
        Ok(run) if run.status.success() => Some(home),
        Ok(run) => {
            println!("SKIPPED: gltf-validator and three.js cannot be had: {}", String::from_utf8_lossy(&run.stderr));
            None
        }
        Err(reason) => {
            println!("SKIPPED: gltf-validator and three.js: npm cannot be run: {reason}");
            None
        }
    }
});

/// What a program prints, a line of JSON after the other. Lines that are none are for people.
fn lines(command: &mut Command) -> Vec<Value> {
    let run = command.output().unwrap();
    assert!(run.status.success(), "{command:?}: {}", String::from_utf8_lossy(&run.stderr));
    let text = String::from_utf8_lossy(&run.stdout);
    text.lines().filter(|line| line.starts_with('{')).map(|line| serde_json::from_str(line).unwrap()).collect()
}

/// glTF's own validator finds no error in the files. Where Node or the package cannot be had, that is said.
#[track_caller]
pub fn valid(files: &[&Path]) {
    let Some(home) = &*NODE else { return };
    let lines = lines(Command::new("node").arg("validate.mjs").args(files).current_dir(home));
    assert_eq!(lines.len(), files.len());
    for line in lines {
        assert!(line["errors"].as_array().unwrap().is_empty(), "{line}");
    }
}

/// What three.js and its VRM plugin see at times of an animation, see three.mjs.
pub fn three(file: &Path, animation: &str, times: &[f64]) -> Option<Value> {
    let home = NODE.as_ref()?;
    let times = times.iter().map(f64::to_string);
    let found = lines(Command::new("node").arg("three.mjs").arg(file).arg(animation).args(times).current_dir(home));
    found.into_iter().next()
}

/// What Blender sees at times of a file's only animation, see blender.py. `BESPOKE_BLENDER` is the interpreter that has Blender as
/// a module.
pub fn blender(file: &Path, times: &[f64]) -> Option<Value> {
    let Ok(python) = std::env::var("BESPOKE_BLENDER") else {
        println!("SKIPPED: Blender as a judge: BESPOKE_BLENDER is not set (`make test` sets it)");
        return None;
    };
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/judges/blender.py");
    let times = times.iter().map(f64::to_string);
    lines(Command::new(python).arg(script).arg(file).args(times)).into_iter().next()
}
