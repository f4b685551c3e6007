//! A session from inputs to a verified result.

mod assets;
mod attempts;
mod avatar_parts;
mod blocked;
mod cancel;
mod carried;
mod curves;
mod determinism;
mod distortion;
mod fit_controls;
mod flaws;
mod hanging;
mod initial_self_intersections;
mod joints;
mod layers;
mod memory;
mod plausibility;
mod profile;
mod rigs;
mod shell_rims;
mod shifted;
mod small;
mod thin_layers;
mod threads;
mod together;
mod turned;
