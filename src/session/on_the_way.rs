//! REPOSE in a run: the problem in the source's pose is left for that in the target's own, piece by piece.

use std::time::Instant;

use glam::DVec3;

use super::reposing::{Posed, Reposing};
use super::run::{Run, Step};
use crate::contact::Configuration;
use crate::error::{Error, ErrorKind, Result};
use crate::geometry::mesh::TriangleMesh;
use crate::sdf::FieldOptions;
use crate::solver::newton::{Model, Newton, State};
use crate::stage::repose::Repose;
use crate::verify::intersections_with_cancel;

impl Run {
    /// Leaves the problem in the source's pose for that in the target's own, at the beginning of the way there.
    pub(super) fn begin_repose(&mut self, mut reposing: Box<Reposing>) -> Result<()> {
        let clock = Instant::now();
        let (from, to) = (self.problem.target_normalization, reposing.problem.target_normalization);
        reposing.posed =
            Some(Posed { problem: self.problem.clone(), body: self.body.clone(), x: self.state.x.clone() });
        self.state.x.iter_mut().for_each(|x| *x = to.normalise(from.restore(*x)));
        let system = &self.target_coordinate_system;
        let body = TriangleMesh {
            positions: reposing.normalised(&reposing.body_points(0), system),
            triangles: reposing.problem.avatar.triangles.clone(),
        };
        reposing.skin = Some(reposing.garment_skin(&self.state.x, &body));
        self.problem = reposing.problem.clone();
        self.body = reposing.body.clone();
        self.farthest = None;
        self.begin_piece(reposing)?;
        self.report.repose.collect(&mut self.newton, &mut self.objective, clock);
        Ok(())
    }

    /// Begins the piece that `reposing` is at.
    fn begin_piece(&mut self, mut reposing: Box<Reposing>) -> Result<()> {
        let mut objective = reposing.objective(&self.target_coordinate_system, &self.options, &self.context.stop);
        if let Some(settings) = self.attempts.settings() {
            objective.contact.set_inflation_dhat(settings.inflation_dhat);
            objective.set_contact(settings.inflation_dhat, settings.inflation_barrier_weight);
        }
        self.state.t = 0.0;
        let at = Configuration { x: &self.state.x, t: 0.0 };
        objective.contact.initialise(at, self.objective.contact.exempt_pairs().triangle_pairs());
        self.context.stop.check()?;
        self.objective = objective;
        let budget = self.remaining_budget().reserving(self.objective.memory());
        let terms = self.objective.terms();
        self.newton = Newton::new(self.state.x.len(), &terms, budget, self.context.stop.clone())?;
        reposing.step = Some(Repose::new(reposing.along(&self.state.x, &self.target_coordinate_system)));
        self.step = Step::Repose(reposing);
        Ok(())
    }

    /// One iteration of the way. True at its end.
    ///
    /// # Errors
    /// `Internal` where a piece ends with an intersection.
    pub(super) fn iterate_repose(&mut self, mut reposing: Box<Reposing>) -> Result<bool> {
        reposing.iterations += 1;
        let Some(step) = &mut reposing.step else { return Ok(true) };
        let ended = step.iterate(&mut self.objective, &mut self.newton, &mut self.state);
        match ended {
            Ok(true) => {}
            Ok(false) => {
                self.step = Step::Repose(reposing);
                return Ok(false);
            }
            Err(error) if error.kind == ErrorKind::InflationStalled => {
                self.stay_posed(*reposing)?;
                return Ok(true);
            }
            Err(error) => return Err(error),
        }
        self.verify_piece(&reposing)?;
        reposing.piece += 1;
        if reposing.piece < reposing.pieces {
            self.begin_piece(reposing)?;
            return Ok(false);
        }
        self.step = Step::Repose(reposing);
        Ok(true)
    }

    /// Where the garment does not let the body pass, goes back to the problem in the source's pose: the fit is done there.
    fn stay_posed(&mut self, mut reposing: Reposing) -> Result<()> {
        self.blocked = Some((reposing.blocked(&self.objective.contact, &self.state), reposing.motions()));
        let Some(Posed { problem, body, x }) = reposing.posed.take() else {
            return Err(Error::new(ErrorKind::Internal, "the source's pose is forgotten"));
        };
        (self.problem, self.body) = (problem, body);
        self.state = State { x, t: 1.0 };
        // Only what intersected there is exempt there; the fit inherits it.
        let stop = &self.context.stop;
        let mut objective = self.problem.another_inflation_at(&self.state, &self.options, stop);
        objective.contact.initialise(self.state.configuration(), &self.initial_intersections);
        self.objective = objective;
        let options = FieldOptions { voxel: self.options.voxel_size, threads: self.report.threads as u32 };
        let clock = Instant::now();
        let field = self.context.shared.field(&self.problem.fitted, options, stop)?;
        self.distance = Some((field, clock.elapsed().as_secs_f64()));
        Ok(())
    }

    /// The avatar's vertices in its caller's coordinates, while it is on the way.
    pub(super) fn avatar_on_the_way(&self) -> Option<Vec<DVec3>> {
        match &self.step {
            Step::Repose(reposing) => Some(reposing.avatar_points(self.state.t)),
            _ => None,
        }
    }

    /// The exact verifier, at the end of a piece.
    fn verify_piece(&self, reposing: &Reposing) -> Result<()> {
        let body = TriangleMesh {
            positions: reposing.normalised(&reposing.body_points(reposing.piece + 1), &self.target_coordinate_system),
            triangles: self.problem.avatar.triangles.clone(),
        };
        let garment = TriangleMesh { positions: self.state.x.clone(), triangles: self.problem.triangles.clone() };
        let found = intersections_with_cancel(&garment, Some(&body), 1, &self.context.stop)?;
        match found.pairs.first() {
            None => Ok(()),
            Some([own, other]) => Err(Error::new(
                ErrorKind::Internal,
                format!(
                    "on the way to the target's own pose garment triangle {own} intersects avatar triangle {other}"
                ),
            )),
        }
    }
}
