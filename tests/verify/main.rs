//! The exact verifier.

mod cases;
mod real_meshes;
mod soups;
mod twin;
