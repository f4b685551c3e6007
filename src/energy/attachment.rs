//! Attachment of loose pieces: a button or a belt keeps its position relative to the piece that it lies on.
//!
//! A loose piece shares no vertex with the rest of the garment, so the surface term is zero for any similarity of it: it
//! could drift, turn and grow. Each vertex v of it is bound to the triangle (a, b, c) of its host that is closest at rest:
//!
//! ```text
//! L = sum w |v - a - c1 e1 - c2 e2 - c3 N(e1 x e2)|^2,   e1 = b - a,  e2 = c - a,  N(n) = n / sqrt(|n|),
//! w = area(v) / (length^2 + distance^2) at rest,
//! ```
//!
//! with the coefficients that reproduce v - a at rest, so that a similarity of both costs nothing. area(v) is a third of
//! the triangles at v, length^2 the mean square of the host triangle's edges, distance the one from v to that triangle (so
//! that a long lever is softer). The residual in these units is a strain, as it is in the surface term, and one weight
//! serves both terms. Like that term's, the value grows with s^2 where an imperfect fit grows by s.
//!
//! A piece that nothing holds may keep a size all the same: three of its vertices keep their distances l,
//!
//! ```text
//! L = sum w (|e|^2 - l^2)^2 / (2 l^2)^2,   w = area of the piece,
//! ```
//!
//! and the surface term does the rest.
//!
//! `stage/setup/loose_pieces.rs` and `hanging_pieces.rs` decide which pieces are loose, and which triangles hold them.

use std::ops::Range;

use glam::DVec3;

use super::triangle_frame::{BoundVertex, least_squares};
use super::{Configuration, Direction, Energy, Sink};
use crate::memory::bytes;

/// A vertex of a loose piece, and the host triangle that holds it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hold {
    /// The vertex.
    pub vertex: u32,
    /// The vertices of the host's triangle.
    pub triangle: [u32; 3],
    /// Distance from the vertex to the triangle at rest.
    pub distance: f64,
    /// The area around the vertex at rest.
    pub area: f64,
}

/// Two vertices of a piece that keep their distance at rest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SizeHold {
    /// The vertices.
    pub vertices: [u32; 2],
    /// The area of the piece at rest.
    pub area: f64,
}

/// One summand.
#[derive(Clone, Copy, Debug)]
enum Element {
    /// A bound vertex with its weight.
    Bound { bound: BoundVertex, weight: f64 },
    /// Two vertices, their squared distance at rest, and w.
    Distance { vertices: [u32; 2], square: f64, weight: f64 },
}

/// Attachment term; an element is a vertex of a loose piece, or two that keep their distance.
#[derive(Clone, Debug)]
pub struct Attachment {
    name: &'static str,
    elements: Vec<Element>,
}

impl Attachment {
    /// The term for a garment with vertices `rest`. A hold by a triangle without area, which has no frame, is skipped, and so
    /// is the distance of two vertices at one point.
    pub fn new(rest: &[DVec3], holds: &[Hold], sizes: &[SizeHold]) -> Self {
        let bound = holds.iter().filter_map(|hold| Element::bound(rest, hold));
        let elements = bound.chain(sizes.iter().filter_map(|size| Element::distance(rest, size))).collect();
        Self { name: "attachment", elements }
    }

    /// The same term for borders that are held to what they lie on, under a name of its own.
    pub fn of_borders(rest: &[DVec3], holds: &[Hold]) -> Self {
        Self { name: "borders", ..Self::new(rest, holds, &[]) }
    }
}

impl Element {
    fn distance(rest: &[DVec3], &SizeHold { vertices, area: weight }: &SizeHold) -> Option<Self> {
        let [v, w] = vertices.map(|v| rest[v as usize]);
        let square = v.distance_squared(w);
        (square > 0.0).then_some(Self::Distance { vertices, square, weight })
    }

    fn bound(rest: &[DVec3], hold: &Hold) -> Option<Self> {
        let &Hold { vertex: v, triangle: [a, b, c], distance, area } = hold;
        let [pa, pb, pc] = [a, b, c].map(|i| rest[i as usize]);
        let (e1, e2) = (pb - pa, pc - pa);
        let bound = BoundVertex::new(rest, [a, b, c, v])?;
        let square = (e1.length_squared() + e2.length_squared() + (e2 - e1).length_squared()) / 3.0;
        let weight = area / (square + distance * distance);
        weight.is_finite().then_some(Self::Bound { bound, weight })
    }
}

impl Energy for Attachment {
    fn name(&self) -> &'static str {
        self.name
    }

    fn len(&self) -> usize {
        self.elements.len()
    }

    fn memory(&self) -> u64 {
        bytes(&self.elements)
    }

    fn value(&self, at: Configuration<'_>, range: Range<usize>) -> f64 {
        let cost = |element: &Element| match element {
            Element::Bound { bound, weight } => weight * bound.at(at.x).residual().length_squared(),
            Element::Distance { vertices: [v, w], square, weight } => {
                let strain = (at.x[*v as usize].distance_squared(at.x[*w as usize]) - square) / (2.0 * square);
                weight * strain * strain
            }
        };
        self.elements[range].iter().map(cost).sum()
    }

    fn derivatives(&self, at: Configuration<'_>, range: Range<usize>, sink: &mut dyn Sink) {
        for element in &self.elements[range] {
            match element {
                Element::Bound { bound, weight } => {
                    let now = bound.at(at.x);
                    least_squares(sink, &bound.vertices, &now.jacobian(), now.residual(), *weight);
                }
                Element::Distance { vertices: [v, w], square, weight } => {
                    let edge = at.x[*v as usize] - at.x[*w as usize];
                    let strain = (edge.length_squared() - square) / (2.0 * square);
                    let slope = edge / *square;
                    let direction = Direction { vertices: &[*v, *w], components: &[slope, -slope], t: 0.0 };
                    sink.rank_one(direction, 2.0 * weight * strain, 2.0 * weight);
                }
            }
        }
    }

    fn stencils(&self, visit: &mut dyn FnMut(&[u32])) {
        self.elements.iter().for_each(|element| match element {
            Element::Bound { bound, .. } => visit(&bound.vertices),
            Element::Distance { vertices, .. } => visit(vertices),
        });
    }
}
