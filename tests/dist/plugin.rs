//! A plugin in Rust that is built over the crate without the feature `capi` exports nothing of the library.

use std::path::{Path, PathBuf};
use std::process::Command;

use testing::process::{root, succeed};

/// The plugin, built without optimisation and into a folder that stays from run to run: other features than those of the
/// tests make another library, and the two would overwrite each other. The shim is taken from where the tests have it.
fn plugin() -> PathBuf {
    let target = Path::new(env!("CARGO_TARGET_TMPDIR")).join("plugin");
    let shim = format!("target.{}.bespoke_volume", host());
    let search = match std::env::var("OPENVDB_ROOT") {
        Ok(openvdb) => format!("[{:?}, {:?}]", env!("OUT_DIR"), format!("{openvdb}/lib")),
        Err(_) => format!("[{:?}]", env!("OUT_DIR")),
    };
    succeed(
        Command::new(env!("CARGO"))
            .current_dir(root())
            .args(["build", "--quiet", "--offline", "--locked", "--package", "plugin", "--target-dir"])
            .arg(&target)
            .args(["--config", "profile.dev.opt-level=0", "--config", "profile.dev.debug=false"])
            .arg("--config")
            .arg(format!("{shim}.rustc-link-search={search}"))
            .arg("--config")
            .arg(format!("{shim}.rustc-link-lib=[\"static=bespoke_volume\", \"openvdb\", \"tbb\", \"stdc++\"]")),
    );
    target.join("debug/libplugin.so")
}

/// The target for which cargo builds here.
fn host() -> String {
    let told = succeed(Command::new("rustc").arg("-vV"));
    let host = told.lines().find_map(|line| line.strip_prefix("host: "));
    host.expect("rustc names its host").to_owned()
}

#[test]
fn a_rust_plugin_exports_its_own_functions_only() {
    let listed = succeed(Command::new("nm").args(["--dynamic", "--defined-only", "--format=posix"]).arg(plugin()));
    let exported: Vec<&str> = listed.lines().filter_map(|line| line.split(' ').next()).collect();
    assert_eq!(exported, ["plugin_is_ready"]);
}
