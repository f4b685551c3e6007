//! What the library gives and asks for: the functions of the header, and libraries that every Windows has.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;
use std::process::Command;

use crate::shipped::{CROSS, folder};
use testing::process::{root, succeed};

fn pinned() -> BTreeSet<String> {
    let text = fs::read_to_string(root().join("tests/dist/symbols.txt")).expect("the list of symbols");
    text.lines().map(str::to_owned).collect()
}

fn headers(file: &Path) -> String {
    succeed(Command::new(format!("{CROSS}objdump")).arg("-p").arg(file))
}

/// The names that a DLL exports.
fn exported(file: &Path) -> BTreeSet<String> {
    let text = headers(file);
    let (_, table) = text.split_once("[Ordinal/Name Pointer] Table").expect("a table of names");
    let lines = table.lines().skip(1).take_while(|line| !line.trim().is_empty());
    lines.map(|line| line.split_whitespace().next_back().expect("a name").to_owned()).collect()
}

/// The libraries that a file is loaded with, each with the names that are asked of it.
fn imports(file: &Path) -> Vec<(String, BTreeSet<String>)> {
    let mut found: Vec<(String, BTreeSet<String>)> = Vec::new();
    let text = headers(file);
    let (_, table) = text.split_once("The Import Tables").expect("a table of imports");
    for line in table.lines() {
        if let Some(name) = line.trim().strip_prefix("DLL Name: ") {
            found.push((name.to_lowercase(), BTreeSet::new()));
        } else if let [_, hint, name] = line.split_whitespace().collect::<Vec<_>>()[..]
            && hint.chars().all(|c| c.is_ascii_digit())
            && let Some((_, names)) = found.last_mut()
        {
            names.insert(name.to_owned());
        } else if line.starts_with("The Export Tables") {
            break;
        }
    }
    found
}

#[test]
fn exactly_the_functions_of_the_header_are_exported() {
    let Some(folder) = folder() else { return };
    assert_eq!(exported(&folder.join("bin/bespoke.dll")), pinned());
    let definitions = fs::read_to_string(folder.join("lib/bespoke.def")).expect("the list for linkers");
    let listed: BTreeSet<String> = definitions.lines().skip(2).map(|line| line.trim().to_owned()).collect();
    assert_eq!(listed, pinned(), "lib/bespoke.def");
    for library in ["bespoke.lib", "libbespoke.dll.a"] {
        let listed = succeed(Command::new(format!("{CROSS}nm")).arg(folder.join("lib").join(library)));
        for name in pinned() {
            for symbol in [format!(" {name}"), format!(" __imp_{name}")] {
                assert!(listed.lines().any(|line| line.ends_with(&symbol)), "{library} has no{symbol}");
            }
        }
    }
}

/// Of every Windows from 10 on.
const SYSTEM: [&str; 13] = [
    "advapi32.dll",
    "api-ms-win-core-synch-l1-2-0.dll",
    "bcrypt.dll",
    "bcryptprimitives.dll",
    "kernel32.dll",
    "msvcrt.dll",
    "ntdll.dll",
    "ole32.dll",
    "psapi.dll",
    "shell32.dll",
    "user32.dll",
    "userenv.dll",
    "ws2_32.dll",
];

#[test]
fn only_libraries_of_the_system_are_loaded() {
    let Some(folder) = folder() else { return };
    for (file, ours) in [("bespoke.dll", ""), ("bespoke.exe", ""), ("retarget.exe", "bespoke.dll")] {
        let imports = imports(&folder.join("bin").join(file));
        assert!(imports.len() > 1, "{file} imports {imports:?}");
        for (library, names) in imports {
            assert!(SYSTEM.contains(&&*library) || library == ours, "{file} loads {library}");
            assert!(!names.is_empty(), "{file} asks {library} for nothing");
        }
    }
}

/// Those of Windows' C library have other last bits than those of Linux. MinGW's linker keeps functions that nobody calls,
/// so that two names are left: glam's rotations ask for `atan2`, OpenVDB's transforms for `pow`. That nobody calls them
/// shows the library for Linux, where both are gone (tests/dist/symbols.rs).
#[test]
fn no_elementary_function_of_the_system_is_called() {
    let Some(folder) = folder() else { return };
    let functions: BTreeSet<&str> =
        "acos asin atan cbrt cos cosh exp exp2 expm1 hypot log log10 log1p log2 sin sinh tan tanh fma"
            .split_whitespace()
            .collect();
    for (library, names) in imports(&folder.join("bin/bespoke.dll")) {
        for name in names {
            let plain = name.strip_suffix('f').unwrap_or(&name);
            let is_asked = functions.contains(plain) || functions.contains(&*name);
            assert!(!is_asked, "the library asks {library} for {name}");
        }
    }
}

#[test]
fn the_library_says_its_version() {
    let Some(folder) = folder() else { return };
    let bytes = fs::read(folder.join("bin/bespoke.dll")).expect("the library");
    let holds = |text: &str| {
        let wide: Vec<u8> = text.encode_utf16().flat_map(u16::to_le_bytes).collect();
        bytes.windows(wide.len()).any(|window| window == wide)
    };
    assert!(holds("FileVersion\0"), "the library has no version for Windows");
    assert!(holds(&format!("{}\0", env!("CARGO_PKG_VERSION"))), "the version is another");
}

/// Every function that the C# binding takes from the library, by its name.
#[test]
fn the_c_sharp_binding_finds_its_functions() {
    let Some(folder) = folder() else { return };
    let text = fs::read_to_string(folder.join("bindings/csharp/Bespoke/Native.g.cs")).expect("the calls of C#");
    let exported = exported(&folder.join("bin/bespoke.dll"));
    let mut count = 0;
    for part in text.split("[DllImport(").skip(1) {
        let call = part.split_once(" extern ").expect("a declaration").1;
        let name = call.split('(').next().and_then(|before| before.split(' ').next_back()).expect("a name");
        assert!(exported.contains(name), "{name} is not exported");
        count += 1;
    }
    assert_eq!(count, exported.len(), "C# has other functions");
}
