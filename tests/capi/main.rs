//! The C API, called as a C program calls it.
mod arguments;
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
mod options;
mod results;
mod retarget;
mod states;
mod threads;
