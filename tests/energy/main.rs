//! Every derivative against finite differences.

mod attachment;
mod barrier;
mod carry;
mod curve;
mod distortion;
mod fit;
mod harness;
mod inflation;
mod patch;
mod pin;
mod position;
mod rigid;
mod surface;
