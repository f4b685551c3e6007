//! The C++ and the C# of the plugin: the core runs, the rest compiles against stubs.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use testing::engine::{self, Engine};
use testing::library;
use testing::process::{is_there, root, scratch, succeed};

/// As the engine compiles, and warnings that it asks for.
const FLAGS: &[&str] = &["-std=c++20", "-fno-exceptions", "-fno-rtti", "-Wall", "-Wextra", "-Werror", "-Wshadow"];
const SOURCES: &str = "bindings/unreal/Bespoke/Source";

#[test]
fn the_core_gives_the_bits_of_rust() {
    let program = scratch("unreal-core").join("core");
    let built = library::folder();
    let mut compiler = Command::new("g++");
    compiler
        .args(FLAGS)
        .arg("-I")
        .arg(root().join("include"))
        .arg("-I")
        .arg(root().join(SOURCES).join("Bespoke/Public"));
    compiler.arg(root().join("tests/unreal/core.cpp")).arg("-o").arg(&program);
    compiler.arg(format!("-L{}", built.display())).args(["-lbespoke", "-pthread"]);
    succeed(compiler.arg(format!("-Wl,-rpath,{}", built.display())));
    assert_eq!(succeed(Command::new(&program).arg(engine::folder(Engine::Unreal))), "all good\n");
}

/// All files below with this ending.
fn files(folder: &Path, ending: &str) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            found.extend(files(&path, ending));
        } else if path.to_string_lossy().ends_with(ending) {
            found.push(path);
        }
    }
    found
}

/// Headers of the engine that the plugin includes, each of them our stub.
fn engine_headers() -> PathBuf {
    let folder = scratch("unreal-headers");
    let sources: Vec<PathBuf> = [".h", ".cpp"].iter().flat_map(|end| files(&root().join(SOURCES), end)).collect();
    let own: BTreeSet<String> =
        sources.iter().map(|path| path.file_name().expect("a name").to_string_lossy().into_owned()).collect();
    for source in &sources {
        let text = fs::read_to_string(source).expect("a source");
        for name in text.lines().filter_map(|line| line.strip_prefix("#include \"")?.strip_suffix('"')) {
            if own.contains(name) || name == "bespoke.hpp" {
                continue;
            }
            let header = folder.join(name);
            fs::create_dir_all(header.parent().expect("a folder")).expect("a folder");
            let is_generated = name.ends_with(".generated.h");
            fs::write(header, if is_generated { "" } else { "#include \"Unreal.h\"\n" }).expect("a header");
        }
    }
    folder
}

#[test]
fn the_modules_compile_against_stubs() {
    let headers = engine_headers();
    let mut count = 0;
    for source in files(&root().join(SOURCES), ".cpp") {
        let mut compiler = Command::new("g++");
        compiler.args(FLAGS).args(["-fsyntax-only", "-Wno-nonnull"]);
        for folder in ["Bespoke/Public", "Bespoke/Private", "BespokeEditor/Private"] {
            compiler.arg("-I").arg(root().join(SOURCES).join(folder));
        }
        compiler.arg("-I").arg(&headers).arg("-I").arg(root().join("tests/unreal/stubs"));
        succeed(compiler.arg("-I").arg(root().join("include")).arg(source));
        count += 1;
    }
    assert_eq!(count, 5);
}

#[test]
fn build_files_compile_against_stubs() {
    if !is_there("mcs") {
        return;
    }
    let mut compiler = Command::new("mcs");
    compiler.args(["-target:library", "-warnaserror+", "-warn:4"]);
    compiler.arg(format!("-out:{}", scratch("unreal-rules").join("rules.dll").display()));
    let rules = files(&root().join(SOURCES), ".Build.cs");
    assert_eq!(rules.len(), 3);
    succeed(compiler.arg(root().join("tests/unreal/stubs/UnrealBuildTool.cs")).args(rules));
}
