//! What a caller hands in, checked and turned into ours.

pub mod guide;
pub mod mesh;
pub mod skeleton;
