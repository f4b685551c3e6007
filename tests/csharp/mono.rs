//! Debian's C# compiler and runtime.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::OnceLock;

use testing::process::{is_there, root, scratch, succeed};

/// A folder with Bespoke.dll and all programs that use it, compiled without a warning. None, and a line that says so,
/// where there is no mono.
pub fn binding() -> Option<&'static Path> {
    static FOLDER: OnceLock<Option<PathBuf>> = OnceLock::new();
    FOLDER.get_or_init(|| (is_there("mcs") && is_there("mono")).then(compile)).as_deref()
}

fn compile() -> PathBuf {
    let folder = scratch("csharp-binding");
    let binding = root().join("bindings/csharp/Bespoke/*.cs").display().to_string();
    let tests = |names: &[&str]| -> Vec<String> {
        names.iter().map(|name| root().join(format!("tests/csharp/{name}.cs")).display().to_string()).collect()
    };
    // The binding alone has unsafe code; who uses it needs none.
    let documentation = format!("-doc:{}", folder.join("Bespoke.xml").display());
    mcs(&folder, "Bespoke.dll", &["-target:library", "-unsafe", &documentation, &binding], &[]);
    let reference = format!("-r:{}", folder.join("Bespoke.dll").display());
    let cases = tests(&["Cases", "Check", "Inputs", "Dressing", "Errors", "Rigs", "Running", "Lifetime"]);
    mcs(&folder, "Cases.exe", &["-r:System.Core", &reference], &cases);
    let example = root().join("bindings/csharp/Dress/*.cs").display().to_string();
    mcs(&folder, "Dress.exe", &[&reference, &example], &[]);
    // Sees what is internal.
    mcs(&folder, "Layout.exe", &["-r:System.Core", "-unsafe", &binding], &tests(&["Layout", "Check"]));
    folder
}

fn mcs(folder: &Path, name: &str, options: &[&str], sources: &[String]) {
    let mut command = Command::new("mcs");
    command.args(["-langversion:7.2", "-warnaserror+", "-warn:4"]).arg(format!("-out:{}", folder.join(name).display()));
    succeed(command.args(options).args(sources));
}

/// A program that finds the library in this folder.
pub fn program(path: &Path, library: &Path) -> Command {
    let mut command = Command::new("mono");
    command.env("LD_LIBRARY_PATH", library).env("DYLD_LIBRARY_PATH", library);
    command.arg("--debug").arg(path);
    command
}
