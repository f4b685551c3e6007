//! Which library `make install` takes: the one with OpenVDB inside, where there is one or one can be built.

use std::fs;
use std::os::unix::fs::{PermissionsExt, symlink};
use std::path::PathBuf;
use std::process::Output;

use crate::prefix::{command, folder};
use testing::process::{root, succeed};

/// A project with nothing in it but the script, one source, and a place for programs.
struct Project(PathBuf);

impl Project {
    fn new(test: &str) -> Self {
        let place = folder(test);
        for name in ["packaging/dist", "programs", "src", "build/dist", "target/dist"] {
            fs::create_dir_all(place.join(name)).expect("a folder");
        }
        fs::copy(root().join("packaging/library.sh"), place.join("packaging/library.sh")).expect("the script");
        fs::write(place.join("src/lib.rs"), "").expect("a source");
        // All that the script needs, so that cargo is there only where a test says so.
        for program in ["sh", "find", "dirname"] {
            let found = succeed(command("sh").args(["-c", "command -v \"$0\"", program]));
            symlink(found.trim(), place.join("programs").join(program)).expect("a link to a program");
        }
        Self(place)
    }

    /// A program or script of one's own making.
    fn script(&self, name: &str, body: &str) {
        let path = self.0.join(name);
        fs::write(&path, format!("#!/bin/sh\n{body}\n")).expect("a script");
        fs::set_permissions(&path, PermissionsExt::from_mode(0o755)).expect("its mode");
    }

    fn ask(&self, openvdb: &str) -> Output {
        let mut ask = command("sh");
        ask.current_dir(&self.0).env("PATH", self.0.join("programs")).env_remove("CARGO_TARGET_DIR");
        ask.args(["packaging/library.sh", openvdb, "build/built", "src"]).output().expect("the script can be run")
    }

    /// The library that it names, and what it says about that.
    fn chosen(&self, openvdb: &str) -> (String, String) {
        let output = self.ask(openvdb);
        let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).trim().to_owned();
        assert!(output.status.success(), "{output:?}");
        (text(&output.stdout), text(&output.stderr))
    }

    /// A shipped library that was built after the source was written, or before.
    fn shipped(&self, is_newer: bool) {
        fs::write(self.0.join("target/dist/libbespoke.so"), "").expect("a library");
        let written = fs::metadata(self.0.join("src/lib.rs")).and_then(|source| source.modified()).expect("a date");
        let second = std::time::Duration::from_secs(10);
        let date = if is_newer { written + second } else { written - second };
        let fresh = fs::File::create(self.0.join("build/dist/fresh")).expect("a mark");
        fresh.set_modified(date).expect("its date");
        let folder = fs::File::open(self.0.join("src")).expect("the sources");
        folder.set_modified(written).expect("their date");
    }
}

#[test]
fn the_systems_openvdb_is_taken_where_it_is_asked_for() {
    let project = Project::new("system");
    project.shipped(true);
    assert_eq!(project.chosen("system"), ("build/built".into(), String::new()));
    let refused = project.ask("static");
    assert_eq!(refused.status.code(), Some(1));
    assert!(String::from_utf8_lossy(&refused.stderr).contains("inside or system"), "{refused:?}");
}

#[test]
fn a_shipped_library_is_taken_while_no_source_is_newer() {
    let project = Project::new("fresh");
    project.shipped(true);
    assert_eq!(project.chosen("inside"), ("target/dist/libbespoke.so".into(), String::new()));
    project.shipped(false);
    let (library, said) = project.chosen("inside");
    assert_eq!(library, "build/built");
    assert!(said.contains("there is no cargo") && said.contains("four threads"), "{said}");
}

#[test]
fn it_is_built_where_it_can_be() {
    let project = Project::new("build");
    project.script("programs/cargo", "exit 0");
    project.script("packaging/dist/library.sh", "echo built in \"$1\" >&2; echo /new/libbespoke.so");
    let (library, said) = project.chosen("inside");
    assert_eq!(library, "/new/libbespoke.so");
    assert!(said.starts_with("built in") && said.ends_with("build/dist"), "{said}");
    project.script("packaging/dist/library.sh", "echo no network >&2; exit 1");
    let (library, said) = project.chosen("inside");
    assert_eq!(library, "build/built");
    assert!(said.contains("no network") && said.contains("could not be built"), "{said}");
}
