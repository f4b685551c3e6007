//! Carried pieces: what is around no bone, such as a cape or a badge, goes along with the part of the body that carries it.
//!
//! ```text
//! L = sum w_v |x_v - p_v(t)|^2,   p_v(t) = (1 - t) p_v(0) + t p_v(1)
//! ```
//!
//! p(0) is the rest position, p(1) the place on the target body. w is the area around the vertex over the square of a length
//! of the piece, so that the residual is a strain as in the surface term. Where all the places come from one similarity of the
//! piece, both terms are zero there.
//!
//! `stage/setup/carried_pieces.rs` decides what is carried, `stage/setup/carried_places.rs` where to.

use std::ops::Range;

use glam::DVec3;

use super::{Configuration, Energy, Row, Sink};
use crate::memory::bytes;

/// A carried vertex.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Carried {
    /// The garment vertex.
    pub vertex: u32,
    /// Its place at t = 0.
    pub start: DVec3,
    /// Its place at t = 1.
    pub end: DVec3,
    /// w, at least 0.
    pub weight: f64,
}

/// Term of the carried pieces; an element is a vertex.
#[derive(Clone, Debug, Default)]
pub struct Carry {
    elements: Vec<Carried>,
}

impl Carry {
    /// The term for these vertices.
    pub fn new(elements: Vec<Carried>) -> Self {
        Self { elements }
    }
}

impl Carried {
    #[inline]
    fn residual(&self, at: Configuration<'_>) -> DVec3 {
        at.x[self.vertex as usize] - self.start.lerp(self.end, at.t)
    }
}

impl Energy for Carry {
    fn name(&self) -> &'static str {
        "carry"
    }

    fn len(&self) -> usize {
        self.elements.len()
    }

    fn memory(&self) -> u64 {
        bytes(&self.elements)
    }

    fn value(&self, at: Configuration<'_>, range: Range<usize>) -> f64 {
        self.elements[range].iter().map(|k| k.weight * k.residual(at).length_squared()).sum()
    }

    fn derivatives(&self, at: Configuration<'_>, range: Range<usize>, sink: &mut dyn Sink) {
        for k in &self.elements[range] {
            let (residual, motion, h) = (k.residual(at), k.end - k.start, 2.0 * k.weight);
            let row = |axis: usize| Row {
                components: [DVec3::AXES[axis], DVec3::ZERO, DVec3::ZERO, DVec3::ZERO],
                t: -motion[axis],
                g: h * residual[axis],
                h,
            };
            sink.low_rank(&[k.vertex], &[row(0), row(1), row(2)]);
        }
    }

    fn stencils(&self, visit: &mut dyn FnMut(&[u32])) {
        self.elements.iter().for_each(|k| visit(&[k.vertex]));
    }
}
