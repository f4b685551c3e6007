//! The program that is shipped runs with older C libraries, as the library does.

use std::env;

/// Folder that `packaging/dist/floor/stubs.sh` made: libraries to link against in place of the system's C library.
const FLOOR: &str = "BESPOKE_GLIBC_FLOOR";

fn main() {
    println!("cargo:rerun-if-changed=build.rs");
    println!("cargo:rerun-if-env-changed={FLOOR}");
    if let Ok(floor) = env::var(FLOOR) {
        println!("cargo:rustc-link-arg-bins=-L{floor}");
        println!("cargo:rustc-link-arg-bins=-lfloor");
        println!("cargo:rustc-link-arg-bins=-Wl,--allow-shlib-undefined");
    }
}
