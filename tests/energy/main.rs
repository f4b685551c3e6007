//! Every derivative against finite differences.

mod harness;
