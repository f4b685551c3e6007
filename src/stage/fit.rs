//! Step 3: the garment settles on the avatar at its full size (section 3.6, Eq. 7).

use crate::error::Result;
use crate::solver::newton::{Newton, State};

use super::objective::Objective;

/// The iterations that must pass the test one after the other.
const CALM: u32 = 2;

/// The state of the descent.
#[derive(Default)]
pub struct Settling {
    calm: u32,
    /// Iterations so far.
    pub iterations: u32,
}

impl Settling {
    /// One Newton step. True where the objective has converged: the squared Newton decrement, twice what the quadratic
    /// model still promises, is below `tolerance` times the objective; or no step decreases it any more.
    ///
    /// # Errors
    /// `Internal` from the solver.
    pub fn iterate(
        &mut self,
        objective: &mut Objective,
        newton: &mut Newton,
        state: &mut State,
        tolerance: f64,
    ) -> Result<bool> {
        self.iterations += 1;
        let Some(step) = newton.descend(objective, state)? else { return Ok(true) };
        self.calm = if step.decrement <= tolerance * step.after { self.calm + 1 } else { 0 };
        Ok(self.calm >= CALM)
    }
}
