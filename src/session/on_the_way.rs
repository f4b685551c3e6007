//! REPOSE in a run: the problem in the source's pose is left for that in the target's own, piece by piece.

use std::time::Instant;

use glam::DVec3;

use super::reposing::Reposing;
use super::run::{Run, Step};
use crate::contact::Configuration;
use crate::error::{Error, ErrorKind, Result};
use crate::geometry::mesh::TriangleMesh;
use crate::solver::newton::{Model, Newton};
use crate::stage::repose::Repose;
use crate::verify::intersections_with_cancel;

impl Run {
    /// Leaves the problem in the source's pose for that in the target's own, at the beginning of the way there.
    pub(super) fn begin_repose(&mut self, mut reposing: Box<Reposing>) -> Result<()> {
        let clock = Instant::now();
        let (from, to) = (self.problem.target_normalization, reposing.problem.target_normalization);
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
        self.report.inflate.collect(&mut self.newton, &mut self.objective, clock);
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
    /// `InflationStalled` where the garment does not let the body pass, `Internal` where a piece ends with an intersection.
    pub(super) fn iterate_repose(&mut self, mut reposing: Box<Reposing>) -> Result<bool> {
        reposing.iterations += 1;
        let Some(step) = &mut reposing.step else { return Ok(true) };
        let ended = step.iterate(&mut self.objective, &mut self.newton, &mut self.state);
        let ended = match ended {
            Err(error) if error.kind == ErrorKind::InflationStalled => Err(reposing.blocked(&self.state)),
            ended => ended,
        };
        match ended {
            Ok(true) => {}
            Ok(false) => {
                self.step = Step::Repose(reposing);
                return Ok(false);
            }
            Err(error) => {
                self.step = Step::Repose(reposing);
                return Err(error);
            }
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
