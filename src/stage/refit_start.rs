//! What changes of the problem where a result is fitted again with other wishes.

use std::sync::Arc;

use glam::DVec3;

use super::setup::pin_targets::{self, PinRequest};
use super::setup::problem::Problem;
use super::setup::shape::Shape;
use super::setup::wishes::{fit_weights, normalised_offset};
use crate::energy::pin::Pins;
use crate::error::Result;
use crate::options::Options;

impl Problem {
    /// What a caller asks of the fit, in place of what was asked before: `options`, `offset` in the target's unit, fit weights
    /// and pins of welded vertices. Carried pieces keep their places.
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
