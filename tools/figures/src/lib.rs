//! The figures of the paper's evaluation: what is dressed for each, what is measured, and the claims it has to keep.

pub mod clearance;
pub mod comparison;
pub mod curve_term;
pub mod dressed;
pub mod figure;
pub mod fit_weight;
pub mod key_poses;
pub mod layers;
pub mod measure;
pub mod poses;
pub mod resolution;
pub mod shells;
pub mod skeleton_edits;
pub mod skin_weights;
pub mod stress;
pub mod transfer;
