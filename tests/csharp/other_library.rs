//! A library that is called like ours and has another binary interface.

use std::fs;
use std::path::PathBuf;
use std::process::Command;

use testing::process::scratch;

/// The folder with it.
pub fn folder() -> PathBuf {
    let folder = scratch("csharp-other-library");
    let source = folder.join("other.c");
    let text = "unsigned bespoke_abi_version(void) { return 99; }\n\
                const char *bespoke_version_text(void) { return \"9.9.9\"; }\n";
    fs::write(&source, text).expect("a source file");
    let name = if cfg!(target_os = "macos") { "libbespoke.dylib" } else { "libbespoke.so" };
    let made = Command::new("cc").args(["-shared", "-fPIC", "-o"]).arg(folder.join(name)).arg(source).status();
    assert!(made.expect("a C compiler").success());
    folder
}
