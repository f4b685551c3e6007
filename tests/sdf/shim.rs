//! Every way from Rust into the C++ shim goes through its one guard, read from the sources.

use std::fs;

use testing::process::root;

fn source(path: &str) -> String {
    let text = fs::read_to_string(root().join(path)).unwrap_or_else(|reason| panic!("{path}: {reason}"));
    // Comments name functions, too.
    text.lines().map(|line| line.split("//").next().unwrap_or_default()).collect::<Vec<_>>().join("\n")
}

/// The names of functions that `text` declares or defines, each with what follows its arguments.
fn functions(text: &str) -> Vec<(&str, &str)> {
    let starts = text.match_indices("bespoke_volume_").map(|(at, _)| at);
    starts
        .filter_map(|at| {
            let rest = &text[at..];
            let (name, rest) = rest.split_once('(')?;
            let (_, after) = rest.split_once(')')?;
            name.chars().all(|c| c.is_alphanumeric() || c == '_').then_some((name, after.trim_start()))
        })
        .collect()
}

#[test]
fn every_function_of_the_shim_is_guarded() {
    let (header, shim) = (source("cpp_shim/volume.h"), source("cpp_shim/volume.cpp"));
    let declared = functions(&header);
    assert!(!declared.is_empty());
    for (name, after) in &declared {
        assert!(after.starts_with(';'), "{name}: {after:.40}");
        let defined: Vec<_> = functions(&shim).into_iter().filter(|(found, _)| found == name).collect();
        assert_eq!(defined.len(), 1, "{name} is defined once");
        let body = defined[0].1.strip_prefix('{').expect("a body").trim_start();
        assert!(body.starts_with("return guarded("), "{name} does more than to call guarded: {body:.60}");
        // That call is all: the body ends where the lambda does.
        let end = body.find("\n}").expect("the end of the body");
        assert!(body[..end].trim_end().ends_with("});"), "{name} goes on behind its guard");
    }
    // Nothing else is exported to C, nor asked for by Rust, and no other file is compiled.
    assert!(!shim.contains("extern \"C\""), "what C sees is declared in volume.h");
    let rust = source("src/sdf/volume.rs");
    let block = rust.split_once("unsafe extern \"C\" {").expect("the declarations").1;
    let asked: Vec<_> = block[..block.find("\n}").expect("their end")].matches("fn bespoke_volume_").collect();
    assert_eq!(asked.len(), declared.len());
    let files = fs::read_dir(root().join("cpp_shim")).expect("the folder of the shim");
    let mut names: Vec<_> = files.map(|file| file.expect("a file").file_name()).collect();
    names.sort();
    assert_eq!(names, ["probe.cpp", "team.h", "volume.cpp", "volume.h"]);
}
