//! The solver against dense algebra.

mod assembly;
mod cholesky;
mod newton;
