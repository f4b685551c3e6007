//! Contact between the garment and the avatar, and of the garment with itself.
//!
//! A pair of primitives (point and triangle, or edge and edge) is four vertices in the combined numbering of
//! [`Bodies`]. The broad phase finds the pairs that may come close, [`ccd`] bounds the step by them, and the
//! barrier term keeps them apart. Two primitives of the avatar never make a pair.

pub mod bodies;
pub mod broad_phase;
pub mod candidate_set;
pub mod ccd;
pub mod curvature;
pub mod distance;
pub mod exempt_pairs;
pub mod mollifier;
pub mod one_ring;
pub mod surface;
mod swept;

pub use bodies::{Avatar, Bodies, Configuration, Garment, Motion, Step};
pub use broad_phase::BroadPhase;
pub use candidate_set::{CandidateSet, CollisionGroup};
pub use distance::PairType;
pub use exempt_pairs::ExemptPairs;
pub use surface::Surface;
