//! Inflation: the avatar grows from the skeleton to its own shape while the garment gives way (section 3.5).
//!
//! The paper drives t to 1 with an augmented Lagrangian. Here t is first the parameter of a path: one factorisation gives
//! the garment's answer `dx = p0 + dt p1` to a chosen advance dt, p0 being the Newton correction at fixed t. No penalty
//! is then weighed against the barrier, and none has to be chosen. Where contact cuts the continuation step short, Newton
//! steps at fixed t bring the garment back to its balance (corrector). Where that does not help either, the continuation has
//! stalled, and the augmented Lagrangian takes over: it lets t go back as well as forth.

use crate::energy::inflation::Inflation as Lagrangian;
use crate::error::{Error, ErrorKind, Result};
use crate::solver::newton::{Newton, State};

use super::objective::Objective;

/// The first continuation step in t, and the largest.
const FIRST_ADVANCE: f64 = 0.05;
const LARGEST_ADVANCE: f64 = 0.2;
/// Below this the continuation has stalled.
const SMALLEST_ADVANCE: f64 = 1e-6;
/// Where contact allows less than this fraction of an advance, the garment is brought back to balance.
const SHORT_ADVANCE: f64 = 0.1;
/// Newton steps at fixed t after such a short advance.
const CORRECTIONS: u32 = 3;
/// Short advances without a full one between them, after which the continuation counts as stalled.
const MAX_SHORT_ADVANCES: u32 = 12;
/// The step to t = 1 in one is tried from here on: from farther away it rarely succeeds and is expensive.
const FULL_INFLATION_FROM: f64 = 0.7;
/// Newton steps of the augmented Lagrangian before multiplier and penalty are updated, at most.
const INNER_STEPS: u32 = 12;
/// An inner solve ends where the squared Newton decrement is below this fraction of the objective.
const INNER_TOLERANCE: f64 = 0.01;
/// Penalty at which the augmented Lagrangian gives up: thirty doublings.
const MAX_PENALTY: f64 = 1e9;
/// It gives up earlier where t creeps: where each of so many penalties in turn brings less than this fraction of what is
/// missing. An attempt beside the first gives up sooner.
const CREEPING: f64 = 0.01;
const MOST_CREEPING: u32 = 6;
const MOST_CREEPING_AGAIN: u32 = 3;

/// The path has stalled, too, where t creeps: where so many iterations bring less than this share of what is missing, once the avatar
/// has grown so far, for a hat whose head comes out of it begins slowly.
const SLOW: usize = 32;
const LEAST_GAIN: f64 = 0.003;
const SLOW_FROM: f64 = 0.25;
/// So many short advances without a full one between them are enough where parts of the avatar touch each other that have the garment
/// between them: the first of them come from one pair of primitives, as anywhere. Where the caller will try without one of these
/// parts, fewer are.
const WEDGED: u32 = 4;
const WEDGED_BY_DISPENSABLE: u32 = 2;
/// An attempt has stalled at the place of an earlier one after so many iterations there, from so far before it to so far beyond it, in
/// shares of what is missing.
const LINGERING: usize = 6;
const BEFORE_PLACE: f64 = 0.02;
const BEYOND_PLACE: f64 = 0.005;

/// The state of the inflation.
pub struct Inflation {
    form: Form,
    /// Iterations so far.
    pub iterations: u32,
    /// Iterations of earlier attempts that are among them.
    before: u32,
    /// Penalties at which t may creep before the augmented Lagrangian gives up.
    most_creeping: u32,
    /// Where earlier attempts stalled.
    places: Vec<f64>,
    /// This one may linger there.
    may_linger: bool,
    /// t after each iteration of this attempt.
    reached: Vec<f64>,
}

enum Form {
    Path { advance: f64, corrections: u32, short_advances: u32 },
    Lagrangian { inner: u32, last_t: f64, creeping: u32 },
}

impl Default for Inflation {
    fn default() -> Self {
        let form = Form::Path { advance: FIRST_ADVANCE, corrections: 0, short_advances: 0 };
        let (places, reached) = (Vec::new(), Vec::new());
        Self { form, iterations: 0, before: 0, most_creeping: MOST_CREEPING, places, may_linger: false, reached }
    }
}

impl Inflation {
    /// Another attempt after so many iterations, of which earlier ones stalled at `places`, where it is over unless it may linger there.
    pub fn another(iterations: u32, places: &[f64], may_linger: bool) -> Self {
        let places = places.to_vec();
        let most_creeping = MOST_CREEPING_AGAIN;
        Self { iterations, before: iterations, most_creeping, places, may_linger, ..Self::default() }
    }

    /// Iterations of this attempt.
    pub fn attempted(&self) -> u32 {
        self.iterations - self.before
    }

    /// One iteration. True where t is 1.
    ///
    /// # Errors
    /// `InflationStalled` where t does not move any more, `Internal`, `MemoryLimit` and `Cancelled` from the solver.
    pub fn iterate(&mut self, objective: &mut Objective, newton: &mut Newton, state: &mut State) -> Result<bool> {
        self.iterations += 1;
        match &mut self.form {
            Form::Path { corrections, .. } if *corrections > 0 => {
                *corrections -= 1;
                if newton.newton_step(objective, state, false)?.is_none() {
                    *corrections = 0;
                }
            }
            Form::Path { .. } => self.continuation_step(objective, newton, state)?,
            Form::Lagrangian { .. } => self.augmented_lagrangian_step(objective, newton, state)?,
        }
        if state.t < 1.0 && !try_full_inflation(objective, state)? {
            self.reached.push(state.t);
            if !self.may_linger && self.has_stayed(LINGERING) {
                return Err(Error::new(ErrorKind::InflationStalled, stalled_message(state.t)));
            }
            return Ok(false);
        }
        newton.forget_values();
        Ok(true)
    }

