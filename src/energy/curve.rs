//! Curve shape: curvature (Eq. 5 of the paper) and torsion (its section 3.4.5) of boundary curves and seams.
//!
//! With the unit directions a, b, c of three edges in a row, at the vertex v where b starts,
//!
//! ```text
//! alpha = -a . b
//! beta  = P(c, b) . P(-a, b)       = (c . b) (a . b) - a . c         P(v, w) = v - (w . v) w
//! gamma = P(c, b) x P(-a, b) . b   = -det(c, a, b)
//! L_curvature = sum w (alpha - alpha_rest)^2
//! L_torsion   = sum w ((beta - beta_rest)^2 + (gamma - gamma_rest)^2)
//! ```
//!
//! where w is the mean rest length of the two edges at v. Unit directions do not depend on scale: both terms
//! are exactly zero for every similarity of the rest curve.

use std::ops::Range;

use glam::DVec3;

use super::{Configuration, Direction, Energy, Sink};
use crate::geometry::mesh::BoundaryLoop;
use crate::memory::bytes;

/// A chain of garment edges.
#[derive(Clone, Copy, Debug)]
pub struct Polyline<'a> {
    /// Vertex indices along the chain, each once.
    pub vertices: &'a [u32],
    /// True where the last vertex is joined to the first.
    pub closed: bool,
}

impl<'a> From<&'a BoundaryLoop> for Polyline<'a> {
    fn from(boundary: &'a BoundaryLoop) -> Self {
        Self { vertices: &boundary.vertices, closed: true }
    }
}

impl<'a> Polyline<'a> {
    /// Calls `visit` with every `N` vertices in a row, `N >= 3`. A closed chain shorter than three vertices has
    /// none, and one of exactly three meets its first vertex again as the fourth.
    fn windows<const N: usize>(self, mut visit: impl FnMut([u32; N])) {
        let n = self.vertices.len();
        let starts = match self.closed {
            true if n >= 3 => n,
            true => 0,
            false => (n + 1).saturating_sub(N),
        };
        for i in 0..starts {
            visit(std::array::from_fn(|k| self.vertices[(i + k) % n]));
        }
    }
}

/// The unit direction of an edge, and one over its length; both zero where the edge has no length.
#[derive(Clone, Copy)]
struct Edge {
    unit: DVec3,
    inverse: f64,
}

impl Edge {
    #[inline]
    fn new(x: &[DVec3], from: u32, to: u32) -> Self {
        let edge = x[to as usize] - x[from as usize];
        let inverse = 1.0 / edge.length();
        if inverse.is_finite() {
            Self { unit: edge * inverse, inverse }
        } else {
            Self { unit: DVec3::ZERO, inverse: 0.0 }
        }
    }

    /// The derivative by the edge of a function whose derivative by the unit direction is `g`.
    #[inline]
    fn pull_back(&self, g: DVec3) -> DVec3 {
        (g - self.unit * self.unit.dot(g)) * self.inverse
    }
}

/// Mean rest length of the edges into and out of `middle`, or none where one has no length.
fn length_weight(rest: &[DVec3], from: u32, middle: u32, to: u32) -> Option<f64> {
    let length = |a: u32, b: u32| rest[a as usize].distance(rest[b as usize]);
    let (before, after) = (length(from, middle), length(middle, to));
    (Edge::new(rest, from, middle).inverse > 0.0 && Edge::new(rest, middle, to).inverse > 0.0)
        .then_some(0.5 * (before + after))
}

#[derive(Clone, Copy, Debug)]
struct Corner {
    vertices: [u32; 3],
    alpha: f64,
    weight: f64,
}

/// Curvature term; an element is a corner of a curve.
#[derive(Clone, Debug)]
pub struct Curvature {
    corners: Vec<Corner>,
}

impl Curvature {
    /// The term for `curves` (boundary loops or polylines) of a garment with vertices `rest`.
    ///
    /// A closed curve of fewer than three vertices is left out. A corner at an edge without rest length, or whose two
    /// neighbours are one vertex, gets no element.
    pub fn new<'a>(rest: &[DVec3], curves: impl IntoIterator<Item = impl Into<Polyline<'a>>>) -> Self {
        let mut corners = Vec::new();
        for curve in curves {
            curve.into().windows(|vertices: [u32; 3]| {
                let [u, v, w] = vertices;
                if u == w {
                    return;
                }
                if let Some(weight) = length_weight(rest, u, v, w) {
                    corners.push(Corner {
                        vertices,
                        alpha: alpha(&[Edge::new(rest, u, v), Edge::new(rest, v, w)]),
                        weight,
                    });
                }
            });
        }
        Self { corners }
    }
}

#[inline]
fn alpha([a, b]: &[Edge; 2]) -> f64 {
    -a.unit.dot(b.unit)
}

impl Corner {
    #[inline]
    fn edges(&self, x: &[DVec3]) -> [Edge; 2] {
        let [u, v, w] = self.vertices;
        [Edge::new(x, u, v), Edge::new(x, v, w)]
    }
}

