//! Rigs of real characters: what their joints are, and what a garment needs to move with them.

pub mod body_part;
pub mod names;
pub mod weights;
