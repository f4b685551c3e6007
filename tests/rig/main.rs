//! Rigs of real characters.

mod blend;
mod large;
mod limbs;
mod names;
mod own_joints;
mod weights;
mod weights_random;
