//! What goes along with a garment from its design to where it is now: normals and tangents of render vertices.
//!
//! All of it is read off the motions of the garment's triangles, in the normalised space.

pub mod normals;
pub mod surface;
