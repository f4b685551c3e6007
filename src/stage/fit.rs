//! Fit: the garment is drawn to the avatar at its full size (section 3.6, Eq. 7).
//!
//! The barrier begins as wide as the inflation left it, and softer: under a stiff one, a garment that is still far from its
//! balance has no room for a step. Then it becomes narrow and stiff along a path in a parameter s,
//!
//! ```text
//! dhat(s) = dhat(0)^(1-s) dhat(1)^s,    weight(s) = weight(0)^(1-s) weight(1)^s,
//! ```
//!
//! on which one factorisation gives the answer `dx = p0 + ds p1` of the garment to an advance of s. The pairs in contact
//! move with the barrier and stay in contact. (Narrowed at once, the barrier loses them, and finds each again by
//! running into it.) Advances are small, so that `p0`, which is Newton's step, keeps the garment near its balance: what is left at
//! the end is to be gained under a barrier in which each contact has to be found by running into it. Newton's method at s = 1
//! converges to the result.

use crate::energy::barrier::BarrierPathRates;
use crate::error::Result;
use crate::maths;
use crate::options::Options;
use crate::solver::assembly::weighted;
use crate::solver::newton::{Model as _, Newton, State};

use super::objective::Objective;

/// The iterations that must pass the test one after the other, where contact or the line search made them short. Of those that
/// take all of Newton's step one is enough: what it leaves is of second order.
const CONVERGED_STEPS: u32 = 2;
const WHOLE_STEP: f64 = 0.999;
/// Steps without any decrease, one after the other, after which the fit is stuck: after so many, the damping that contact
/// brings about has grown as far as it does.
const STUCK_STEPS: u32 = 6;
/// An objective below this counts as zero: the garment is as it was designed, and every fraction of the objective is rounding.
const NO_OBJECTIVE: f64 = 1e-9;
/// The weight of the barrier at s = 0 as a fraction of the inflation's.
const SOFTNESS: f64 = 0.1;
/// The path begins where the squared Newton decrement is below this fraction of the objective, or after so many steps.
const RELAXED: f64 = 0.02;
const MAX_RELAX_STEPS: u32 = 3;
/// The first continuation step in s, which is also the largest.
const LARGEST_ADVANCE: f64 = 0.08;
/// A result that is this far from the balance of other wishes, as a squared Newton decrement over the objective, goes the
/// whole path again: under the stiff barrier at its end there is no room for so long a way.
const FAR: f64 = 0.6;
/// Where an advance would be shorter than this, the rest of the path is skipped.
const SMALLEST_ADVANCE: f64 = 1e-3;

/// The state of the fit.
pub struct FitStage {
    phase: Phase,
    /// Iterations so far.
    pub iterations: u32,
    /// It goes on from a result, and has taken no step yet.
    resumed: bool,
}

enum Phase {
    /// Newton's method with the barrier at s = 0; so many steps were taken.
    Relax(u32),
    /// Continuation in s.
    Continue { s: f64, advance: f64 },
    /// Newton's method with the barrier at s = 1; so many steps have passed the test, and so many have decreased nothing.
    Converge { passed: u32, stuck: u32 },
}

/// How the fit ends by itself.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum End {
    /// What is still to be gained is below the tolerance.
    Converged,
    /// No step decreases the objective, although more is to be gained than the tolerance: contact holds the garment.
    Stuck,
}

impl Phase {
    /// As it begins.
    const CONVERGE: Self = Self::Converge { passed: 0, stuck: 0 };
}

/// The ends of the path: d-hat towards the avatar and weight of the barrier.
struct Path {
    dhat: [f64; 2],
    weight: [f64; 2],
}

impl Path {
    fn new(objective: &Objective, options: &Options) -> Self {
        let distances = objective.contact.distances();
        Self {
            dhat: [distances.inflation_dhat, distances.dhat],
            weight: [SOFTNESS * options.inflation_barrier_weight, options.barrier_weight],
        }
    }

    /// Sets the barrier of `objective` at `s`.
    fn set(&self, s: f64, objective: &mut Objective, state: &State) {
        let between = |[from, to]: [f64; 2]| if s == 1.0 { to } else { from * maths::powf(to / from, s) };
        objective.set_contact(between(self.dhat), between(self.weight));
        objective.contact.rebuild_candidates(state.configuration());
    }

