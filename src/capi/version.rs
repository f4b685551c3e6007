//! Which library this is.

use std::ffi::{CStr, c_char};

/// Number of the binary interface that this header describes. It changes when a program built with another header
/// would no longer work; additions at the end of a struct with a `struct_size` do not change it.
pub const BESPOKE_ABI_VERSION: u32 = 2;

/// The crate's version with the zero byte that C wants.
const VERSION: &CStr = match CStr::from_bytes_with_nul(concat!(env!("CARGO_PKG_VERSION"), "\0").as_bytes()) {
    Ok(version) => version,
    Err(_) => panic!("the crate's version holds a zero byte"),
};

/// The binary interface of the library that is loaded. Compare with BESPOKE_ABI_VERSION before anything else.
///
/// Threads: any, at any time.
#[unsafe(no_mangle)]
pub extern "C" fn bespoke_abi_version() -> u32 {
    BESPOKE_ABI_VERSION
}

/// The version of the library that is loaded, such as "0.1.0".
///
/// Ownership: the text is part of the library, never freed. Threads: any, at any time.
#[unsafe(no_mangle)]
pub extern "C" fn bespoke_version_text() -> *const c_char {
    VERSION.as_ptr()
}
