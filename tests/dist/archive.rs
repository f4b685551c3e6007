//! What lies in the folder to ship: all licences, and what programs are built against.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::bare::{inputs, program};
use crate::shipped::folder;
use testing::process::{is_there, root, scratch, succeed};

#[test]
fn every_part_comes_with_its_licence() {
    let Some(folder) = folder() else { return };
    let licences = folder.join("licences");
    let list = fs::read_to_string(licences.join("README.md")).expect("the list of parts");
    let has_text = |place: &Path| {
        let files = fs::read_dir(place).unwrap_or_else(|_| panic!("{} is not there", place.display()));
        let sizes = files.map(|file| file.expect("an entry").metadata().expect("its size").len());
        assert!(sizes.sum::<u64>() > 300, "{} holds no text", place.display());
    };
    for part in ["openvdb", "half", "onetbb", "boost", "libstdc++", "rust"] {
        has_text(&licences.join(part));
        assert!(list.contains(&format!("| {part} |")), "{part} is not in the list of parts");
    }
    assert!(list.contains("openvdb_10"), "the list does not say where the sources of OpenVDB are");
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let mut tree = Command::new(cargo);
    tree.args(["tree", "--locked", "--edges", "normal", "--prefix", "none", "--format", "{p}"]);
    let tree = succeed(tree.current_dir(root()));
    let mut count = 0;
    for line in tree.lines() {
        let mut words = line.split(' ');
        let (name, version) = (words.next().expect("a name"), words.next().expect("a version"));
        if name != "bespoke" {
            let version = version.trim_start_matches('v');
            has_text(&licences.join("crates").join(format!("{name}-{version}")));
            assert!(list.contains(&format!("| {name} | {version} |")), "{name} is not in the list of parts");
            count += 1;
        }
    }
    assert!(count > 20, "only {count} crates were found");
    for text in ["LICENSE-MIT", "LICENSE-APACHE"] {
        let (ours, shipped) = (fs::read(root().join(text)), fs::read(folder.join(text)));
        assert_eq!(ours.expect("our licence"), shipped.expect("our licence is shipped"), "{text}");
    }
}

/// The files below a folder, by their way from it; none where there is no such folder.
fn files(folder: &Path) -> BTreeSet<PathBuf> {
    let mut found = BTreeSet::new();
    let mut left = vec![folder.to_path_buf()];
    while let Some(place) = left.pop() {
        for path in fs::read_dir(&place).into_iter().flatten().map(|entry| entry.expect("an entry").path()) {
            if path.is_dir() {
                left.push(path);
            } else {
                found.insert(path.strip_prefix(folder).expect("it lies below the folder").to_path_buf());
            }
        }
    }
    found
}

#[test]
fn headers_bindings_and_examples_are_those_of_the_project() {
    let Some(folder) = folder() else { return };
    for place in ["include", "examples_c", "bindings"] {
        let (ours, shipped) = (files(&root().join(place)), files(&folder.join(place)));
        assert_eq!(ours.is_empty(), shipped.is_empty(), "{place} is shipped where it is there");
        // What was built among the bindings stays here.
        assert!(place == "bindings" || ours == shipped, "{place} is shipped as a whole");
        for file in shipped {
            let way = Path::new(place).join(file);
            let (ours, shipped) = (fs::read(root().join(&way)), fs::read(folder.join(&way)));
            assert_eq!(ours.expect("it is of the project"), shipped.expect("it is there"), "{}", way.display());
        }
    }
}

/// Runs a program in a folder with its inputs; it has to find the library on its own.
fn dresses(program: &Path, place: &Path) {
    let options = inputs(place);
    succeed(Command::new(program).args(options).current_dir(place).env_remove("LD_LIBRARY_PATH"));
    assert!(place.join("out.obj").is_file(), "{} wrote nothing", program.display());
}

fn sources(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder.join("examples_c")).expect("the examples");
    entries.map(|entry| entry.expect("an entry").path()).filter(|path| path.extension() == Some("c".as_ref())).collect()
}

#[test]
fn the_shipped_program_finds_its_library() {
    let Some(folder) = folder() else { return };
    dresses(&program(folder), &scratch("dist-program"));
}

#[test]
fn the_example_is_built_with_pkg_config() {
    let Some(folder) = folder() else { return };
    if !is_there("pkg-config") {
        return;
    }
    let place = scratch("dist-pkg-config");
    let mut flags = Command::new("pkg-config");
    flags.args(["--cflags", "--libs", "bespoke"]).env("PKG_CONFIG_PATH", folder.join("lib/pkgconfig"));
    let flags = succeed(&mut flags);
    let example = place.join("example");
    let mut compile = Command::new("cc");
    compile.arg("-std=c99").args(sources(folder)).args(flags.split_whitespace()).arg("-lm").arg("-o").arg(&example);
    succeed(compile.arg(format!("-Wl,-rpath,{}", folder.join("lib").display())));
    dresses(&example, &place);
}

#[test]
fn the_example_is_built_with_cmake() {
    let Some(folder) = folder() else { return };
    if !is_there("cmake") {
        return;
    }
    let place = scratch("dist-cmake");
    let project = "cmake_minimum_required(VERSION 3.16)\n\
                   project(example C)\n\
                   find_package(Bespoke 0.1 REQUIRED)\n\
                   file(GLOB sources \"${FOLDER}/examples_c/*.c\")\n\
                   add_executable(example ${sources})\n\
                   target_link_libraries(example PRIVATE Bespoke::bespoke m)\n";
    fs::write(place.join("CMakeLists.txt"), project).expect("the project can be written");
    let mut configure = Command::new("cmake");
    configure.args(["-S", ".", "-B", "build"]).arg(format!("-DCMAKE_PREFIX_PATH={}", folder.display()));
    succeed(configure.arg(format!("-DFOLDER={}", folder.display())).current_dir(&place));
    succeed(Command::new("cmake").args(["--build", "build"]).current_dir(&place));
    dresses(&place.join("build/example"), &place);
}
