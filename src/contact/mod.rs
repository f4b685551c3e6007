//! Contact between the garment and the avatar, and of the garment with itself.
//!
//! A pair of primitives (point and triangle, or edge and edge) is four vertices in the combined numbering of
//! [`Bodies`]. The broad phase finds the pairs that may come close, [`ccd`] bounds the step by them, and the
//! barrier term keeps them apart. Two primitives of the avatar never make a pair.

pub mod bodies;
pub mod bvh;
pub mod candidates;
pub mod ccd;
pub mod distance;
pub mod mollifier;
pub mod neighbours;
pub mod surface;
mod swept;
pub mod tangle;

pub use bodies::{Avatar, Bodies, Configuration, Garment, Motion, Step};
pub use candidates::{BroadPhase, CandidateSet, Class};
pub use distance::Kind;
pub use surface::Surface;
pub use tangle::Tangle;
