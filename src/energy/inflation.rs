//! Avatar inflation, section 3.5 of the paper: the augmented Lagrangian of the constraint t = 1.
//!
//! ```text
//! L_AL = lambda1 / 2 (1 - t)^2 + lambda2 (1 - t)
//! ```

use std::ops::Range;

use super::{Configuration, Direction, Energy, Sink};

/// Inflation term: one element, on t alone.
#[derive(Clone, Copy, Debug)]
pub struct Inflation {
    penalty: f64,
    multiplier: f64,
}

impl Inflation {
    /// The term with penalty `lambda1 >= 0` (a negative one counts as 0) and multiplier `lambda2`.
    pub fn new(penalty: f64, multiplier: f64) -> Self {
        Self { penalty: penalty.max(0.0), multiplier }
    }

    /// The penalty lambda1.
    pub fn penalty(&self) -> f64 {
        self.penalty
    }

    /// The multiplier lambda2.
    pub fn multiplier(&self) -> f64 {
        self.multiplier
    }

    /// Replaces the penalty lambda1; a negative one counts as 0.
    pub fn set_penalty(&mut self, penalty: f64) {
        self.penalty = penalty.max(0.0);
    }

    /// Replaces the multiplier lambda2.
    pub fn set_multiplier(&mut self, multiplier: f64) {
        self.multiplier = multiplier;
    }
}

impl Energy for Inflation {
    fn name(&self) -> &'static str {
        "inflation"
    }

    fn len(&self) -> usize {
        1
    }

    fn value(&self, at: Configuration<'_>, range: Range<usize>) -> f64 {
        let rest = 1.0 - at.t;
        range.len() as f64 * (0.5 * self.penalty * rest + self.multiplier) * rest
    }

    fn derivatives(&self, at: Configuration<'_>, range: Range<usize>, sink: &mut dyn Sink) {
        for _ in range {
            let slope = -self.penalty * (1.0 - at.t) - self.multiplier;
            sink.rank_one(Direction { vertices: &[], components: &[], t: 1.0 }, slope, self.penalty);
        }
    }

    fn stencils(&self, _visit: &mut dyn FnMut(&[u32])) {}
}
