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
        // In the order in which they ended.
        let mut pairs: Vec<String> = lines.into_iter().map(|line| line.pair).collect();
        pairs.sort();
        pairs
    };
    assert_eq!(pairs_of(1), ["vest on slim", "waistcoat on slim"]);
    assert_eq!(pairs_of(2), ["vest on thin", "waistcoat on thin"]);
    // A task that is started again does what is missing and nothing else.
    fs::remove_file(folder.join("results/vest-on-thin.glb")).unwrap();
    run();
    all_there(&folder, &expected);
    assert_eq!(
        (pairs_of(1).len(), pairs_of(2)),
        (2, ["vest on thin", "vest on thin", "waistcoat on thin"].map(String::from).to_vec())
    );
}

/// The Python package with this program in it.
#[cfg(target_os = "linux")]
fn package(folder: &Path) -> PathBuf {
    let package = folder.join("package");
    fs::create_dir_all(package.join("bespoke/bin")).unwrap();
    for entry in fs::read_dir(root().join("bindings/python/src/bespoke")).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_some_and(|end| end == "py") {
            fs::copy(&path, package.join("bespoke").join(path.file_name().unwrap())).unwrap();
        }
    }
    fs::copy(env!("CARGO_BIN_EXE_bespoke"), package.join("bespoke/bin/bespoke")).unwrap();
    let library = testing::library::folder().join("libbespoke.so");
    fs::copy(library, package.join("bespoke/libbespoke.so")).unwrap();
    package
}

/// The process that has started `bespoke batch` with this manifest: a worker of Ray.
#[cfg(target_os = "linux")]
fn worker(manifest: &str) -> Option<u32> {
    let processes = fs::read_dir("/proc").unwrap().filter_map(|entry| entry.ok()?.file_name().into_string().ok());
    processes.filter(|id| id.parse::<u32>().is_ok()).find_map(|id| {
        let words = fs::read_to_string(format!("/proc/{id}/cmdline")).ok()?;
        let is_batch = words.contains(manifest) && words.contains("\0--slice\0");
        let status = fs::read_to_string(format!("/proc/{id}/status")).ok().filter(|_| is_batch)?;
        status.lines().find_map(|line| line.strip_prefix("PPid:"))?.trim().parse().ok()
    })
}

/// Also where a worker is killed: its slice is done by another, and no pair twice.
#[cfg(target_os = "linux")]
#[test]
fn ray_runs_the_script() {
    let Some(python) = std::env::var_os("BESPOKE_RAY") else {
        println!("SKIPPED: the script for Ray, which takes a minute (make test-ray)");
        return;
    };
    let folder = folder("ray");
    let expected = four_pairs(&folder);
    let manifest = folder.join("all.json").display().to_string();
    let mut script = Command::new(python)
        .arg(root().join("farm/batch_ray.py"))
        .arg(&manifest)
        .env("PYTHONPATH", package(&folder))
        .spawn()
        .unwrap();
    let killed = loop {
        assert!(script.try_wait().unwrap().is_none(), "it has ended before anything was killed");
        match worker(&manifest) {
            Some(worker) => break worker,
            None => std::thread::sleep(std::time::Duration::from_millis(5)),
        }
    };
    assert!(Command::new("kill").args(["-9", &killed.to_string()]).status().unwrap().success());
    assert!(script.wait().unwrap().success());
    all_there(&folder, &expected);
    let reports = [1, 2].map(|slice| lines(&folder.join(format!("all.report.{slice}of2.jsonl"))));
    let mut pairs: Vec<String> = reports.concat().into_iter().map(|line| line.pair).collect();
    pairs.sort();
    assert_eq!(pairs, ["vest on slim", "vest on thin", "waistcoat on slim", "waistcoat on thin"]);
}
