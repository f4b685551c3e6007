//! Where the garment does not let the avatar grow in its own pose, and the source stands in another one: the same in that.
//!
//! It comes last, after all other settings of the contact. The target is posed like the source, by its own weights, dressed
//! there, and taken back by the stage REPOSE, as where the poses differ much from the beginning.

use std::sync::Arc;
use std::time::Instant;

use super::inputs::{Design, Inputs, Setting};
use super::reposing::Reposing;
use super::run::{Run, Step};
use super::way::Way;
use crate::control::Cancel;
use crate::error::{ErrorKind, Result};
use crate::input::body::Body;
use crate::input::coordinate_system::AxisTurn;
use crate::input::diagnostic::Diagnostic;
use crate::sdf::{Field, FieldOptions};
use crate::solver::newton::{Model, Newton, State};
use crate::stage::attempts::Attempts;
use crate::stage::inflate::Inflation;
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

/// The attempt in the target's own pose that came farthest.
pub(super) struct OwnPose {
    /// Where it stalled.
    t: f64,
    /// By how many degrees the poses differ.
    difference: f64,
    problem: Arc<Problem>,
    body: Arc<Body>,
    /// None where memory is short.
    stalled: Option<(Objective, State)>,
}

impl OtherPose {
    /// Bytes that it holds beside the inputs.
    pub(super) fn memory(&self) -> u64 {
        size_of_val(&self.way.points[..]) as u64 + self.way.skin.memory() + self.design.memory()
    }

    /// The problem there.
    fn setting(&self, cancel: &Cancel) -> Result<Option<Setting>> {
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

impl Run {
    /// Where the inflation has stalled with all settings, begins once more with the target in the source's pose. False where
    /// that is not another one, was done already, or cannot be set up.
    pub(super) fn try_other_pose(&mut self) -> Result<bool> {
        let Some(other) = self.other_pose.take() else { return Ok(false) };
        let (clock, stop) = (Instant::now(), self.context.stop.clone());
        let Some(Setting { mut problem, body, .. }) = other.setting(&stop)? else { return Ok(false) };
        if problem.triangles != self.problem.triangles {
            // What closes its openings differs: there is no way from one to the other.
            return Ok(false);
        }
        if !problem.carried.is_empty() {
            let options = FieldOptions { voxel: self.options.voxel_size, threads: self.report.threads as u32 };
            problem.settle_carried(&Field::build(&problem.fitted, options, &stop)?);
        }
        stop.check()?;
        let iterations = self.iterations();
        let objective = problem.inflation_objective(&self.options, &stop, &mut Vec::new())?;
        stop.check()?;
        let state = State { x: problem.initial_state(false).0.to_vec(), t: 0.0 };
        let budget = self.remaining_budget().reserving(problem.memory() + objective.memory());
        self.newton = Newton::new(state.x.len(), &objective.terms(), budget, stop)?;
        self.held += problem.memory();
        let stalled = (std::mem::replace(&mut self.objective, objective), std::mem::replace(&mut self.state, state));
        let farthest = match self.farthest.take() {
            Some(farthest) if farthest.1.t > stalled.1.t => *farthest,
            _ => stalled,
        };
        let own = OwnPose {
            t: farthest.1.t,
            difference: other.way.posing.difference(),
            problem: std::mem::replace(&mut self.problem, Arc::new(problem)),
            body: std::mem::replace(&mut self.body, Arc::new(body)),
            stalled: (self.options.memory_limit == 0).then_some(farthest),
        };
        self.reposing = Some(Box::new(Reposing::new(own.problem.clone(), own.body.clone(), other.way)));
        self.own_pose = Some(Box::new(own));
        self.attempts = Attempts::default();
        self.initial_intersections = self.objective.contact.exempt_pairs().triangle_pairs().into();
        self.step = Step::Inflate(Inflation::another(iterations));
        self.report.repose.seconds += clock.elapsed().as_secs_f64();
        Ok(true)
    }

    /// Where the source's pose did not help either, goes back to where the target's own had stalled, to say what holds the
    /// garment there. None where that is not known.
    pub(super) fn return_to_own_pose(&mut self) -> Option<f64> {
        let own = self.own_pose.take()?;
        (self.objective, self.state) = own.stalled?;
        (self.problem, self.body) = (own.problem, own.body);
        self.farthest = None;
        Some(own.t)
    }
}

impl OwnPose {
    /// What is said of a result that was found in the source's pose.
    pub(super) fn diagnostic(&self) -> Diagnostic {
        Diagnostic::SolvedPosed { stalled_at: self.t, degrees: self.difference }
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
