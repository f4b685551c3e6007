//! The ground: triangle meshes, search trees over boxes, closest points. Knows neither a user nor a solver.

pub mod bvh;
pub mod closest_point;
pub mod mesh;
pub mod sliver_caps;
