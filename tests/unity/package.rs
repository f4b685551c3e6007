//! What packaging/unity/pack.sh makes: the layout, and the .meta files.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::OnceLock;

use testing::library;
use testing::process::{is_there, root, scratch, succeed};

const NAME: &str = "com.bespoke.retarget";

/// The package, with something that stands for the library for Windows or without; made once.
fn packed(with_windows: bool) -> &'static (PathBuf, String) {
    static WITH: OnceLock<(PathBuf, String)> = OnceLock::new();
    static WITHOUT: OnceLock<(PathBuf, String)> = OnceLock::new();
    if with_windows {
        WITH.get_or_init(|| pack("unity-package", true))
    } else {
        WITHOUT.get_or_init(|| pack("unity-package-linux", false))
    }
}

/// A package around the library of these tests; with something that stands for the one for Windows, if it is asked for.
fn pack(name: &str, with_windows: bool) -> (PathBuf, String) {
    let folder = scratch(name);
    let shipped = folder.join("shipped");
    fs::create_dir_all(shipped.join("lib")).expect("a folder");
    fs::create_dir_all(shipped.join("licences")).expect("a folder");
    fs::write(shipped.join("licences/README.md"), "What is inside.\n").expect("a file");
    fs::copy(library::folder().join("libbespoke.so"), shipped.join("lib/libbespoke.so")).expect("the library");
    if with_windows {
        fs::create_dir_all(folder.join("windows/bin")).expect("a folder");
        fs::write(folder.join("windows/bin/bespoke.dll"), "MZ").expect("a file");
    }
    let mut script = Command::new("sh");
    script
        .arg(root().join("packaging/unity/pack.sh"))
        .arg(&shipped)
        .arg(folder.join("windows"))
        .arg(folder.join("out"));
    let output = script.output().expect("sh runs");
    let complained = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(output.status.success(), "{complained}");
    (folder.join("out"), complained)
}

/// All that lies below, as paths from there.
fn everything(folder: &Path) -> BTreeSet<String> {
    let mut found = BTreeSet::new();
    let mut left = vec![folder.to_path_buf()];
    while let Some(next) = left.pop() {
        for entry in fs::read_dir(&next).expect("a folder") {
            let path = entry.expect("an entry").path();
            found.insert(path.strip_prefix(folder).expect("it lies below").display().to_string());
            if path.is_dir() {
                left.push(path);
            }
        }
    }
    found
}

/// The GUID of each asset.
fn guids(package: &Path) -> BTreeMap<String, String> {
    let guid = |path: String| {
        let meta = fs::read_to_string(package.join(format!("{path}.meta"))).expect("a .meta file");
        let lines: Vec<&str> = meta.lines().collect();
        assert_eq!(lines[0], "fileFormatVersion: 2", "{path}");
        let guid = lines[1].strip_prefix("guid: ").expect("a GUID").to_string();
        assert!(
            guid.len() == 32 && guid.chars().all(|c| c.is_ascii_digit() || ('a'..='f').contains(&c)),
            "{path}: {guid}"
        );
        assert_eq!(lines[2] == "folderAsset: yes", package.join(&path).is_dir(), "{path}");
        let importers = lines.iter().filter(|line| line.ends_with("Importer:")).count();
        assert_eq!(importers, 1, "{path}: {meta}");
        (path, guid)
    };
    everything(package).into_iter().filter(|path| is_asset(path) && !path.ends_with(".meta")).map(guid).collect()
}

/// Whether the engine sees it.
fn is_asset(path: &str) -> bool {
    path.split('/').all(|part| !part.ends_with('~') && !part.starts_with('.'))
}

