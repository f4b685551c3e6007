//! What bespoke.hpp covers of bespoke.h, and how it behaves as a header.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;
use std::process::Command;

use crate::{Flavour, GCC, root, run};

fn text(path: &str) -> String {
    fs::read_to_string(root().join(path)).expect("a file of the repository")
}

/// All words of a source that begin so.
fn words<'t>(text: &'t str, beginning: &str) -> BTreeSet<&'t str> {
    text.split(|c: char| !c.is_ascii_alphanumeric() && c != '_').filter(|word| word.starts_with(beginning)).collect()
}

/// `text` without its comments.
fn code(text: &str) -> String {
    let mut rest = text;
    let mut code = String::new();
    while let Some((before, comment)) = rest.split_once("/*") {
        code += before;
        rest = comment.split_once("*/").expect("a comment that ends").1;
    }
    code += rest;
    code.lines().map(|line| line.split("//").next().unwrap_or_default()).collect::<Vec<_>>().join("\n")
}

#[test]
fn every_function_and_every_name_of_the_c_api_has_its_place() {
    let (c, cpp) = (code(&text("include/bespoke.h")), code(&text("include/bespoke.hpp")));
    let used = words(&cpp, "bespoke_");
    let functions: Vec<_> = words(&c, "bespoke_").into_iter().collect();
    assert!(functions.len() > 35, "only {} functions were found", functions.len());
    for function in functions {
        assert!(used.contains(function), "{function} is not reached by bespoke.hpp");
    }
    let used = words(&cpp, "BESPOKE_");
    // Lengths of arrays inside of structs, which C++ sees by the arrays.
    let lengths = ["BESPOKE_H", "BESPOKE_ENERGY_NAME_SIZE", "BESPOKE_MESSAGE_SIZE", "BESPOKE_PART_NAME_SIZE"];
    let names: Vec<_> = words(&c, "BESPOKE_").into_iter().filter(|name| !lengths.contains(name)).collect();
    assert!(names.len() > 50, "only {} names were found", names.len());
    for name in names {
        assert!(used.contains(name), "{name} has no place in bespoke.hpp");
    }
}

/// Structs that bespoke.hpp has anew, since their fields have other types there.
#[test]
fn every_field_crosses() {
    let cpp = code(&text("include/bespoke.hpp"));
    let layout = text("tests/capi/layout.inc");
    let used: BTreeSet<_> = cpp.split(|c: char| !c.is_ascii_alphanumeric() && c != '_' && c != '.').collect();
    let mut count = 0;
    for (name, objects) in [
        ("BespokeOptions", &["options", "read"][..]),
        ("BespokeCoordinateSystem", &["made"]),
        ("BespokeProgress", &["from"]),
        ("BespokeEnergy", &["energy"]),
        ("BespokeElement", &["element"]),
        ("BespokeDiagnostic", &["from"]),
        ("BespokeJoint", &["to"]),
        ("BespokeMappedJoint", &["from"]),
    ] {
        let fields = layout.lines().filter_map(|line| line.strip_prefix(&format!("FIELD({name}, ")));
        for field in fields.map(|rest| rest.split(',').next().expect("a field")) {
            if ["struct_size", "reserved"].contains(&field) {
                continue;
            }
            for object in objects {
                let access = format!("{object}.{field}");
                assert!(used.contains(&*access), "{name}.{field} does not cross bespoke.hpp");
            }
            count += 1;
        }
    }
    assert!(count > 40, "only {count} fields were found");
}

/// Nothing but its guard is left defined, and what it includes stays small enough to compile in a second.
#[test]
fn the_header_leaks_no_macro_and_is_light() {
    let preprocess = |flags: &[&str], header: &str| {
        let output = Command::new("g++")
            .args(["-std=c++17", "-E", "-x", "c++", "-include"])
            .arg(root().join("include").join(header))
            .args(flags)
            .arg("/dev/null")
            .output()
            .expect("g++ can be run");
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        String::from_utf8_lossy(&output.stdout).into_owned()
    };
    let macros = |header| {
        let text = preprocess(&["-dM"], header);
        let names = text.lines().filter_map(|line| line.split([' ', '(']).nth(1));
        names.filter(|name| name.to_ascii_lowercase().contains("bespoke")).map(str::to_owned).collect::<BTreeSet<_>>()
    };
    let added: Vec<_> = macros("bespoke.hpp").difference(&macros("bespoke.h")).cloned().collect();
    assert_eq!(added, ["BESPOKE_HPP"]);
    // <string>, <vector>, <memory> and <mutex> alone are 28,600; a second is 60,000 or so.
    let lines = preprocess(&["-P"], "bespoke.hpp").lines().count();
    assert!((1_000..45_000).contains(&lines), "{lines} lines are compiled with bespoke.hpp");
}

/// A program that was compiled for another binary interface gets an error, and goes no further.
#[test]
fn a_library_of_another_binary_interface_is_refused() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("cpp-other-abi");
    fs::create_dir_all(&folder).expect("a folder for the test");
    let old = format!("#define BESPOKE_ABI_VERSION {}\n", bespoke::capi::version::BESPOKE_ABI_VERSION);
    let new = "#define BESPOKE_ABI_VERSION 4711\n";
    let header = text("include/bespoke.h");
    assert!(header.contains(&old));
    let source = folder.join("other.cpp");
    fs::write(folder.join("bespoke.h"), header.replace(&old, new)).expect("a header");
    fs::write(folder.join("bespoke.hpp"), text("include/bespoke.hpp")).expect("a header");
    let program = "#include \"bespoke.hpp\"\n\
                   int main() {\n\
                       const auto session = bespoke::Session::create();\n\
                       std::puts(session.message().c_str());\n\
                       return session.status() == bespoke::Status::invalid_state ? 0 : 1;\n\
                   }\n";
    fs::write(&source, program).expect("a source");
    let flavour = Flavour { name: "other-abi", ..GCC };
    let Some(program) = flavour.compile("abi", &[source], &folder) else { return };
    let output = run(&program, &[]);
    let said = String::from_utf8_lossy(&output.stdout);
    assert!(output.status.success(), "{said}");
    let ours = format!("interface {},", bespoke::capi::version::BESPOKE_ABI_VERSION);
    for word in ["4711", &ours, env!("CARGO_PKG_VERSION")] {
        assert!(said.contains(word), "{said}");
    }
}

/// What the README shows compiles.
#[test]
fn the_readme_shows_c_plus_plus() {
    let readme = text("README.md");
    let shown = readme.split("```cpp\n").nth(1).and_then(|rest| rest.split("```").next()).expect("a block of C++");
    let program = format!(
        "#include \"bespoke.hpp\"\n\
         using Points = std::vector<std::array<float, 3>>;\n\
         struct Vertex {{ float position[3]; }};\n\
         void show(double) {{}}\n\
         void shown(const Points &points, const std::vector<std::uint32_t> &triangles, const Points &joints,\n\
                    const std::vector<std::array<std::uint16_t, 2>> &bones, const std::vector<Vertex> &vertices,\n\
                    const std::vector<std::uint16_t> &indices, const Points &target_joints,\n\
                    const bespoke::StopToken &stop_token) {{\n{shown}\nshow(static_cast<double>(result.size()));\n}}\n\
         int main() {{ return 0; }}\n"
    );
    let source = Path::new(env!("CARGO_TARGET_TMPDIR")).join("cpp-readme.cpp");
    fs::write(&source, program).expect("a source");
    GCC.compile("readme", &[source], &root().join("include"));
}
