//! Which requested versions CMake accepts, by the version that is installed.

use std::fs;
use std::path::Path;

use crate::prefix::{command, folder};
use testing::process::{is_there, root, succeed};

/// What CMake has to be told of a request: `find_package(Bespoke 0.3...<0.5)` as "0.3...<0.5".
fn request(asked: &str) -> String {
    let set = |name: &str, value: &str| format!("set(PACKAGE_FIND_VERSION{name} \"{value}\")\n");
    let count = |version: &str| if version.is_empty() { 0 } else { version.split('.').count() };
    let Some((least, most)) = asked.split_once("...") else {
        return set("", asked) + &set("_COUNT", &count(asked).to_string()) + &set("_RANGE", "");
    };
    let (end, most) = most.strip_prefix('<').map_or(("INCLUDE", most), |most| ("EXCLUDE", most));
    set("", least)
        + &set("_COUNT", &count(least).to_string())
        + &set("_RANGE", asked)
        + &set("_MIN", least)
        + &set("_MAX", most)
        + &set("_RANGE_MAX", end)
}

/// The version file of a library with 8-byte pointers.
fn version_file(folder: &Path, version: &str) -> String {
    let template = fs::read_to_string(root().join("packaging/BespokeConfigVersion.cmake.in")).expect("the template");
    let path = folder.join(format!("{version}.cmake"));
    fs::write(&path, template.replace("@VERSION@", version).replace("@POINTER_SIZE@", "8")).expect("it can be written");
    path.display().to_string()
}

/// Runs the file with these lines before, and has CMake say the result.
fn verdict(folder: &Path, version: &str, before: &str) -> [bool; 3] {
    let script = folder.join("ask.cmake");
    let file = version_file(folder, version);
    let say = "message(\"${PACKAGE_VERSION_COMPATIBLE} ${PACKAGE_VERSION_EXACT} ${PACKAGE_VERSION_UNSUITABLE}.\")";
    fs::write(&script, format!("{before}include(\"{file}\")\n{say}\n")).expect("it can be written");
    // What message says goes to the standard error output.
    let said = succeed(command("sh").args(["-c", "cmake -P \"$0\" 2>&1"]).arg(&script));
    let mut words = said.trim().trim_end_matches('.').split(' ').map(|word| word == "TRUE");
    [(); 3].map(|()| words.next().unwrap_or(false))
}

#[test]
fn only_versions_with_the_same_interface_are_served() {
    if !is_there("cmake") {
        return;
    }
    let folder = folder("versions");
    let cases: [(&str, &[&str], &[&str]); 3] = [
        ("0.3.2", &["", "0", "0.3", "0.3.1", "0.3.2.0"], &["0.3.3", "0.2", "0.2.9", "0.4", "0.30", "1", "1.0", "3"]),
        ("1.4.0", &["", "1", "1.0", "1.3.9", "1.4"], &["1.4.1", "1.5", "2", "2.0", "0", "0.1", "0.4", "10"]),
        ("10.0.1", &["10", "10.0"], &["1", "1.0", "100", "0.10"]),
    ];
    for (version, served, refused) in cases {
        for asked in served {
            assert!(verdict(&folder, version, &request(asked))[0], "{version} does not serve {asked}");
        }
        for asked in refused {
            assert!(!verdict(&folder, version, &request(asked))[0], "{version} serves {asked}");
        }
    }
    for (asked, is_served) in
        [("0.2...0.3", false), ("0.2...0.3.2", true), ("0.2...<0.3.2", false), ("0.2...<1", true), ("0.4...1", false)]
    {
        assert_eq!(verdict(&folder, "0.3.2", &request(asked))[0], is_served, "0.3.2 for {asked}");
    }
    assert!(verdict(&folder, "0.3.2", &request("0.3.2"))[1], "0.3.2 is 0.3.2");
    assert!(!verdict(&folder, "0.3.2", &request("0.3"))[1], "0.3.2 is not exactly 0.3");
}

#[test]
fn a_library_for_other_pointers_is_unsuitable() {
    if !is_there("cmake") {
        return;
    }
    let folder = folder("pointers");
    for (size, is_unsuitable) in [("", false), ("8", false), ("4", true)] {
        let before = format!("set(CMAKE_SIZEOF_VOID_P \"{size}\")\n{}", request("1.0"));
        assert_eq!(verdict(&folder, "1.0.0", &before)[2], is_unsuitable, "pointers of {size} bytes");
    }
}
