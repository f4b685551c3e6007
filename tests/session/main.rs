//! A session from inputs to a verified result.

mod assets;
mod cancel;
mod determinism;
mod distortion;
mod fit_controls;
mod layers;
mod memory;
mod profile;
mod shifted;
mod small;
mod tangled;

#[allow(dead_code)]
#[path = "../../examples/closet/generator/mod.rs"]
mod closet;
#[path = "../support/obj.rs"]
mod obj;
#[path = "../support/mod.rs"]
mod support;
