//! What goes along with a garment: normals and tangents, morphs, and meshes that are bound to it.

mod binding;
mod normals;
mod scene;
