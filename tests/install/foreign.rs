//! Somebody else's project (tests/install/foreign) builds against an installed prefix that was moved, and its programs
//! run.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::prefix::{command, folder, install, library_file, library_name};
use testing::process::{is_there, root, succeed};

/// A place with the sources of the foreign project, and a prefix that lies elsewhere than where it was installed.
struct Place {
    sources: PathBuf,
    build: PathBuf,
    prefix: PathBuf,
}

impl Place {
    fn new(test: &str) -> Self {
        let place = folder(test);
        let (sources, first, prefix) = (place.join("sources"), place.join("first"), place.join("moved to"));
        install(&first, &[]);
        fs::rename(&first, &prefix).expect("the prefix can be moved");
        fs::create_dir(&sources).expect("a folder");
        for entry in fs::read_dir(root().join("tests/install/foreign")).expect("the foreign project is there") {
            let path = entry.expect("an entry").path();
            fs::copy(&path, sources.join(path.file_name().expect("a name"))).expect("it can be copied");
        }
        // Not below the blank: GNU make does not take one in the names of what it makes.
        let build = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("install-{test}"));
        let _ = fs::remove_dir_all(&build);
        Self { sources, build, prefix }
    }

    /// CMake, told where the prefix is.
    fn cmake(&self) -> Command {
        let mut cmake = command("cmake");
        cmake.env("CMAKE_PREFIX_PATH", &self.prefix);
        cmake
    }

    fn configure(&self, arguments: &[&str]) -> Command {
        let mut cmake = self.cmake();
        cmake.arg("-S").arg(&self.sources).arg("-B").arg(&self.build).args(arguments);
        cmake
    }

    /// The programs find the library by themselves, name it as the loader looks for it, and do what they should.
    #[track_caller]
    fn programs_work(&self) {
        for (name, word) in [("dress", "verified"), ("session", "BESPOKE_STATUS_INVALID_STATE")] {
            let program = self.build.join(name);
            let said = succeed(&mut command(&program));
            assert!(said.contains(word), "{name} says {said}");
            let dynamic = succeed(command("readelf").args(["--dynamic", "--wide"]).arg(&program));
            assert!(dynamic.contains(&format!("Shared library: [{}]", library_name())), "{dynamic}");
            let needed = dynamic.lines().filter(|line| line.contains("(NEEDED)"));
            assert!(needed.clone().all(|line| !line.contains('/')), "a library is needed by its path: {dynamic}");
        }
    }
}

#[test]
fn cmake_project_builds_and_runs() {
    if !is_there("cmake") {
        return;
    }
    let place = Place::new("cmake");
    succeed(&mut place.configure(&[]));
    succeed(place.cmake().arg("--build").arg(&place.build));
    place.programs_work();
    let library = place.prefix.join("lib").join(library_file());
    let told = fs::read_to_string(place.build.join("library.txt")).expect("CMake writes it");
    assert_eq!(told, format!("{} as {}\n", library.display(), library_name()));
}

#[test]
fn cmake_refuses_another_version_in_a_sentence() {
    if !is_there("cmake") {
        return;
    }
    let place = Place::new("cmake-version");
    let output = place.configure(&["-DBESPOKE_VERSION=2.0"]).output().expect("cmake can be run");
    let complaint = String::from_utf8_lossy(&output.stderr).replace('\n', " ");
    assert!(!output.status.success(), "version 2.0 was found");
    for word in ["requested version \"2.0\"", "BespokeConfig.cmake", env!("CARGO_PKG_VERSION")] {
        assert!(complaint.contains(word), "{complaint}");
    }
}

/// A package of which a part is gone, or that is asked for what it does not have.
#[test]
fn cmake_tells_what_is_missing() {
    if !is_there("cmake") {
        return;
    }
    let place = Place::new("cmake-missing");
    let lists = place.sources.join("CMakeLists.txt");
    let text = "cmake_minimum_required(VERSION 3.16)\nproject(foreign C)\nfind_package(Bespoke REQUIRED CONFIG)\n";
    let refused = |text: &str, word: &str| {
        fs::write(&lists, text).expect("it can be written");
        let output = place.configure(&[]).output().expect("cmake can be run");
        let complaint = String::from_utf8_lossy(&output.stderr).split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(!output.status.success() && complaint.contains(word), "{complaint}");
    };
    refused(&text.replace("CONFIG", "CONFIG COMPONENTS gloves"), "no components, and gloves is asked for");
    fs::remove_file(place.prefix.join("include/bespoke.h")).expect("the header is there");
    refused(text, "install Bespoke again");
}

/// /lib is a link to /usr/lib on many systems, and CMake may come in by it.
#[test]
fn cmake_finds_the_headers_through_a_linked_folder() {
    if !is_there("cmake") {
        return;
    }
    let place = Place::new("cmake-link");
    let beside = place.prefix.with_file_name("beside");
    fs::create_dir(&beside).expect("a folder");
    std::os::unix::fs::symlink(place.prefix.join("lib"), beside.join("lib")).expect("a link");
    succeed(place.configure(&[]).env("CMAKE_PREFIX_PATH", &beside));
}

#[test]
fn pkg_config_project_builds_and_runs() {
    if !is_there("pkg-config") {
        return;
    }
    let place = Place::new("pkg-config");
    let path = place.prefix.join("lib/pkgconfig");
    let asked = |argument: &str| {
        succeed(command("pkg-config").env("PKG_CONFIG_PATH", &path).arg(argument).arg("bespoke")).trim().to_owned()
    };
    assert_eq!(asked("--modversion"), env!("CARGO_PKG_VERSION"));
    assert_eq!(asked("--validate"), "");
    let build = format!("BUILD={}", place.build.display());
    succeed(command("make").current_dir(&place.sources).env("PKG_CONFIG_PATH", &path).arg(build));
    place.programs_work();
}
