//! Points in a row on a curve, from which its bends are read: on its own vertices, or at equal distances along it.
//!
//! The paper's curve terms are sums over edges. Where a curve is straight at rest they grow with the fourth power of the angle
//! between two edges, and a bend that is spread over n edges costs 1/n^3 of one that is not: on a fine mesh a side bends for
//! nothing. Points a fixed *chord* H apart along the rest curve see the same angles at any resolution. With s_i the starts of
//! the windows, at every vertex and as often between two as their distance asks for,
//!
//! ```text
//! sum_i (s_{i+1} - s_{i-1}) / 2  f(p(s_i), p(s_i + H), ...)   ->   integral f ds,   p(s) = (1 - u) x_k + u x_{k+1},
//! ```
//!
//! k and u fixed by the rest curve, so that a point is linear in the unknowns.

use glam::DVec3;

use crate::geometry::mesh::BoundaryLoop;

/// A curve is as long as this many chords at least; the chords of a shorter one are shorter.
const CHORDS_OF_A_CURVE: f64 = 8.0;
/// Windows start no farther apart than this share of a chord.
const SPACING: f64 = 0.5;
/// Windows that start on one edge, at most: of chords far shorter than the edges nearly all would see none of the bends.
const MOST_ON_AN_EDGE: f64 = 32.0;
/// A share of an edge, within which a point on it is at its end.
const AT_END: f64 = 1e-9;

/// Vertices of a window of N points, at most: two for each of four.
pub(super) const MOST_VERTICES: usize = 8;

/// A chain of garment edges.
#[derive(Clone, Copy, Debug)]
pub struct Polyline<'a> {
    /// Vertex indices along the chain, each once.
    pub vertices: &'a [u32],
    /// True where the last vertex is joined to the first.
    pub closed: bool,
    /// What its part of an energy is multiplied by.
    pub weight: f64,
}

impl<'a> From<&'a BoundaryLoop> for Polyline<'a> {
    fn from(boundary: &'a BoundaryLoop) -> Self {
        Self { vertices: &boundary.vertices, closed: true, weight: 1.0 }
    }
}

/// A point on an edge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct CurvePoint {
    ends: [u32; 2],
    /// 0 at the first end, 1 at the second.
    share: f64,
}

impl CurvePoint {
    fn at(vertex: u32) -> Self {
        Self { ends: [vertex; 2], share: 0.0 }
    }

    fn on(a: u32, b: u32, share: f64) -> Self {
        match share {
            _ if share < AT_END => Self::at(a),
            _ if share > 1.0 - AT_END => Self::at(b),
            _ => Self { ends: [a, b], share },
        }
    }
}

impl Polyline<'_> {
    /// Calls `visit` with every N points in a row and the length of curve that they stand for, times its weight: points a `chord` apart, or
    /// where that is 0 the vertices. N is at least 3.
    ///
    /// A closed curve of fewer than three vertices has none, and one of exactly three meets its first vertex again as the
    /// fourth. Left out are windows in which a point comes back after one other.
    pub(super) fn windows<const N: usize>(
        self,
        rest: &[DVec3],
        chord: f64,
        mut visit: impl FnMut([CurvePoint; N], f64),
    ) {
        if self.closed && self.vertices.len() < 3 {
            return;
        }
        let mut keep = |points: [CurvePoint; N], weight: f64| {
            if points.iter().zip(&points[2..]).all(|(a, b)| a != b) {
                visit(points, weight * self.weight);
            }
        };
        match Arc::new(self, rest) {
            Some(arc) if chord > 0.0 => arc.windows(chord, keep),
            _ => self.edge_windows(rest, &mut keep),
        }
    }

    fn edge_windows<const N: usize>(self, rest: &[DVec3], visit: &mut impl FnMut([CurvePoint; N], f64)) {
        let n = self.vertices.len();
        let starts = if self.closed { n } else { (n + 1).saturating_sub(N) };
        for i in 0..starts {
            let vertices: [u32; N] = std::array::from_fn(|k| self.vertices[(i + k) % n]);
            let length = |k: usize| rest[vertices[k] as usize].distance(rest[vertices[k + 1] as usize]);
            visit(vertices.map(CurvePoint::at), 0.5 * (length(0) + length(1)));
        }
    }
}

/// A curve by its length at rest.
struct Arc<'a> {
    curve: Polyline<'a>,
    /// The length up to each vertex, and up to the end, which is the first vertex again where the curve is closed.
    until: Vec<f64>,
}

