//! From the inputs to the terms of the objective: what is derived once, before anything moves.

pub mod bone_map;
pub mod cap_motion;
pub mod carried_pieces;
pub mod carried_places;
pub mod closed_pieces;
pub mod contact_distances;
pub mod curves;
pub mod fit_region;
pub mod hanging_pieces;
pub mod known_garment;
pub mod layer_skin;
pub mod limb_sizes;
pub mod loop_axis;
pub mod loose_pieces;
pub mod near_borders;
pub mod normalization;
pub mod pin_targets;
pub mod problem;
pub mod shape;
pub mod shell_rims;
pub mod source_body;
pub mod wishes;
