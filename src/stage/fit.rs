//! Step 3: the garment settles on the avatar at its full size (section 3.6, Eq. 7).
//!
//! The barrier begins as Step 2 left it, wide and soft, and becomes narrow and stiff while the garment settles: a stiff
//! barrier under a garment that is still far from its balance leaves no room for a step.

use crate::error::Result;
use crate::options::Options;
use crate::solver::newton::{Newton, State};

use super::objective::Objective;

/// The iterations that must pass the test one after the other.
const CALM: u32 = 2;
/// Stages of the barrier between Step 2's and its own.
const LEVELS: u32 = 4;
/// A step that takes at least this fraction of its direction, or promises less than [`SMALL_PROMISE`] of the objective,
/// makes the barrier stiffer.
const FREE: f64 = 0.3;
const SMALL_PROMISE: f64 = 0.05;
/// An objective below this is none: the garment is as it was designed, and every fraction of the objective is rounding.
const NOTHING: f64 = 1e-9;
/// Iterations after which the barrier becomes stiffer in any case.
const PATIENCE: u32 = 6;

/// The state of the descent.
#[derive(Default)]
pub struct Settling {
    calm: u32,
    level: u32,
    at_level: u32,
    /// Iterations so far.
    pub iterations: u32,
}

impl Settling {
    /// Begins with the barrier that Step 2 ended with.
    pub fn begin(objective: &mut Objective, state: &State, options: &Options) -> Self {
        let settling = Self::default();
        settling.set_barrier(objective, state, options);
        settling
    }

    fn set_barrier(&self, objective: &mut Objective, state: &State, options: &Options) {
        let share = f64::from(self.level) / f64::from(LEVELS);
        let between = |from: f64, to: f64| if self.level == LEVELS { to } else { from * (to / from).powf(share) };
        let gaps = objective.gaps();
        objective.set_contact(
            between(gaps.inflation_dhat, gaps.dhat),
            between(options.inflation_barrier_weight, options.barrier_weight),
        );
        objective.settle(state.configuration());
    }

    /// One Newton step. True where the objective has converged: the squared Newton decrement, twice what the quadratic
    /// model still promises, is below the tolerance times the objective (or [`NOTHING`]); or no step decreases it any more.
    ///
    /// # Errors
    /// `Internal` from the solver.
    pub fn iterate(
        &mut self,
        objective: &mut Objective,
        newton: &mut Newton,
        state: &mut State,
        options: &Options,
    ) -> Result<bool> {
        self.iterations += 1;
        self.at_level += 1;
        let step = newton.descend(objective, state, false)?;
        if self.level < LEVELS {
            let ripe = step.is_none_or(|s| s.fraction >= FREE || s.decrement <= SMALL_PROMISE * s.after);
            if ripe || self.at_level >= PATIENCE {
                self.level += 1;
                self.at_level = 0;
                self.set_barrier(objective, state, options);
                newton.forget_values();
            }
            return Ok(false);
        }
        let Some(step) = step else { return Ok(true) };
        self.calm = if step.decrement <= options.tolerance * step.after.max(NOTHING) { self.calm + 1 } else { 0 };
        Ok(self.calm >= CALM)
    }
}
