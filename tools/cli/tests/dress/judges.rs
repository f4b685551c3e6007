//! Programs of others that judge the files that are written.

use std::path::Path;
use std::process::Command;

use serde_json::Value;

/// glTF's own validator finds no error in the files. Where Node or the package cannot be had, that is said.
#[track_caller]
pub fn valid(files: &[&Path]) {
    let home = Path::new(env!("CARGO_TARGET_TMPDIR")).join("judges");
    std::fs::create_dir_all(&home).unwrap();
    let sources = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/judges");
    for name in ["package.json", "package-lock.json", "validate.mjs"] {
        std::fs::copy(sources.join(name), home.join(name)).unwrap();
    }
    let install =
        Command::new("npm").args(["ci", "--ignore-scripts", "--no-audit", "--no-fund"]).current_dir(&home).output();
    match install {
        Ok(run) if run.status.success() => {}
        Ok(run) => {
            println!("SKIPPED: gltf-validator cannot be had: {}", String::from_utf8_lossy(&run.stderr));
            return;
        }
        Err(reason) => {
            println!("SKIPPED: gltf-validator: npm cannot be run: {reason}");
            return;
        }
    }
    let run = Command::new("node").arg("validate.mjs").args(files).current_dir(&home).output().unwrap();
    assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
    let lines: Vec<Value> =
        String::from_utf8_lossy(&run.stdout).lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    assert_eq!(lines.len(), files.len());
    for line in lines {
        assert!(line["errors"].as_array().unwrap().is_empty(), "{line}");
    }
}
