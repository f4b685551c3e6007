//! The solver compared with dense algebra.

mod assembly;
mod cholesky;
mod newton;
