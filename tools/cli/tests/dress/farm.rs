//! A batch as a job of a render farm: the template is valid, and what `openjd run` makes of it are the results of single calls.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use testing::process::{root, succeed};

use super::batch::{all_there, four_pairs, lines};
use super::files::folder;

/// The program of the Python package openjd-cli, in an environment of its own, which is made once.
fn openjd() -> Option<PathBuf> {
    let environment = Path::new(env!("CARGO_TARGET_TMPDIR")).join("openjd");
    let program = environment.join("bin/openjd");
    let works = || Command::new(&program).arg("--version").output().is_ok_and(|output| output.status.success());
    if !works() {
        let _ = fs::remove_dir_all(&environment);
        let made = Command::new("python3").args(["-m", "venv"]).arg(&environment).output();
        let install =
            ["--quiet", "--disable-pip-version-check", "install", "--only-binary=:all:", "openjd-cli>=0.7,<1"];
        let installed = Command::new(environment.join("bin/pip")).args(install).output();
        if !(made.is_ok_and(|m| m.status.success()) && installed.is_ok_and(|i| i.status.success()) && works()) {
            println!("SKIPPED: the job template for render farms, for openjd-cli cannot be had from PyPI");
            return None;
        }
    }
    Some(program)
}

#[cfg(unix)]
#[test]
fn openjd_runs_the_template() {
    let Some(openjd) = openjd() else { return };
    let template = root().join("farm/batch.openjd.yaml");
    succeed(Command::new(&openjd).arg("check").arg(&template));
    let folder = folder("farm");
    let expected = four_pairs(&folder);
    let run = || {
        let mut command = Command::new(&openjd);
        command.current_dir(&folder).arg("run").arg(&template).args(["--step", "Dress", "-p", "Slices=2"]);
        command.arg("-p").arg(format!("Manifest={}", folder.join("all.json").display()));
        command.arg("-p").arg(format!("Program={}", env!("CARGO_BIN_EXE_bespoke")));
        succeed(&mut command)
    };
    run();
    all_there(&folder, &expected);
    let pairs_of = |slice: u32| {
        let lines = lines(&folder.join(format!("all.report.{slice}of2.jsonl")));
        lines.into_iter().map(|line| line.pair).collect::<Vec<_>>()
    };
    assert_eq!(pairs_of(1), ["vest on slim", "waistcoat on slim"]);
    assert_eq!(pairs_of(2), ["vest on thin", "waistcoat on thin"]);
    // A task that is started again does what is missing and nothing else.
    fs::remove_file(folder.join("results/vest-on-thin.glb")).unwrap();
    run();
    all_there(&folder, &expected);
    assert_eq!(
        (pairs_of(1).len(), pairs_of(2)),
        (2, ["vest on thin", "waistcoat on thin", "vest on thin"].map(String::from).to_vec())
    );
}
