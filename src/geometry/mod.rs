//! The ground: triangle meshes, search trees over boxes, closest points. Knows neither a user nor a solver.
//!
//! There are two trees of boxes. That of [`bvh`] has boxes in single precision, which are refitted in every step, and is
//! traversed against another tree; that of [`closest_point`] has boxes in double precision, is built once, and is asked for
//! points. A builder for both would save some 25 lines, and tie the orders of both to each other, on which the bits of
//! results depend. The third tree, of [`crate::verify`], is apart on purpose: the verifier uses none of the code that keeps
//! contact free.

pub mod bvh;
pub mod closest_point;
pub mod mesh;
pub mod sliver_caps;
