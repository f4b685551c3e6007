//! The solver against dense algebra.

#[path = "../support/mod.rs"]
mod support;

mod assembly;
mod cholesky;
mod newton;
