//! A session from inputs to a verified result.

mod assets;
mod cancel;
mod determinism;
mod distortion;
mod memory;
mod profile;
mod shifted;
mod small;
mod tangled;

#[path = "../support/obj.rs"]
mod obj;
#[path = "../support/mod.rs"]
mod support;
