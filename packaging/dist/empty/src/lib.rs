//! Nothing: cargo builds the standard library for it.
