//! The solver compared with dense algebra.

mod assembly;
mod cholesky;
mod conjugate_gradients;
mod newton;
