//! The poses of a target beside the one in which it is being dressed: what they take, and what came of them.

use std::sync::Arc;

use super::inputs::{Design, Inputs, Setting};
use super::way::Way;
use crate::control::Cancel;
use crate::error::{ErrorKind, Result};
use crate::input::body::Body;
use crate::input::coordinate_system::AxisTurn;
use crate::input::diagnostic::Diagnostic;
use crate::solver::newton::State;
use crate::stage::objective::Objective;
use crate::stage::setup::problem::Problem;

/// All that it takes to set up the problem in the source's pose.
pub(super) struct OtherPose {
    pub(super) inputs: Inputs,
    pub(super) design: Design,
    pub(super) way: Way,
    /// The turn after which the target faces as the source does.
    pub(super) turn: AxisTurn,
}

/// The attempt in the pose that was tried first, where that came farthest.
pub(super) struct FirstPose {
    /// Where it stalled.
    pub(super) t: f64,
    /// By how many degrees the poses differ, where the target was posed after it; none where it was posed for it.
    pub(super) degrees: Option<f64>,
    pub(super) problem: Arc<Problem>,
    pub(super) body: Arc<Body>,
    /// None where memory is short.
    pub(super) stalled: Option<(Objective, State)>,
}

impl OtherPose {
    /// Bytes that it holds beside the inputs.
    pub(super) fn memory(&self) -> u64 {
        size_of_val(&self.way.points[..]) as u64 + self.way.skin.memory() + self.design.memory()
    }

    /// The problem there.
    pub(super) fn setting(&self, cancel: &Cancel) -> Result<Option<Setting>> {
        let Some(avatar) = &self.inputs.avatar else { return Ok(None) };
        let mut posed = self.inputs.stand_on(&self.way, 1.0, avatar);
        posed.turn = Some(self.turn);
        // What there is to say of the inputs was said of the target's own pose.
        match self.inputs.solve_in(&self.design, &posed, cancel, &mut Vec::new()) {
            Ok(setting) => Ok(Some(setting)),
            Err(error) if error.kind == ErrorKind::Cancelled => Err(error),
            Err(_) => Ok(None),
        }
    }
}

impl FirstPose {
    /// What is said of a result that was found in the source's pose; of the own one there is nothing to say.
    pub(super) fn diagnostic(&self) -> Option<Diagnostic> {
        Some(Diagnostic::SolvedPosed { stalled_at: self.t, degrees: self.degrees? })
    }

    /// Lets go of where it had stalled.
    pub(super) fn forget_stalled(&mut self) {
        self.stalled = None;
    }

    /// Bytes of what it keeps.
    pub(super) fn memory(&self) -> u64 {
        self.stalled.as_ref().map_or(0, |(objective, _)| objective.memory())
    }
}
