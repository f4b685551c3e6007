//! Curve shape: curvature (Eq. 5 of the paper) and torsion (its section 3.4.5) of boundary curves and seams.
//!
//! With the unit directions a, b, c from each to the next of points in a row on the curve (`curve_window.rs`),
//!
//! ```text
//! alpha = -a . b
//! beta  = P(c, b) . P(-a, b)       = (c . b) (a . b) - a . c         P(v, w) = v - (w . v) w
//! gamma = P(c, b) x P(-a, b) . b   = -det(c, a, b)
//! L_curvature = sum w (alpha - alpha_rest)^2
//! L_torsion   = sum w ((beta - beta_rest)^2 + (gamma - gamma_rest)^2)
//! ```
//!
//! where w is the length of the curve at rest that such points stand for: as printed, where they are the vertices, the mean of
//! the two edges at the second. Unit directions do not depend on scale: both terms are exactly zero for every similarity of
//! the rest curve.

use std::ops::Range;

use glam::DVec3;

pub use super::curve_window::Polyline;
use super::curve_window::Window;
use super::{Configuration, Direction, Energy, Sink};
use crate::memory::bytes;

/// Distances between points in a row differ by no more than this factor where the curve goes on.
const MOST_UNEVEN: f64 = 1e3;

/// The unit direction from a point to the next, and one over their distance; both zero where they coincide.
#[derive(Clone, Copy)]
struct Edge {
    unit: DVec3,
    inverse: f64,
}

impl Edge {
    #[inline]
    fn new(from: DVec3, to: DVec3) -> Self {
        let edge = to - from;
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

/// The directions between points in a row: one fewer than points.
#[inline]
fn edges<const N: usize, const M: usize>(window: &Window<N>, x: &[DVec3]) -> [Edge; M] {
    let points = window.points(x);
    std::array::from_fn(|k| Edge::new(points[k], points[k + 1]))
}

/// An element for each window on `curves`, made of it, its edges at rest and its weight; none where two points in a row
/// coincide at rest.
fn elements<'a, T, const N: usize, const M: usize>(
    rest: &[DVec3],
    curves: impl IntoIterator<Item = impl Into<Polyline<'a>>>,
    chord: f64,
    element: impl Fn(Window<N>, [Edge; M], f64) -> T,
) -> Vec<T> {
    let mut elements = Vec::new();
    for curve in curves {
        curve.into().windows(rest, chord, |points, weight| {
            let window = Window::new(points);
            let edges = edges(&window, rest);
            if edges.iter().all(|edge: &Edge| edge.inverse > 0.0) && (chord == 0.0 || !turns_back(&edges)) {
                elements.push(element(window, edges, weight));
            }
        });
    }
    elements
}

/// Whether points that are equally far apart along the curve nearly coincide: it turns back on itself there, and the
/// directions mean nothing.
fn turns_back(edges: &[Edge]) -> bool {
    let inverses = || edges.iter().map(|edge| edge.inverse);
    inverses().fold(0.0, f64::max) > MOST_UNEVEN * inverses().fold(f64::INFINITY, f64::min)
}

/// Hands the square of a residual, times a weight, to the sink; `by` are the residual's derivatives by the points.
#[inline]
fn emit<const N: usize>(sink: &mut dyn Sink, window: &Window<N>, by: [DVec3; N], weight: f64, residual: f64) {
    let (vertices, components) = (window.vertices(), window.by_vertices(by));
    let direction = Direction { vertices, components: &components[..vertices.len()], t: 0.0 };
    sink.rank_one(direction, 2.0 * weight * residual, 2.0 * weight);
}

#[derive(Clone, Copy, Debug)]
struct Corner {
    window: Window<3>,
    alpha: f64,
    weight: f64,
}

/// Curvature term; an element is three points in a row.
#[derive(Clone, Debug)]
pub struct Curvature {
    corners: Vec<Corner>,
}

impl Curvature {
    /// The term for `curves` (boundary loops or polylines) of a garment with vertices `rest`, on points `chord` apart, or as
    /// printed on its vertices where that is 0.
    ///
    /// A closed curve of fewer than three vertices is left out. Points of which two coincide at rest, or whose first is the
    /// third again, get no element.
    pub fn new<'a>(rest: &[DVec3], curves: impl IntoIterator<Item = impl Into<Polyline<'a>>>, chord: f64) -> Self {
        let corner = |window, edges, weight| Corner { window, alpha: alpha(&edges), weight };
        Self { corners: elements(rest, curves, chord, corner) }
    }
}