impl<'a> Arc<'a> {
    /// None for a curve without length.
    fn new(curve: Polyline<'a>, rest: &[DVec3]) -> Option<Self> {
        let n = curve.vertices.len();
        let edges = if curve.closed { n } else { n.saturating_sub(1) };
        let mut until = vec![0.0];
        for k in 0..edges {
            let [a, b] = [k, k + 1].map(|k| rest[curve.vertices[k % n] as usize]);
            until.push(until[k] + a.distance(b));
        }
        let arc = Self { curve, until };
        (arc.length() > 0.0 && arc.length().is_finite()).then_some(arc)
    }

    fn length(&self) -> f64 {
        self.until[self.until.len() - 1]
    }

    /// The point at `s`, taken around a closed curve as often as it takes.
    fn point(&self, s: f64) -> CurvePoint {
        let s = if self.curve.closed { s.rem_euclid(self.length()) } else { s.clamp(0.0, self.length()) };
        let edges = self.until.len() - 1;
        // The last edge that begins at or before s: one with length.
        let k = self.until.partition_point(|&until| until <= s).clamp(1, edges) - 1;
        let length = self.until[k + 1] - self.until[k];
        let [a, b] = [k, k + 1].map(|k| self.curve.vertices[k % self.curve.vertices.len()]);
        CurvePoint::on(a, b, if length > 0.0 { (s - self.until[k]) / length } else { 0.0 })
    }

    /// Where windows start, in ascending order, up to `last`.
    fn starts(&self, spacing: f64, last: f64) -> Vec<f64> {
        let mut starts = Vec::with_capacity(self.until.len());
        for ends in self.until.windows(2) {
            let length = ends[1] - ends[0];
            let count = (length / spacing).ceil().min(MOST_ON_AN_EDGE);
            starts.extend((0..count as usize).map(|k| ends[0] + length * k as f64 / count));
        }
        if !self.curve.closed {
            starts.retain(|&s| s < last);
            starts.push(last);
        }
        starts
    }

    fn windows<const N: usize>(&self, chord: f64, mut visit: impl FnMut([CurvePoint; N], f64)) {
        let length = self.length();
        let chord = chord.min(length / CHORDS_OF_A_CURVE);
        let starts = self.starts(SPACING * chord, length - (N - 1) as f64 * chord);
        for (k, &s) in starts.iter().enumerate() {
            // At the ends of an open curve there is no other one.
            let before = match (k.checked_sub(1), self.curve.closed) {
                (Some(k), _) => s - starts[k],
                (None, true) => s + length - starts[starts.len() - 1],
                (None, false) => 0.0,
            };
            let after = match (starts.get(k + 1), self.curve.closed) {
                (Some(next), _) => next - s,
                (None, true) => starts[0] + length - s,
                (None, false) => 0.0,
            };
            visit(std::array::from_fn(|k| self.point(s + k as f64 * chord)), 0.5 * (before + after));
        }
    }
}

/// N points in a row and the vertices that they hang on, each once.
#[derive(Clone, Copy, Debug)]
pub(super) struct Window<const N: usize> {
    vertices: [u32; MOST_VERTICES],
    count: u8,
    /// Which of the vertices are the ends of each point's edge, and where the point is between them.
    ends: [[u8; 2]; N],
    shares: [f64; N],
}

impl<const N: usize> Window<N> {
    pub fn new(points: [CurvePoint; N]) -> Self {
        let (mut vertices, mut count) = ([0; MOST_VERTICES], 0);
        let ends = points.map(|point| {
            point.ends.map(|v| {
                let known = vertices[..count].iter().position(|&w| w == v);
                known.unwrap_or_else(|| {
                    vertices[count] = v;
                    count += 1;
                    count - 1
                }) as u8
            })
        });
        Self { vertices, count: count as u8, ends, shares: points.map(|point| point.share) }
    }

    /// Its vertices.
    #[inline]
    pub fn vertices(&self) -> &[u32] {
        &self.vertices[..self.count as usize]
    }

    /// Where its points are.
    #[inline]
    pub fn points(&self, x: &[DVec3]) -> [DVec3; N] {
        std::array::from_fn(|k| {
            let [a, b] = self.ends[k].map(|end| x[self.vertices[end as usize] as usize]);
            a + self.shares[k] * (b - a)
        })
    }

    /// The derivatives by its vertices of what has the derivatives `by` by its points.
    #[inline]
    pub fn by_vertices(&self, by: [DVec3; N]) -> [DVec3; MOST_VERTICES] {
        let mut components = [DVec3::ZERO; MOST_VERTICES];
        for (k, by) in by.into_iter().enumerate() {
            let [a, b] = self.ends[k].map(usize::from);
            components[a] += (1.0 - self.shares[k]) * by;
            components[b] += self.shares[k] * by;
        }
        components
    }
}
