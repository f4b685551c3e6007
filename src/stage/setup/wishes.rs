//! What a caller asks of the fit alone. It may change once a result is there: the fit then goes on from that.

use std::sync::Arc;

use glam::DVec3;

use super::fit_region::fit_region;
use super::normalization::Normalization;
use super::pin_targets::{self, PinRequest};
use super::problem::Problem;
use super::shape::Shape;
use crate::energy::pin::Pins;
use crate::error::{Error, ErrorKind, Result};
use crate::geometry::closest_point::ClosestPoint;
use crate::options::Options;

/// The largest offset that is accepted, in the normalised space. A larger one is one in another unit.
const MAX_OFFSET: f64 = 1.0;

impl Problem {
    /// What a caller asks of the fit, in place of what was asked before: `options`, `offset` in the target's unit, fit weights and pins as
    /// in [`Inputs`]. Carried pieces keep their places.
    ///
    /// # Errors
    /// `InvalidArgument` for an offset beyond the skeleton's size.
    pub fn ask(
        &mut self,
        options: &Options,
        offset: f64,
        fit_weights_given: Option<&[f64]>,
        pins: &[PinRequest],
    ) -> Result<()> {
        self.offset = normalised_offset(offset, &self.target_normalization, options)?;
        let surface = self.source_body.as_ref().map(|body| &body.surface);
        self.fit_weights = match fit_weights_given {
            Some(weights) => weights.to_vec(),
            None => fit_weights(&self.rest, surface, options.fit_distance, &self.placed),
        };
        let normalised_target = |p: DVec3| self.target_normalization.normalise(p);
        let pins: Vec<PinRequest> = pins.iter().map(|&(v, p)| (v, p.map(normalised_target))).collect();
        let [source, target] = &self.skeletons;
        let pins = Pins::new(pin_targets::resolve(&self.rest, &self.triangles, &pins, source, target));
        if pins != self.shape.pins {
            self.shape = Arc::new(Shape { pins, ..Shape::clone(&self.shape) });
        }
        Ok(())
    }
}

/// `offset`, which is in the target's unit, in the normalised space.
pub(super) fn normalised_offset(offset: f64, target: &Normalization, options: &Options) -> Result<f64> {
    let offset = offset * target.scale;
    if offset > MAX_OFFSET {
        return Err(Error::new(
            ErrorKind::InvalidArgument,
            format!(
                "option offset is {}, which is more than half the size of the target skeleton; it is a length in the unit \
                 of the target's coordinate system",
                options.offset
            ),
        ));
    }
    Ok(offset)
}

/// How much each vertex fits where the caller does not say it: what was designed near to the body, but for what is `placed`.
pub(super) fn fit_weights(rest: &[DVec3], body: Option<&ClosestPoint>, distance: f64, placed: &[u32]) -> Vec<f64> {
    let mut weights = match body {
        Some(body) => fit_region(rest, body, distance),
        None => vec![1.0; rest.len()],
    };
    placed.iter().for_each(|&v| weights[v as usize] = 0.0);
    weights
}
