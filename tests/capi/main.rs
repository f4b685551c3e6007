//! The C API, called as a C program calls it.
mod arguments;
mod caller;
mod cancel;
mod control;
mod diagnostics;
mod distortion;
mod faults;
mod fit_controls;
mod header;
mod hosts;
mod layers;
mod manual;
mod meshes;
mod results;
mod retarget;
mod states;
mod threads;

#[path = "../support/library.rs"]
mod library;
#[path = "../support/obj_text.rs"]
mod obj_text;
#[path = "../support/process.rs"]
mod process;
#[path = "../support/mod.rs"]
mod support;
