//! Rigs of real characters: what their joints are, which correspond, the skeleton that two of them have in common, poses, and
//! what a garment needs to move with them.

pub mod body_part;
pub mod clothed;
pub mod common_skeleton;
pub mod hands;
pub mod joint_map;
pub mod landmark;
pub mod names;
pub mod part_name;
pub mod places;
pub mod pose_path;
pub mod posing;
pub mod reading;
pub mod structure;
pub mod weights;
pub mod words;
pub mod worn;
