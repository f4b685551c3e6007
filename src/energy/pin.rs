//! Pins: vertices drawn to target positions by springs.
//!
//! ```text
//! L = sum |x_v - p_v(t)|^2,   p_v(t) = (1 - t) p_v(0) + t p_v(1)
//! ```
//!
//! p(0) is the rest position of the vertex, so that all pins begin without force and move as the avatar grows. A pin is a
//! spring and not a fixed vertex: a target that the avatar obstructs is not reached.

use std::ops::Range;

use glam::DVec3;

use super::{Configuration, Energy, Row, Sink};
use crate::memory::bytes;

/// A vertex and its target.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pin {
    /// The garment vertex.
    pub vertex: u32,
    /// Its target at t = 0.
    pub start: DVec3,
    /// Its target at t = 1.
    pub end: DVec3,
}

/// Pin term; an element is a pin.
#[derive(Clone, Debug, Default)]
pub struct Pins {
    pins: Vec<Pin>,
}

impl Pins {
    /// The term for these pins, at most one a vertex.
    pub fn new(pins: Vec<Pin>) -> Self {
        Self { pins }
    }

    /// The pins.
    pub fn pins(&self) -> &[Pin] {
        &self.pins
    }
}

impl Pin {
    #[inline]
    fn residual(&self, at: Configuration<'_>) -> DVec3 {
        at.x[self.vertex as usize] - self.start.lerp(self.end, at.t)
    }
}

impl Energy for Pins {
    fn name(&self) -> &'static str {
        "pins"
    }

    fn len(&self) -> usize {
        self.pins.len()
    }

    fn memory(&self) -> u64 {
        bytes(&self.pins)
    }

    fn value(&self, at: Configuration<'_>, range: Range<usize>) -> f64 {
        self.pins[range].iter().map(|pin| pin.residual(at).length_squared()).sum()
    }

    fn derivatives(&self, at: Configuration<'_>, range: Range<usize>, sink: &mut dyn Sink) {
        for pin in &self.pins[range] {
            let residual = pin.residual(at);
            let motion = pin.end - pin.start;
            let row = |axis: usize| Row {
                components: [DVec3::AXES[axis], DVec3::ZERO, DVec3::ZERO, DVec3::ZERO],
                t: -motion[axis],
                g: 2.0 * residual[axis],
                h: 2.0,
            };
            sink.low_rank(&[pin.vertex], &[row(0), row(1), row(2)]);
        }
    }

    fn stencils(&self, visit: &mut dyn FnMut(&[u32])) {
        self.pins.iter().for_each(|pin| visit(&[pin.vertex]));
    }
}
