//! The plugin as packaging/unreal/pack.sh makes it.

use std::fs;
use std::path::Path;
use std::process::Command;

use testing::library;
use testing::process::{root, scratch};

#[test]
fn description_and_folders_fit_together() {
    let folder = scratch("unreal-plugin");
    let shipped = folder.join("shipped");
    for inner in ["lib", "include", "licences"] {
        fs::create_dir_all(shipped.join(inner)).expect("a folder");
    }
    fs::write(shipped.join("licences/README.md"), "What is inside.\n").expect("a file");
    fs::copy(library::folder().join("libbespoke.so"), shipped.join("lib/libbespoke.so")).expect("the library");
    let mut script = Command::new("sh");
    script
        .arg(root().join("packaging/unreal/pack.sh"))
        .arg(&shipped)
        .arg(folder.join("windows"))
        .arg(folder.join("out"));
    let output = script.output().expect("sh runs");
    let complained = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{complained}");
    assert!(complained.contains("skipped: the Windows library"), "{complained}");
    let plugin = folder.join("out/Bespoke");

    let text = fs::read_to_string(plugin.join("Bespoke.uplugin")).expect("a description");
    let description: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    assert_eq!(description["FileVersion"], 3);
    assert_eq!(description["VersionName"], env!("CARGO_PKG_VERSION"));
    let source = plugin.join("Source");
    for module in description["Modules"].as_array().expect("modules") {
        let name = module["Name"].as_str().expect("a name");
        let rules = fs::read_to_string(source.join(format!("{name}/{name}.Build.cs"))).expect("its rules");
        assert!(rules.contains(&format!("public class {name} : ModuleRules")), "{rules}");
        assert!(fs::read_dir(source.join(name).join("Private")).expect("sources").count() > 0);
    }
    let third = source.join("ThirdParty/BespokeLibrary");
    let abi = bespoke::capi::version::BESPOKE_ABI_VERSION;
    for file in ["include/bespoke.h", "include/bespoke.hpp", "lib/Linux/libbespoke.so"] {
        assert!(third.join(file).is_file(), "{file}");
    }
    assert!(third.join(format!("lib/Linux/libbespoke.so.{abi}")).is_file(), "the name for the loader");
    // The script and the package that it needs, side by side.
    for file in ["bespoke_unreal.py", "bespoke/__init__.py", "bespoke/libbespoke.so"] {
        assert!(plugin.join("Content/Python").join(file).is_file(), "{file}");
    }
    for file in ["README.md", "Resources/troubleshooting.md", "LICENSE-MIT", "licences/README.md"] {
        assert!(plugin.join(file).is_file(), "{file}");
    }
    assert!(!has_caches(&plugin), "nothing that an interpreter has left");
}

fn has_caches(folder: &Path) -> bool {
    fs::read_dir(folder).expect("a folder").any(|entry| {
        let path = entry.expect("an entry").path();
        path.ends_with("__pycache__") || (path.is_dir() && has_caches(&path))
    })
}