#[inline]
fn alpha([a, b]: &[Edge; 2]) -> f64 {
    -a.unit.dot(b.unit)
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
        self.corners[range].iter().map(|k| k.weight * (alpha(&edges(&k.window, at.x)) - k.alpha).powi(2)).sum()
    }

    fn derivatives(&self, at: Configuration<'_>, range: Range<usize>, sink: &mut dyn Sink) {
        for k in &self.corners[range] {
            let edges: [Edge; 2] = edges(&k.window, at.x);
            let residual = alpha(&edges) - k.alpha;
            let [a, b] = edges;
            let (by_a, by_b) = (a.pull_back(-b.unit), b.pull_back(-a.unit));
            emit(sink, &k.window, [-by_a, by_a - by_b, by_b], k.weight, residual);
        }
    }

    fn stencils(&self, visit: &mut dyn FnMut(&[u32])) {
        self.corners.iter().for_each(|k| visit(k.window.vertices()));
    }
}

#[derive(Clone, Copy, Debug)]
struct Twist {
    window: Window<4>,
    beta: f64,
    gamma: f64,
    weight: f64,
}

/// Torsion term; an element is four points in a row.
#[derive(Clone, Debug)]
pub struct Torsion {
    twists: Vec<Twist>,
}

impl Torsion {
    /// The term for `curves` (boundary loops or polylines) of a garment with vertices `rest`.
    ///
    /// Points as in [`Curvature::new`]; the same are left out.
    pub fn new<'a>(rest: &[DVec3], curves: impl IntoIterator<Item = impl Into<Polyline<'a>>>, chord: f64) -> Self {
        let twist = |window, edges, weight| Twist { window, beta: beta(&edges), gamma: gamma(&edges), weight };
        Self { twists: elements(rest, curves, chord, twist) }
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
    /// Hands one scalar residual to the sink, whose derivatives by the unit directions of `edges` are `by`.
    #[inline]
    fn emit(&self, edges: &[Edge; 3], by: [DVec3; 3], residual: f64, sink: &mut dyn Sink) {
        let [a, b, c] = [edges[0].pull_back(by[0]), edges[1].pull_back(by[1]), edges[2].pull_back(by[2])];
        emit(sink, &self.window, [-a, a - b, b - c, c], self.weight, residual);
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
            let edges = edges(&k.window, at.x);
            k.weight * ((beta(&edges) - k.beta).powi(2) + (gamma(&edges) - k.gamma).powi(2))
        };
        self.twists[range].iter().map(cost).sum()
    }

    fn derivatives(&self, at: Configuration<'_>, range: Range<usize>, sink: &mut dyn Sink) {
        for k in &self.twists[range] {
            let edges: [Edge; 3] = edges(&k.window, at.x);
            let [a, b, c] = edges.map(|e| e.unit);
            let (ab, cb) = (a.dot(b), c.dot(b));
            k.emit(&edges, [b * cb - c, c * ab + a * cb, b * ab - a], beta(&edges) - k.beta, sink);
            k.emit(&edges, [c.cross(b), a.cross(c), b.cross(a)], gamma(&edges) - k.gamma, sink);
        }
    }

    fn stencils(&self, visit: &mut dyn FnMut(&[u32])) {
        self.twists.iter().for_each(|k| visit(k.window.vertices()));
    }
}
