//! Uninstalling removes what was installed, and nothing else.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use crate::prefix::{folder, install, tree, uninstall};

fn names<const N: usize>(names: [&str; N]) -> BTreeSet<String> {
    names.map(str::to_owned).into()
}

#[test]
fn an_empty_prefix_stays_behind() {
    let prefix = folder("uninstall");
    install(&prefix, &[]);
    install(&prefix, &[]);
    uninstall(&prefix, &[]);
    assert_eq!(tree(&prefix), BTreeSet::new());
    assert!(prefix.is_dir());
    // There is nothing to do, which is no failure.
    uninstall(&prefix, &[]);
}

#[test]
fn files_and_folders_of_others_stay() {
    let prefix = folder("uninstall beside others");
    fs::create_dir_all(prefix.join("lib/pkgconfig")).expect("a folder");
    fs::create_dir_all(prefix.join("etc")).expect("a folder");
    fs::write(prefix.join("lib/pkgconfig/other.pc"), "").expect("a file");
    fs::write(prefix.join("lib/libbespoke.so.0.0.0.1"), "").expect("a file");
    install(&prefix, &[]);
    uninstall(&prefix, &[]);
    assert_eq!(tree(&prefix), names(["etc/", "lib/libbespoke.so.0.0.0.1", "lib/pkgconfig/other.pc"]));
}

/// Whoever copies a program to /usr/local/bin expects a folder there.
#[test]
fn the_systems_folders_stay_in_its_prefixes() {
    let stage = folder("uninstall of the system");
    let staged = [("DESTDIR", stage.to_str().expect("UTF-8"))];
    install(Path::new("/usr/local"), &staged);
    uninstall(Path::new("/usr/local"), &staged);
    let shared = ["bin/", "include/", "lib/", "share/doc/"].map(|name| format!("usr/local/{name}"));
    assert_eq!(tree(&stage), shared.into());
}