#[test]
fn every_asset_has_its_meta_file_and_nothing_else_does() {
    let (out, complained) = packed(true);
    assert!(!complained.contains("bespoke.dll"), "{complained}");
    let package = out.join(NAME);
    let guids = guids(&package);
    assert_eq!(guids.values().collect::<BTreeSet<_>>().len(), guids.len(), "a GUID occurs twice");
    for path in everything(&package).iter().filter_map(|path| path.strip_suffix(".meta")) {
        assert!(guids.contains_key(path), "{path}.meta belongs to nothing");
    }
    for path in [
        "package.json",
        "README.md",
        "CHANGELOG.md",
        "LICENSE-MIT.md",
        "Runtime/Binding/Bespoke.asmdef",
        "Runtime/Binding/Session.cs",
        "Runtime/Core/Bespoke.Unity.Core.asmdef",
        "Runtime/Engine/Bespoke.Unity.asmdef",
        "Editor/BespokeWindow.cs",
        "Tests/Runtime/Bespoke.Unity.Tests.asmdef",
        "Runtime/Plugins/Linux/x86_64/libbespoke.so",
        "Runtime/Plugins/Windows/x86_64/bespoke.dll",
    ] {
        assert!(guids.contains_key(path), "{path} is not in the package");
    }
    for path in
        ["Documentation~/troubleshooting.md", "Samples~/DressFromScript/DressFromScript.cs", "Licences~/README.md"]
    {
        assert!(package.join(path).is_file(), "{path} is not in the package");
    }
    // They stay with the path, whatever else is in the package: without the one library, all others are the same.
    let (again, complained) = packed(false);
    assert!(complained.contains("skipped: the Windows library"), "{complained}");
    let again = self::guids(&again.join(NAME));
    assert!(again.len() == guids.len() - 3, "{} and {}", again.len(), guids.len());
    assert!(again.iter().all(|(path, guid)| guids[path] == *guid), "a GUID has changed");
    // What projects refer to is not to change from version to version.
    assert_eq!(guids["Runtime/Core/Dials.cs"], "2d76f01f6eed9c1ed8efcd5f7bd6ec91");
}

/// What a tooltip says is what the header says, in the words of a window.
#[test]
fn tooltips_are_those_of_the_header() {
    let read = |path: &str| fs::read_to_string(root().join(path)).expect("a file of the repository");
    let described: serde_json::Value = serde_json::from_str(&read("bindings/bespoke.json")).expect("JSON");
    let texts = read("bindings/unity/Runtime/Core/DialTexts.cs");
    let constants = texts.split("public const string ").skip(1).map(|rest| rest.split_once(" =").expect("a constant"));
    let mut count = 0;
    for (dial, rest) in constants {
        let value = rest.split(";\n").next().expect("its end");
        // Every other piece between quotation marks is one of the text.
        let said: String = value.split('"').skip(1).step_by(2).collect();
        let option = match dial {
            "Fit" => "fit_weight",
            "Looseness" => "designed_clearance",
            "Offset" => "offset",
            "FitDistance" => "fit_distance",
            "WeldDistance" => "weld_distance",
            "KeepCaps" => "keep_caps",
            "Strict" => "strict",
            "Threads" => "threads",
            other => panic!("{other} is no dial"),
        };
        let options = described["options"].as_array().expect("options");
        let found = options.iter().find(|known| known["name"] == option).expect("an option");
        let mut doc = found["doc"].as_str().expect("a text").to_string();
        for (of_c, of_window) in [
            ("BESPOKE_WEIGHT_OFF", "0"),
            ("bespoke_session_read_diagnostics", "the findings"),
            ("BespokeReport.threads", "The report"),
            ("1: a garment", "On: a garment"),
            ("1: triangles", "On: triangles"),
            ("Default 0: ", "Default off: "),
        ] {
            doc = doc.replace(of_c, of_window);
        }
        assert_eq!(said, doc, "{dial}");
        count += 1;
    }
    assert_eq!(count, 8);
}

