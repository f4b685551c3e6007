//! Vertices drawn to target positions by springs: those that the caller pins, and those of carried pieces, such as a cape or a
//! badge, which go along with the part of the body that carries them.
//!
//! ```text
//! L = sum w_v |x_v - p_v(t)|^2,   p_v(t) = (1 - t) p_v(0) + t p_v(1)
//! ```
//!
//! p(0) is the rest position of the vertex, so that all begin without force and move as the avatar grows. A pin is a spring
//! and not a fixed vertex: a target that the avatar obstructs is not reached.
//!
//! w is 1 for a pin. For a carried vertex it is the area around it over the square of a length of the piece, so that the
//! residual is a strain as in the surface term; where all the targets come from one similarity of the piece, both terms are
//! zero there. `stage/setup/pin_targets.rs` and `carried_places.rs` say where the targets are.

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
    /// w, at least 0.
    pub weight: f64,
}

/// Pin term; an element is a pin.
#[derive(Clone, Debug, PartialEq)]
pub struct Pins {
    name: &'static str,
    pins: Vec<Pin>,
}

impl Pins {
    /// The term for these pins, at most one a vertex.
    pub fn new(pins: Vec<Pin>) -> Self {
        Self { name: "pins", pins }
    }

    /// The same term for the vertices of carried pieces, under a name of its own.
    pub fn carrying(pins: Vec<Pin>) -> Self {
        Self { name: "carry", pins }
    }

    /// The same for a garment that is held to where its skin weights put it, under a name of its own.
    pub fn holding(pins: Vec<Pin>) -> Self {
        Self { name: "hold", pins }
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
        self.name
    }

    fn len(&self) -> usize {
        self.pins.len()
    }

    fn memory(&self) -> u64 {
        bytes(&self.pins)
    }

    fn value(&self, at: Configuration<'_>, range: Range<usize>) -> f64 {
        self.pins[range].iter().map(|pin| pin.weight * pin.residual(at).length_squared()).sum()
    }

    fn derivatives(&self, at: Configuration<'_>, range: Range<usize>, sink: &mut dyn Sink) {
        for pin in &self.pins[range] {
            let (residual, motion, h) = (pin.residual(at), pin.end - pin.start, 2.0 * pin.weight);
            let row = |axis: usize| Row {
                components: [DVec3::AXES[axis], DVec3::ZERO, DVec3::ZERO, DVec3::ZERO],
                t: -motion[axis],
                g: h * residual[axis],
                h,
            };
            sink.low_rank(&[pin.vertex], &[row(0), row(1), row(2)]);
        }
    }

    fn stencils(&self, visit: &mut dyn FnMut(&[u32])) {
        self.pins.iter().for_each(|pin| visit(&[pin.vertex]));
    }
}
