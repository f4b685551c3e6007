//! The C API, called as a C program calls it.
mod arguments;
mod caller;
mod control;
mod header;
mod meshes;
mod results;
mod retarget;
mod states;
mod threads;
