//! What a caller hands in.

mod guide;
//! What a caller hands in: checks, connectivity, skeleton, weights, buffers, spaces.
mod buffer;
mod mesh;
mod skeleton;
mod skin;
mod space;
#[path = "../support/obj.rs"]
mod obj;
#[path = "../support/mod.rs"]
mod support;
