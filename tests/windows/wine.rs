//! Programs of Windows, run by Wine.

use std::ffi::OsStr;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::OnceLock;

use crate::shipped::{CROSS, folder};
use testing::process::{is_there, root, scratch, succeed};

/// Wine with a machine of its own.
pub struct Wine {
    /// The folder `bin` of what is shipped, with what Wine lacks beside it.
    pub bin: PathBuf,
    prefix: PathBuf,
}

/// A compiler for Windows that treats warnings as errors.
pub fn compile(sources: &[PathBuf], includes: &[PathBuf], options: &[&str], out: &Path) {
    let mut command = Command::new(format!("{CROSS}gcc-posix"));
    command.args(["-std=gnu11", "-O1", "-D__USE_MINGW_ANSI_STDIO=1", "-Wall", "-Wextra", "-Werror"]);
    for folder in includes {
        command.arg("-isystem").arg(folder);
    }
    succeed(command.args(sources).arg("-o").arg(out).args(options));
}

/// None, with a word about it, where there is no Wine or nothing to run.
pub fn wine() -> Option<&'static Wine> {
    static WINE: OnceLock<Option<Wine>> = OnceLock::new();
    let made = WINE.get_or_init(|| {
        let folder = folder()?;
        if !is_there("wine") {
            return None;
        }
        let place = scratch("windows");
        let bin = place.join("bin");
        succeed(Command::new("cp").arg("-r").arg(folder.join("bin")).arg(&bin));
        let stub = root().join("tests/windows/bcryptprimitives.c");
        compile(&[stub], &[], &["-shared", "-ladvapi32"], &bin.join("bcryptprimitives.dll"));
        let wine = Wine { bin, prefix: place.join("prefix") };
        // The first program makes the machine.
        let output = wine.command(OsStr::new("cmd")).args(["/c", "echo", "ready"]).output().expect("wine runs");
        assert!(String::from_utf8_lossy(&output.stdout).contains("ready"), "wine does not run: {output:?}");
        Some(wine)
    });
    made.as_ref()
}

impl Wine {
    /// A program of this system that runs Wine.
    pub fn around(&self, program: &str) -> Command {
        let mut command = Command::new(program);
        command.env("WINEPREFIX", &self.prefix).env("WINEDEBUG", "-all").env("WINEDLLOVERRIDES", "mscoree,mshtml=");
        // In the character set of the words below.
        command.env("LC_ALL", "C.UTF-8").env("WINEPATH", &self.bin);
        command
    }

    fn command(&self, program: &OsStr) -> Command {
        let mut command = self.around("wine");
        command.arg(program);
        command
    }

    /// A program, to run in `place`.
    pub fn program(&self, program: &Path, place: &Path) -> Command {
        let mut command = self.command(program.as_os_str());
        command.current_dir(place);
        command
    }

    /// Runs the shipped `retarget`.
    pub fn retarget(&self, words: &[&str], place: &Path) -> Output {
        self.program(&self.bin.join("retarget.exe"), place).args(words).output().expect("wine runs")
    }
}

/// What went wrong, in the program's words.
pub fn said(output: &Output) -> String {
    let [printed, complained] = [&output.stdout, &output.stderr].map(|text| String::from_utf8_lossy(text).into_owned());
    format!("{}: {printed}{complained}", output.status)
}

/// Equal files, byte for byte.
#[track_caller]
pub fn same(a: &Path, b: &Path) {
    let [ours, theirs] =
        [a, b].map(|file| fs::read(file).unwrap_or_else(|_| panic!("{} is not there", file.display())));
    assert!(ours == theirs, "{} and {} differ", a.display(), b.display());
}
