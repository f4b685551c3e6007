//! What goes along with a garment: normals and tangents.

mod normals;
mod scene;
