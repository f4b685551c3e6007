//! The C API, called as a C program calls it.
mod arguments;
mod caller;
mod cancel;
mod control;
mod diagnostics;
mod distortion;
mod faults;
mod header;
mod meshes;
mod results;
mod retarget;
mod states;
mod threads;

#[path = "../support/mod.rs"]
mod support;
