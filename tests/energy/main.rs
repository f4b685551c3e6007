//! Every derivative against finite differences.

#[path = "../support/mod.rs"]
mod support;

mod curve;
mod harness;
mod inflation;
mod patch;
mod position;
mod surface;
