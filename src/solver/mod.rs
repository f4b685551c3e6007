//! Minimises a weighted sum of energies: sparsity pattern, assembly, factorisation, Newton direction, line search.
//!
//! Depends on energies only through the trait [`crate::energy::Energy`]. The inflation parameter t is a border of the
//! linear system (an arrowhead matrix), never part of the sparse factor: its row is dense.

pub mod assembly;
pub mod cholesky;
pub mod conjugate_gradients;
mod element_buffer;
pub mod line_search;
pub mod newton;
pub mod pattern;
pub mod profile;

use crate::energy::Energy;

/// An energy and its weight in the objective.
#[derive(Clone, Copy)]
pub struct Term<'a> {
    /// The energy.
    pub energy: &'a dyn Energy,
    /// Its weight.
    pub weight: f64,
}
