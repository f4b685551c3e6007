//! Where the garment does not let the avatar grow in the pose that was tried first, and there is another one: the same in that.
//!
//! It comes last, after all other settings of the contact. From its own pose the target goes into the source's, by its own weights:
//! it is dressed there, and taken back by the stage REPOSE, as where the poses differ much from the beginning. And where they do,
//! it goes from the source's pose into its own: a body whose arms lie in its flesh there has room for its sleeves here.

use std::sync::Arc;
use std::time::Instant;

use super::inputs::Setting;
use super::other_pose::FirstPose;
use super::reposing::Reposing;
use super::run::{Run, Step};
use crate::error::Result;
use crate::input::body::Body;
use crate::sdf::FieldOptions;
use crate::solver::newton::{Model, Newton, State};
use crate::stage::attempts::Attempts;
use crate::stage::inflate::Inflation;
use crate::stage::setup::problem::Problem;

impl Run {
    /// Where the inflation has stalled with all settings, begins once more in the other pose. False where there is none, it was done
    /// already, or cannot be set up.
    pub(super) fn try_other_pose(&mut self) -> Result<bool> {
        let clock = Instant::now();
        let is_other = self.try_pose_of_source()? || self.try_own_pose()?;
        self.report.repose.seconds += clock.elapsed().as_secs_f64();
        Ok(is_other)
    }

    fn try_pose_of_source(&mut self) -> Result<bool> {
        let Some(other) = self.other_pose.take() else { return Ok(false) };
        let stop = self.context.stop.clone();
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
        self.held += problem.memory();
        self.exchange(Arc::new(problem), Arc::new(body), Some(other.way.posing.difference()))?;
        if let Some(first) = &self.first_pose {
            let reposing = Reposing::new(first.problem.clone(), first.body.clone(), other.way);
            self.reposing = Some(Box::new(reposing));
        }
        Ok(true)
    }

    fn try_own_pose(&mut self) -> Result<bool> {
        let Some(reposing) = self.reposing.take_if(|_| self.first_pose.is_none()) else { return Ok(false) };
        self.exchange(reposing.problem.clone(), reposing.body.clone(), None)?;
        Ok(true)
    }

    /// Begins the inflation anew with this problem, and keeps the one that stalled; `degrees` are those by which the poses differ where
    /// the target is posed for it.
    fn exchange(&mut self, problem: Arc<Problem>, body: Arc<Body>, degrees: Option<f64>) -> Result<()> {
        let stop = self.context.stop.clone();
        let iterations = self.iterations();
        let objective = problem.inflation_objective(&self.options, &stop, &mut Vec::new())?;
        stop.check()?;
        let state = State { x: problem.initial_state(false).0.to_vec(), t: 0.0 };
        let budget = self.remaining_budget().reserving(objective.memory());
        self.newton = Newton::new(state.x.len(), &objective.terms(), budget, stop)?;
        let stalled = (std::mem::replace(&mut self.objective, objective), std::mem::replace(&mut self.state, state));
        let farthest = match self.farthest.take() {
            Some(farthest) if farthest.1.t > stalled.1.t => *farthest,
            _ => stalled,
        };
        self.first_pose = Some(Box::new(FirstPose {
            t: farthest.1.t,
            degrees,
            problem: std::mem::replace(&mut self.problem, problem),
            body: std::mem::replace(&mut self.body, body),
            stalled: (self.options.memory_limit == 0).then_some(farthest),
        }));
        self.attempts = Attempts::default();
        self.initial_intersections = self.objective.contact.exempt_pairs().triangle_pairs().into();
        self.step = Step::Inflate(Inflation::another(iterations, &[], false));
        Ok(())
    }

    /// Where the other pose did not help either, goes back to where the first had stalled, to say what holds the garment there:
    /// how far it came, and which pose did not help. None where that is not known.
    pub(super) fn return_to_first_pose(&mut self) -> Option<(f64, &'static str)> {
        let first = self.first_pose.take()?;
        (self.objective, self.state) = first.stalled?;
        (self.problem, self.body) = (first.problem, first.body);
        self.farthest = None;
        let other =
            if first.degrees.is_some() { "the avatar in the pose of the design" } else { "the avatar in its own pose" };
        Some((first.t, other))
    }
}