impl Energy for Curvature {
    fn name(&self) -> &'static str {
        "curvature"
    }

    fn len(&self) -> usize {
        self.corners.len()
    }

    fn memory(&self) -> u64 {
        bytes(&self.corners)
    }

    fn value(&self, at: Configuration<'_>, range: Range<usize>) -> f64 {
        self.corners[range].iter().map(|k| k.weight * (alpha(&k.edges(at.x)) - k.alpha).powi(2)).sum()
    }

    fn derivatives(&self, at: Configuration<'_>, range: Range<usize>, sink: &mut dyn Sink) {
        for k in &self.corners[range] {
            let edges = k.edges(at.x);
            let residual = alpha(&edges) - k.alpha;
            let [a, b] = edges;
            let (by_a, by_b) = (a.pull_back(-b.unit), b.pull_back(-a.unit));
            let components = [-by_a, by_a - by_b, by_b];
            let direction = Direction { vertices: &k.vertices, components: &components, t: 0.0 };
            sink.rank_one(direction, 2.0 * k.weight * residual, 2.0 * k.weight);
        }
    }

    fn stencils(&self, visit: &mut dyn FnMut(&[u32])) {
        self.corners.iter().for_each(|k| visit(&k.vertices));
    }
}

#[derive(Clone, Copy, Debug)]
struct Twist {
    vertices: [u32; 4],
    /// How many of the vertices are distinct: 3 on a triangle, whose fourth is its first again.
    distinct: usize,
    beta: f64,
    gamma: f64,
    weight: f64,
}

/// Torsion term; an element is three edges in a row.
#[derive(Clone, Debug)]
pub struct Torsion {
    twists: Vec<Twist>,
}

impl Torsion {
    /// The term for `curves` (boundary loops or polylines) of a garment with vertices `rest`.
    ///
    /// The same curves and edges are left out as in [`Curvature::new`].
    pub fn new<'a>(rest: &[DVec3], curves: impl IntoIterator<Item = impl Into<Polyline<'a>>>) -> Self {
        let mut twists = Vec::new();
        for curve in curves {
            curve.into().windows(|vertices: [u32; 4]| {
                let [u, v, w, z] = vertices;
                if u == w || v == z || length_weight(rest, v, w, z).is_none() {
                    return;
                }
                if let Some(weight) = length_weight(rest, u, v, w) {
                    let edges = [Edge::new(rest, u, v), Edge::new(rest, v, w), Edge::new(rest, w, z)];
                    let distinct = if u == z { 3 } else { 4 };
                    twists.push(Twist { vertices, distinct, beta: beta(&edges), gamma: gamma(&edges), weight });
                }
            });
        }
        Self { twists }
    }
}

#[inline]
fn beta([a, b, c]: &[Edge; 3]) -> f64 {
    c.unit.dot(b.unit) * a.unit.dot(b.unit) - a.unit.dot(c.unit)
}

#[inline]
fn gamma([a, b, c]: &[Edge; 3]) -> f64 {
    -c.unit.cross(a.unit).dot(b.unit)
}

impl Twist {
    #[inline]
    fn edges(&self, x: &[DVec3]) -> [Edge; 3] {
        let [u, v, w, z] = self.vertices;
        [Edge::new(x, u, v), Edge::new(x, v, w), Edge::new(x, w, z)]
    }

    /// Hands one scalar residual to the sink, whose derivatives by the unit directions of `edges` are `by`.
    #[inline]
    fn emit(&self, edges: &[Edge; 3], by: [DVec3; 3], residual: f64, sink: &mut dyn Sink) {
        let [a, b, c] = [edges[0].pull_back(by[0]), edges[1].pull_back(by[1]), edges[2].pull_back(by[2])];
        let mut components = [-a, a - b, b - c, c];
        if self.distinct == 3 {
            components[0] += c;
        }
        let n = self.distinct;
        let direction = Direction { vertices: &self.vertices[..n], components: &components[..n], t: 0.0 };
        sink.rank_one(direction, 2.0 * self.weight * residual, 2.0 * self.weight);
    }
}

impl Energy for Torsion {
    fn name(&self) -> &'static str {
        "torsion"
    }

    fn len(&self) -> usize {
        self.twists.len()
    }

    fn memory(&self) -> u64 {
        bytes(&self.twists)
    }

    fn value(&self, at: Configuration<'_>, range: Range<usize>) -> f64 {
        let cost = |k: &Twist| {
            let edges = k.edges(at.x);
            k.weight * ((beta(&edges) - k.beta).powi(2) + (gamma(&edges) - k.gamma).powi(2))
        };
        self.twists[range].iter().map(cost).sum()
    }

    fn derivatives(&self, at: Configuration<'_>, range: Range<usize>, sink: &mut dyn Sink) {
        for k in &self.twists[range] {
            let edges = k.edges(at.x);
            let [a, b, c] = edges.map(|e| e.unit);
            let (ab, cb) = (a.dot(b), c.dot(b));
            k.emit(&edges, [b * cb - c, c * ab + a * cb, b * ab - a], beta(&edges) - k.beta, sink);
            k.emit(&edges, [c.cross(b), a.cross(c), b.cross(a)], gamma(&edges) - k.gamma, sink);
        }
    }

    fn stencils(&self, visit: &mut dyn FnMut(&[u32])) {
        self.twists.iter().for_each(|k| visit(&k.vertices[..k.distinct]));
    }
}
