//! The way from the pose in which the garment was solved to the target's own, in pieces that are straight for every vertex of
//! the avatar: a fourth step, with the machine of the inflation.
//!
//! At the beginning of a piece the garment goes along with the body by its skin weights, together with the avatar, as far as
//! contact allows. Where that is not all of the piece, the continuation in t takes the avatar on while the garment gives
//! way, and in the end Newton steps at rest let it find its balance.

use glam::DVec3;

use super::inflate::Inflation;
use super::objective::Objective;
use crate::error::Result;
use crate::solver::newton::{Model, Newton, State};

/// Of the step that contact allows, so much is taken where it is cut short.
const KEPT: f64 = 0.8;
/// Newton steps at the end of a piece, at most.
const RELAXING: u32 = 2;
/// It is at rest where the squared Newton decrement is below this fraction of the objective.
const RELAXED: f64 = 0.02;

/// One piece of the way under way.
pub struct Repose {
    /// How the garment goes along with the body in the whole of the piece; taken at its beginning.
    along: Option<Vec<DVec3>>,
    inflation: Inflation,
    relaxed: u32,
}

impl Repose {
    /// A piece in which the garment's vertices go along by `along`.
    pub fn new(along: Vec<DVec3>) -> Self {
        Self { along: Some(along), inflation: Inflation::default(), relaxed: 0 }
    }

    /// One iteration. True where the avatar is at the end of the piece and the garment at rest.
    ///
    /// # Errors
    /// `InflationStalled` where the garment does not let the avatar pass, `Internal`, `MemoryLimit` and `Cancelled` from the
    /// solver.
    pub fn iterate(&mut self, objective: &mut Objective, newton: &mut Newton, state: &mut State) -> Result<bool> {
        if let Some(along) = self.along.take() {
            let feasible = objective.max_feasible_step(state.configuration(), &along, 1.0, 1.0)?.unwrap_or(0.0);
            let part = if feasible < 1.0 { KEPT * feasible } else { 1.0 };
            state.x.iter_mut().zip(&along).for_each(|(x, dx)| *x += part * *dx);
            state.t = part;
            objective.contact.rebuild_candidates(state.configuration());
            newton.forget_values();
            return Ok(false);
        }
        if state.t < 1.0 {
            self.inflation.iterate(objective, newton, state)?;
            return Ok(false);
        }
        objective.set_inflation(None);
        self.relaxed += 1;
        let step = newton.newton_step(objective, state, false)?;
        Ok(self.relaxed >= RELAXING || step.is_none_or(|s| s.decrement <= RELAXED * s.after.abs()))
    }
}
