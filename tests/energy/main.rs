//! Every derivative against finite differences.

#[path = "../support/mod.rs"]
mod support;

mod attachment;
mod barrier;
mod curve;
mod distortion;
mod fit;
mod harness;
mod inflation;
mod patch;
mod position;
mod surface;
