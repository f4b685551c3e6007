//! What goes along with a garment from its design to where it is now: normals and tangents of render vertices, morphs, and
//! meshes that are bound to it.
//!
//! All of it is read off the motions of the garment's triangles, in the normalised space.

pub mod binding;
pub mod normals;
pub mod surface;
