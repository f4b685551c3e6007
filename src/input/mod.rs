//! What a caller hands in, checked and turned into ours.

pub mod mesh;
pub mod skeleton;
