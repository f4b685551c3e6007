//! The objective with which the fit begins (Eq. 7): the avatar at its full size, and the clearances to aim at.

use std::sync::Arc;

use glam::DVec3;
use rayon::prelude::*;

use super::objective::Objective;
use super::setup::problem::Problem;
use crate::contact::{Avatar, Surface};
use crate::control::Cancel;
use crate::energy::fit::{Clearance, Fit};
use crate::error::Result;
use crate::geometry::mesh::TriangleMesh;
use crate::options::Options;
use crate::sdf::Field;

impl Problem {
    /// The objective of the fit: the avatar stands still, as the caller gave it, with `field` as its distance. The integral
    /// of Eq. 4 is over the current surface; its measure is taken from the garment at the beginning of the fit, `x`, and
    /// then kept, for a measure that follows the garment would pay for shrinking it. Where the source body is known, each
    /// point aims at the clearance that it had there, in proportion to the limb around which it is.
    ///
    /// # Errors
    /// `InvalidArgument` for a clearance that is not finite, `Cancelled`.
    pub fn fit_objective(
        &self,
        field: Arc<Field>,
        x: &[DVec3],
        options: &Options,
        cancel: &Cancel,
    ) -> Result<Objective> {
        self.fit_objective_on(&self.avatar, field, x, options, cancel)
    }

    /// The same with another shape of the same avatar and its layers, whose distance is `field`.
    ///
    /// # Errors
    /// As [`Self::fit_objective`].
    pub fn fit_objective_on(
        &self,
        avatar: &TriangleMesh,
        field: Arc<Field>,
        x: &[DVec3],
        options: &Options,
        cancel: &Cancel,
    ) -> Result<Objective> {
        let areas = TriangleMesh { positions: x.to_vec(), triangles: self.triangles.clone() }.areas();
        let positions = &avatar.positions;
        let avatar = Avatar {
            surface: Surface::new(positions.len(), avatar.triangles.clone()),
            start: positions.clone(),
            motion: vec![DVec3::ZERO; positions.len()],
        };
        let mut fit = Fit::new(field, &self.triangles, &areas, &self.fit_weights);
        let wanted = |designed: f64| {
            let least = if designed + self.offset > 0.0 { designed + self.offset } else { f64::NEG_INFINITY };
            Clearance { most: designed + self.offset, least }
        };
        if let Some(body) = &self.source_body {
            let points = fit.sample_points(&self.rest);
            let distances = self.known.distances(body, points.clone(), cancel)?;
            let clearance =
                |(&p, &distance): (&DVec3, &f64)| wanted(options.designed_clearance * body.clearance(p, distance));
            let designed = points.par_iter().zip(&*distances).map(clearance);
            fit.set_clearances(&designed.collect::<Vec<_>>())?;
        } else if self.offset > 0.0 {
            fit.set_clearances(&vec![wanted(0.0); fit.sample_points(&self.rest).len()])?;
        }
        let bodies = self.bodies(avatar);
        let mut objective =
            Objective::new(self.shape.clone(), Some(fit), bodies, self.distances, options, cancel.clone());
        objective.contact.set_intersecting_at_rest(&self.designed_intersections);
        Ok(objective)
    }
}
