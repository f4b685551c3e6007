//! Every derivative against finite differences.

#[path = "../support/mod.rs"]
mod support;

mod fit;
mod harness;
