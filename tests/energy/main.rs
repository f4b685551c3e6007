//! Every derivative against finite differences.

mod barrier;
mod harness;
#[path = "../support/mod.rs"]
mod support;
