//! Step 2: the avatar grows from the skeleton to its own shape while the garment gives way (section 3.5).
//!
//! The paper drives t to 1 with an augmented Lagrangian. Here t is the parameter of a path: one factorisation gives the
//! garment's answer `dx = p0 + dt p1` to a chosen advance dt, p0 being the Newton correction at fixed t. The drive is
//! then never weighed against the barrier, and needs no weight. Where contact cuts the advance short again and again,
//! plain Newton steps at fixed t bring the garment back to its balance, and the path goes on from there.

use crate::error::{Error, ErrorKind, Result};
use crate::solver::newton::{Newton, State};

use super::objective::Objective;

/// The first advance of t, and the largest.
const FIRST_ADVANCE: f64 = 0.05;
const LARGEST_ADVANCE: f64 = 0.2;
/// An advance that would be shorter than this is no advance.
const SMALLEST_ADVANCE: f64 = 1e-7;
/// Below this fraction of an accepted step, the garment is brought back to balance.
const CRAMPED: f64 = 0.1;
/// Newton steps at fixed t after a cramped advance.
const CORRECTIONS: u32 = 3;
/// The jump to t = 1 is tried from here on: further away its swept volume is large and its hope small.
const SNAP_FROM: f64 = 0.7;

/// The state of the path.
pub struct Inflation {
    advance: f64,
    corrections: u32,
    stalled: u32,
    /// Iterations so far.
    pub iterations: u32,
}

impl Default for Inflation {
    fn default() -> Self {
        Self { advance: FIRST_ADVANCE, corrections: 0, stalled: 0, iterations: 0 }
    }
}

impl Inflation {
    /// One iteration. True where t is 1.
    ///
    /// # Errors
    /// `InflationStalled` where t does not move any more, `Internal` from the solver.
    pub fn iterate(&mut self, objective: &mut Objective, newton: &mut Newton, state: &mut State) -> Result<bool> {
        self.iterations += 1;
        if self.corrections > 0 {
            self.corrections -= 1;
            if newton.descend(objective, state)?.is_none() {
                self.corrections = 0;
            }
        } else {
            self.follow(objective, newton, state)?;
        }
        Ok(state.t >= 1.0 || snap(objective, state))
    }

    fn follow(&mut self, objective: &mut Objective, newton: &mut Newton, state: &mut State) -> Result<()> {
        let wanted = self.advance.min(1.0 - state.t);
        let taken = newton.advance(objective, state, wanted)?;
        if taken >= 0.99 {
            self.advance = (2.0 * self.advance).min(LARGEST_ADVANCE);
            self.stalled = 0;
        } else if taken < 0.5 {
            self.advance *= 0.5;
        }
        if taken < CRAMPED {
            self.stalled += 1;
            self.corrections = CORRECTIONS;
        }
        if self.advance < SMALLEST_ADVANCE || self.stalled > 60 {
            return Err(Error::new(
                ErrorKind::InflationStalled,
                format!(
                    "the avatar cannot grow beyond {:.4} of its size inside the garment: the garment is wedged between \
                     parts of the avatar. Try a larger --dhat or another barrier weight, or separate the parts",
                    state.t
                ),
            ));
        }
        Ok(())
    }
}

/// Jumps to t = 1 with the garment at rest, where nothing is in the way.
fn snap(objective: &mut Objective, state: &mut State) -> bool {
    if state.t < SNAP_FROM {
        return false;
    }
    let free = objective.admit_inflation(state.configuration(), 1.0 - state.t) >= 1.0;
    if free {
        state.t = 1.0;
    } else {
        objective.settle(state.configuration());
    }
    free
}
