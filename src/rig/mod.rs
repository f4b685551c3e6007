//! Rigs of real characters: what their joints are.

pub mod body_part;
pub mod names;
