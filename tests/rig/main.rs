//! Rigs of real characters.

mod blend;
mod joint_map;
mod large;
mod limbs;
mod names;
mod own_joints;
mod places;
mod pose_path;
mod posing;
mod structure;
mod weights;
mod weights_random;
mod words;
mod worn;
