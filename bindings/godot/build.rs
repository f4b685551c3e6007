//! Links the library by its C API. BESPOKE_LIBRARY is the folder that it lies in; by default that of `make`, then that of cargo.

use std::path::{Path, PathBuf};

fn main() {
    println!("cargo:rerun-if-env-changed=BESPOKE_LIBRARY");
    let top = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let named = std::env::var_os("BESPOKE_LIBRARY").map(PathBuf::from);
    let folder = named.unwrap_or_else(|| {
        let made = top.join("build");
        if made.join("libbespoke.so").exists() { made } else { top.join("target/release") }
    });
    println!("cargo:rustc-link-search=native={}", folder.display());
    println!("cargo:rustc-link-lib=dylib=bespoke");
    // In an add-on, and in an exported game, both lie in one folder.
    println!("cargo:rustc-cdylib-link-arg=-Wl,-rpath,$ORIGIN");
}
