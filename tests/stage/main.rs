//! The steps of the method: normalised space, projection, inflation, fit.

mod beyond_openings;
mod blockage;
mod bodies;
mod bone_map;
mod caps;
mod carried_places;
mod contour;
mod enclosure;
mod fit_region;
mod foreign_parts;
mod hats;
mod inside;
mod joints;
mod layer_skin;
mod loop_axis;
mod normalization;
mod open_ends;
mod owners;
mod pin_targets;
mod plausibility;
mod projection;
mod repair;
mod shell_rims;
mod source_body;
mod untangle;
mod weight_check;