    fn rates(&self) -> BarrierPathRates {
        let rate = |[from, to]: [f64; 2]| maths::ln(to / from);
        BarrierPathRates { dhat_avatar: rate(self.dhat), weight: rate(self.weight) }
    }
}

impl FitStage {
    /// Begins where the inflation ended.
    pub fn begin(objective: &mut Objective, state: &State, options: &Options) -> Self {
        Path::new(objective, options).set(0.0, objective, state);
        Self { phase: Phase::Relax(0), iterations: 0, resumed: false }
    }

    /// Goes on from a result, at the end of the path.
    pub fn resume(objective: &mut Objective, state: &State, options: &Options) -> Self {
        Path::new(objective, options).set(1.0, objective, state);
        Self { phase: Phase::CONVERGE, iterations: 0, resumed: true }
    }

    /// One Newton step, and how the fit has ended with it, if it has. The objective has converged where the squared Newton
    /// decrement, twice what the quadratic model still promises, is below the tolerance times the objective, or rounding.
    ///
    /// # Errors
    /// `Internal`, `MemoryLimit` and `Cancelled` from the solver.
    pub fn iterate(
        &mut self,
        objective: &mut Objective,
        newton: &mut Newton,
        state: &mut State,
        options: &Options,
    ) -> Result<Option<End>> {
        self.iterations += 1;
        match &mut self.phase {
            Phase::Relax(steps) => {
                *steps += 1;
                let step = newton.newton_step(objective, state, false)?;
                if *steps >= MAX_RELAX_STEPS || step.is_none_or(|s| s.decrement <= RELAXED * s.after.max(NO_OBJECTIVE))
                {
                    self.phase = Phase::Continue { s: 0.0, advance: LARGEST_ADVANCE };
                }
            }
            Phase::Continue { s, advance } => {
                let path = Path::new(objective, options);
                objective.contact.set_barrier_path(Some(path.rates()));
                let ds = advance.min(1.0 - *s);
                let taken = newton.continue_barrier(objective, state, ds);
                objective.contact.set_barrier_path(None);
                let taken = taken?;
                *s += taken * ds;
                if taken >= 0.99 {
                    *advance = (1.5 * *advance).min(LARGEST_ADVANCE);
                } else if taken < 0.5 {
                    *advance *= 0.5;
                }
                if 1.0 - *s < SMALLEST_ADVANCE || *advance < SMALLEST_ADVANCE {
                    *s = 1.0;
                }
                let at = *s;
                path.set(at, objective, state);
                newton.forget_values();
                if at == 1.0 {
                    self.phase = Phase::CONVERGE;
                }
            }
            Phase::Converge { passed, stuck } => {
                let Some(step) = newton.newton_step(objective, state, false)? else {
                    // At a minimum, rounding alone says that nothing decreases; the test says whether this is one.
                    let terms = objective.terms();
                    let value = weighted(&terms, newton.values(&terms, state.configuration()));
                    if !newton.is_damped() && newton.decrement() <= options.tolerance * value.max(NO_OBJECTIVE) {
                        return Ok(Some(End::Converged));
                    }
                    (*passed, *stuck) = (0, *stuck + 1);
                    return Ok((*stuck >= STUCK_STEPS).then_some(End::Stuck));
                };
                *stuck = 0;
                if std::mem::take(&mut self.resumed) && step.decrement > FAR * step.after.max(NO_OBJECTIVE) {
                    Path::new(objective, options).set(0.0, objective, state);
                    newton.forget_values();
                    self.phase = Phase::Relax(0);
                    return Ok(None);
                }
                let passes = !step.damped && step.decrement <= options.tolerance * step.after.max(NO_OBJECTIVE);
                *passed = if passes { *passed + 1 } else { 0 };
                let converged = *passed >= CONVERGED_STEPS || (passes && step.fraction >= WHOLE_STEP);
                return Ok(converged.then_some(End::Converged));
            }
        }
        Ok(None)
    }
}
