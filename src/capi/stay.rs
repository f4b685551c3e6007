//! Keeps the library in memory on Windows, once a session was made: what the threads of the host have to destroy as they
//! end outlives the last session, and a library that were really unloaded would take the code from under them. On Linux the
//! linker's `-z nodelete` does the same.

/// Whoever unloads the library from now on only counts down.
#[cfg(windows)]
pub(super) fn stay() {
    use std::ffi::c_void;

    const PIN: u32 = 1;
    const FROM_ADDRESS: u32 = 4;
    unsafe extern "system" {
        fn GetModuleHandleExW(flags: u32, name: *const c_void, module: *mut *mut c_void) -> i32;
    }
    let mut module = std::ptr::null_mut();
    // SAFETY: with this flag the name is any address within the module. A failure leaves everything as it was.
    unsafe { GetModuleHandleExW(PIN | FROM_ADDRESS, stay as *const c_void, &raw mut module) };
}

/// Nothing: the linker was told.
#[cfg(not(windows))]
pub(super) fn stay() {}
