//! A session from inputs to a verified result.

mod assets;
mod determinism;
mod small;

#[path = "../support/obj.rs"]
mod obj;
#[path = "../support/mod.rs"]
mod support;
