//! The exact verifier.

mod cases;
mod real_meshes;
mod soups;
mod twin;

#[path = "../support/obj.rs"]
mod obj;
#[path = "../support/mod.rs"]
mod support;