    /// Whether t comes to a stand, so that the path is over where parts of the avatar touch each other that have the garment between
    /// them; and the same where the caller will try without one of them. True once after a short advance.
    pub fn is_wedged(&self) -> [bool; 2] {
        let Form::Path { short_advances, corrections: CORRECTIONS, .. } = self.form else { return [false; 2] };
        let has_begun = self.reached.last().is_some_and(|&t| t > SLOW_FROM);
        let may_end = !self.may_linger || self.has_stayed(1);
        [short_advances >= WEDGED && may_end, short_advances >= WEDGED_BY_DISPENSABLE].map(|is| is && has_begun)
    }

    /// Whether t stays where an earlier attempt stalled for so many iterations.
    fn has_stayed(&self, iterations: usize) -> bool {
        let last = self.reached.iter().rev().take(iterations);
        let is_at = |place: &f64| {
            let missing = 1.0 - place;
            last.clone().all(|t| t - place > -BEFORE_PLACE * missing && t - place < BEYOND_PLACE * missing)
        };
        self.reached.len() >= iterations && self.places.iter().any(is_at)
    }

    /// Whether t creeps along the path.
    fn creeps(&self) -> bool {
        let earlier = self.reached.len().checked_sub(SLOW).map(|k| self.reached[k]);
        let is_slow = |(before, now): (f64, &f64)| before > SLOW_FROM && now - before < LEAST_GAIN * (1.0 - before);
        earlier.zip(self.reached.last()).is_some_and(is_slow)
    }

    /// One step along the path in t.
    fn continuation_step(&mut self, objective: &mut Objective, newton: &mut Newton, state: &mut State) -> Result<()> {
        let creeps = self.creeps();
        let Form::Path { advance, corrections, short_advances } = &mut self.form else { return Ok(()) };
        let taken = newton.continue_t(objective, state, advance.min(1.0 - state.t))?;
        if taken >= 0.99 {
            *advance = (2.0 * *advance).min(LARGEST_ADVANCE);
            *short_advances = 0;
        } else if taken < 0.5 {
            *advance *= 0.5;
        }
        if taken < SHORT_ADVANCE {
            *short_advances += 1;
            *corrections = CORRECTIONS;
        }
        if *advance < SMALLEST_ADVANCE || *short_advances > MAX_SHORT_ADVANCES || creeps {
            // A multiplier as strong as the resistance that stopped the path.
            let multiplier = newton.t_gradient().max(0.0);
            objective.set_inflation(Some(Lagrangian::new(1.0_f64.max(multiplier), multiplier)));
            newton.forget_values();
            self.form = Form::Lagrangian { inner: 0, last_t: state.t, creeping: 0 };
        }
        Ok(())
    }

    /// One Newton step on garment and t together.
    fn augmented_lagrangian_step(
        &mut self,
        objective: &mut Objective,
        newton: &mut Newton,
        state: &mut State,
    ) -> Result<()> {
        let Form::Lagrangian { inner, last_t, creeping } = &mut self.form else { return Ok(()) };
        *inner += 1;
        let step = newton.newton_step(objective, state, true)?;
        let solved = step.is_none_or(|s| s.decrement <= INNER_TOLERANCE * s.after.abs());
        if !solved && *inner < INNER_STEPS {
            return Ok(());
        }
        *inner = 0;
        let Some(mut lagrangian) = objective.inflation().copied() else { return Ok(()) };
        let creeps = state.t - *last_t < CREEPING * (1.0 - state.t);
        *creeping = if creeps { *creeping + 1 } else { 0 };
        *last_t = state.t;
        if lagrangian.penalty() > MAX_PENALTY || *creeping >= self.most_creeping {
            return Err(Error::new(ErrorKind::InflationStalled, stalled_message(state.t)));
        }
        lagrangian.set_multiplier(lagrangian.multiplier() + lagrangian.penalty() * (1.0 - state.t));
        lagrangian.set_penalty(2.0 * lagrangian.penalty());
        objective.set_inflation(Some(lagrangian));
        newton.forget_values();
        Ok(())
    }
}

/// Sets t to 1 with the garment at rest, where nothing is in the way.
fn try_full_inflation(objective: &mut Objective, state: &mut State) -> Result<bool> {
    if state.t < FULL_INFLATION_FROM {
        return Ok(false);
    }
    let feasible = objective.max_feasible_inflation(state.configuration(), 1.0 - state.t)?;
    // Where the memory does not suffice it is not tried.
    let free = feasible.is_some_and(|fraction| fraction >= 1.0);
    if free {
        state.t = 1.0;
    } else {
        objective.contact.rebuild_candidates(state.configuration());
    }
    Ok(free)
}

/// Why there is no result, where t ends.
pub fn stalled_message(t: f64) -> String {
    format!(
        "the avatar cannot grow beyond {t:.4} of its size inside the garment: the garment cannot give way, neither with the \
         settings given nor with others that were tried; change avatar or garment where it is held"
    )
}
