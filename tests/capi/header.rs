//! The committed header is what the sources give, and it is C99 and C++17 without a warning.

use std::path::{Path, PathBuf};
use std::process::Command;

use testing::process::root;

/// The header that the sources give now.
fn generated() -> String {
    let config = cbindgen::Config::from_root_or_default(root());
    let files = [
        "status",
        "version",
        "view",
        "session",
        "inputs",
        "coordinate_system",
        "rigs",
        "fit",
        "layers",
        "outfit",
        "avatar_parts",
        "morphs",
        "followers",
        "shared",
        "options",
        "running",
        "control",
        "results",
        "normals",
        "rig_results",
        "key_poses",
        "covered",
        "diagnostics",
    ];
    let builder = files.iter().fold(cbindgen::Builder::new().with_config(config), |builder, file| {
        builder.with_src(root().join(format!("src/capi/{file}.rs")))
    });
    let mut text = Vec::new();
    builder.generate().expect("the sources of the C API can be read").write(&mut text);
    String::from_utf8(text).expect("the header is UTF-8")
}

/// BESPOKE_UPDATE_HEADER=1 writes the header instead of comparing it.
#[test]
fn committed_header_matches_the_sources() {
    let path = root().join("include/bespoke.h");
    let text = generated();
    if std::env::var_os("BESPOKE_UPDATE_HEADER").is_some() {
        std::fs::write(&path, text).expect("include/bespoke.h can be written");
        return;
    }
    let committed = std::fs::read_to_string(&path).unwrap_or_default();
    assert!(committed == text, "include/bespoke.h is not what the sources give; run `make header` and commit it");
}

/// Every exported function is in the list of files above.
#[test]
fn every_exported_function_is_in_the_header() {
    let text = generated();
    let mut count = 0;
    for entry in std::fs::read_dir(root().join("src/capi")).expect("src/capi exists") {
        let source = std::fs::read_to_string(entry.expect("an entry of src/capi").path()).expect("a source file");
        for (_, rest) in source.match_indices("extern \"C\" fn ").map(|(at, found)| source.split_at(at + found.len())) {
            let name = rest.split('(').next().unwrap_or_default();
            assert!(text.contains(&format!("{name}(")), "{name} is not in the header");
            count += 1;
        }
    }
    assert!(count > 20, "only {count} exported functions were found");
}

fn compile(compiler: &str, arguments: &[&str], source: &str) {
    let path = root().join("tests/capi").join(source);
    let object: PathBuf = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("{compiler}-{source}.o"));
    let run = Command::new(compiler)
        .args(arguments)
        .args(["-pedantic", "-Wall", "-Wextra", "-Werror", "-I"])
        .arg(root().join("include"))
        .arg("-c")
        .arg(path)
        .arg("-o")
        .arg(object)
        .output();
    match run {
        Err(reason) => println!("SKIPPED: {compiler} cannot be run: {reason}"),
        Ok(output) => assert!(output.status.success(), "{compiler}: {}", String::from_utf8_lossy(&output.stderr)),
    }
}

#[test]
fn header_is_c99_and_cpp17_without_a_warning() {
    for compiler in ["gcc", "clang"] {
        compile(compiler, &["-std=c99"], "header_is_c.c");
    }
    for compiler in ["g++", "clang++"] {
        compile(compiler, &["-std=c++17"], "header_is_cpp.cpp");
    }
}
