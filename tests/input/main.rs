//! What a caller hands in: checks, skeleton, weights, buffers, coordinate systems, diagnostics.

mod body;
mod buffer;
mod coordinate_system;
mod curve;
mod diagnostic;
mod evidence;
mod placement;
mod skeleton;
mod skin;
mod weld;
