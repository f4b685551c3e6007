//! Geometry: triangle meshes, search trees over boxes, closest points. It depends on neither the inputs nor the solver.
//!
//! There are two trees of boxes. That of [`bvh`] has boxes in single precision, which are refitted in every step, and is
//! traversed against another tree; that of [`closest_point`] has boxes in double precision, is built once, and is asked for
//! points. A builder for both would save some 25 lines, and tie the orders of both to each other, on which the bits of
//! results depend. The third tree, of [`crate::verify`], is separate on purpose: the verifier uses none of the
//! contact code.

pub mod alignment;
pub mod border_edges;
pub mod bvh;
pub mod closest_point;
pub mod cover;
pub mod covered;
pub mod crumpled;
pub mod median;
pub mod mesh;
pub mod missing_faces;
pub mod outfit;
pub mod piece;
pub mod quantile;
pub mod section;
pub mod sliver_caps;
pub mod solid_angle;
pub mod spread;
pub mod t_junctions;
pub mod triangle_motion;
pub mod turn;
