//! What a message or the library names, the program has.

use std::fs;

use bespoke::options::Options;

use super::{retarget, root, succeed};

/// Options of the library that have another name in the program, and why.
const OTHERWISE: [(&str, &str); 2] = [
    // A flag, for there are two forms only.
    ("surface_form", "--printed-surface"),
    // Named for what they are before the library's options were.
    ("min_separation", "--min-separation"),
];

/// Fields that are no options.
const NO_OPTIONS: [&str; 2] = ["struct_size", "reserved"];

/// The fields of the struct of options in the header.
fn fields_of_header() -> Vec<String> {
    let header = fs::read_to_string(root().join("include/bespoke.h")).expect("the header is committed");
    let (_, rest) = header.split_once("typedef struct BespokeOptions {").expect("the struct begins");
    let (body, _) = rest.split_once("} BespokeOptions;").expect("the struct ends");
    let name =
        |line: &str| line.trim().strip_suffix(';').and_then(|line| line.split(' ').next_back().map(str::to_owned));
    body.lines().filter(|line| !line.trim_start().starts_with("//")).filter_map(name).collect()
}

/// The fields of the library's options, whose names its messages use.
fn fields_of_library() -> Vec<String> {
    let text = format!("{:?}", Options::default());
    let (_, fields) = text.split_once("{ ").expect("a struct");
    fields.split(", ").filter_map(|field| field.split_once(": ")).map(|(name, _)| name.to_owned()).collect()
}

fn flag(option: &str) -> String {
    let otherwise = OTHERWISE.iter().find(|(name, _)| *name == option);
    otherwise.map_or_else(|| format!("--{}", option.replace('_', "-")), |(_, flag)| (*flag).to_string())
}

#[test]
fn every_option_of_the_library_is_one_of_the_program() {
    let help = succeed(retarget().arg("--help"));
    let (of_header, of_messages) = (fields_of_header(), fields_of_library());
    assert!(of_header.len() > 20 && of_messages.len() > 20, "{of_header:?} {of_messages:?}");
    for option in of_header.iter().chain(&of_messages).filter(|name| !NO_OPTIONS.contains(&name.as_str())) {
        let flag = flag(option);
        let is_there = help.split([' ', ',', '\n']).any(|word| word == flag);
        assert!(is_there, "{option} is an option of the library, and --help has no {flag}");
    }
    assert!(help.contains("inflation_dhat is set by --inflation-dhat"), "{help}");
    assert!(help.contains("surface_form by\n--printed-surface"), "{help}");
}

/// Options that only the program has, and that its help explains.
#[test]
fn the_program_has_options_of_its_own() {
    let help = succeed(retarget().arg("--help"));
    for flag in ["--report FILE", "--keep-partial FILE", "--distortion FILE", "--quiet", "--curve-weight W"] {
        assert!(help.contains(flag), "{help}");
    }
    assert!(help.lines().all(|line| line.len() <= 120), "{help}");
}
