//! Where the garment does not let the avatar grow in its own pose, and the source stands in another one: the same in that.
//!
//! It comes last, after all other settings of the contact. The target is posed like the source, by its own weights, dressed
//! there, and taken back by the stage REPOSE, as where the poses differ much from the beginning.

use std::sync::Arc;
use std::time::Instant;

use super::inputs::Setting;
use super::other_pose::OwnPose;
use super::reposing::Reposing;
use super::run::{Run, Step};
use crate::error::Result;
use crate::sdf::FieldOptions;
use crate::solver::newton::{Model, Newton, State};
use crate::stage::attempts::Attempts;
use crate::stage::inflate::Inflation;

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
            problem.settle_carried(&*self.context.shared.field(&problem.fitted, options, &stop)?);
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