#[test]
fn libraries_are_for_their_systems() {
    let (out, _) = packed(true);
    for (library, system, other) in
        [("Linux/x86_64/libbespoke.so", "Linux", "Win64"), ("Windows/x86_64/bespoke.dll", "Windows", "Linux64")]
    {
        let meta = out.join(NAME).join(format!("Runtime/Plugins/{library}.meta"));
        let meta = fs::read_to_string(meta).expect("a .meta file");
        let own = if system == "Linux" { "Linux64" } else { "Win64" };
        assert!(meta.contains(&format!("OS: {system}\n")) && meta.contains("CPU: x86_64"), "{meta}");
        for (player, is_excluded) in [(own, 0), (other, 1), ("Editor", 0), ("OSXUniversal", 1)] {
            assert!(meta.contains(&format!("Exclude {player}: {is_excluded}\n")), "{player}: {meta}");
        }
        let enabled = |player: &str| {
            let rest = meta.split(&format!("Standalone: {player}\n")).nth(1).expect("the player");
            rest.split("enabled: ").nth(1).and_then(|rest| rest.chars().next()).expect("a number")
        };
        assert_eq!((enabled(own), enabled(other)), ('1', '0'), "{meta}");
    }
}

#[test]
fn manifest_and_assemblies_fit_together() {
    let (out, _) = packed(false);
    let package = out.join(NAME);
    let read = |path: &Path| -> serde_json::Value {
        serde_json::from_str(&fs::read_to_string(path).expect("a file")).unwrap_or_else(|e| panic!("{path:?}: {e}"))
    };
    let manifest = read(&package.join("package.json"));
    assert_eq!(manifest["name"], NAME);
    assert_eq!(manifest["version"], env!("CARGO_PKG_VERSION"));
    let changes = fs::read_to_string(package.join("CHANGELOG.md")).expect("a file");
    assert!(changes.contains(&format!("## [{}]", env!("CARGO_PKG_VERSION"))), "the version is in its CHANGELOG.md");
    for sample in manifest["samples"].as_array().into_iter().flatten() {
        let path = sample["path"].as_str().expect("a path");
        assert!(package.join(path).is_dir(), "{path}");
    }
    let assemblies: Vec<_> = everything(&package).into_iter().filter(|path| path.ends_with(".asmdef")).collect();
    let parsed: Vec<_> = assemblies.iter().map(|path| read(&package.join(path))).collect();
    let names: BTreeSet<&str> = parsed.iter().map(|assembly| assembly["name"].as_str().expect("a name")).collect();
    assert_eq!(names.len(), assemblies.len());
    for (path, assembly) in assemblies.iter().zip(&parsed) {
        let name = assembly["name"].as_str().expect("a name");
        assert!(path.ends_with(&format!("/{name}.asmdef")), "{path} is called {name}");
        for reference in assembly["references"].as_array().expect("references") {
            let reference = reference.as_str().expect("a name");
            let is_known = names.contains(reference) || reference.starts_with("Unity");
            assert!(is_known, "{path} refers to {reference}, which is not there");
        }
        // An assembly without a script is a warning of the editor.
        let folder = package.join(path).parent().expect("a folder").to_path_buf();
        assert!(everything(&folder).iter().any(|file| file.ends_with(".cs")), "{path} has no sources");
        let is_editor = assembly["includePlatforms"] == serde_json::json!(["Editor"]);
        assert_eq!(is_editor, path.starts_with("Editor/") || path.starts_with("Tests/Editor/"), "{path}");
    }
}

#[test]
fn npm_packs_it() {
    if !is_there("npm") {
        return;
    }
    let (out, _) = packed(false);
    let tarball = out.join(format!("{NAME}-{}.tgz", env!("CARGO_PKG_VERSION")));
    let listed = succeed(Command::new("tar").arg("-tzf").arg(&tarball));
    let packed: BTreeSet<&str> = listed.lines().filter_map(|line| line.strip_prefix("package/")).collect();
    let files: BTreeSet<String> =
        everything(&out.join(NAME)).into_iter().filter(|path| out.join(NAME).join(path).is_file()).collect();
    assert_eq!(packed, files.iter().map(String::as_str).collect::<BTreeSet<_>>());
}
