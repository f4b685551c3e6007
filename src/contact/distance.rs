//! Distance between a point and a triangle and between two edges:
//! the separation vector `r = sum_i w_i x_i` between the closest points.
//!
//! The weights are optimal, so by the envelope theorem the gradient of the squared distance with respect to
//! vertex i is `2 w_i r`, in every region and across their boundaries.

use glam::DVec3;

use crate::geometry::closest_point::segment_parameter;

/// The two types of pairs of primitives that can touch.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PairType {
    /// Vertex 0 against the triangle of vertices 1, 2, 3.
    PointTriangle,
    /// The edge of vertices 0, 1 against the edge of vertices 2, 3.
    EdgeEdge,
}

impl PairType {
    /// The closest points of the pair at `x`.
    #[inline]
    pub fn separation(self, x: &[DVec3; 4]) -> Separation {
        match self {
            PairType::PointTriangle => point_triangle(x),
            PairType::EdgeEdge => edge_edge(x),
        }
    }

    /// Number of vertices of the first primitive.
    #[inline]
    pub fn first_count(self) -> usize {
        match self {
            PairType::PointTriangle => 1,
            PairType::EdgeEdge => 2,
        }
    }

    /// True if the bounding boxes of the two primitives at `x` are more than `gap` apart along an axis: the
    /// distance is then above `gap`. Much cheaper than the distance.
    #[inline]
    pub fn is_beyond(self, x: &[DVec3; 4], gap: f64) -> bool {
        let (low, high) = match self {
            PairType::PointTriangle => {
                let (min, max) = (x[1].min(x[2]).min(x[3]), x[1].max(x[2]).max(x[3]));
                (min - x[0], x[0] - max)
            }
            PairType::EdgeEdge => (x[2].min(x[3]) - x[0].max(x[1]), x[0].min(x[1]) - x[2].max(x[3])),
        };
        low.max(high).max_element() > gap
    }
}

/// Closest points of two primitives.
#[derive(Clone, Copy, Debug)]
pub struct Separation {
    /// The weights w: `[1, -b0, -b1, -b2]` with barycentric coordinates b of the closest point of the triangle, or
    /// `[1 - s, s, -(1 - u), -u]` with the parameters s and u of the closest points of the edges.
    pub weights: [f64; 4],
    /// `r`, from the closest point of the second primitive to that of the first.
    pub vector: DVec3,
    /// `|r|^2`.
    pub squared: f64,
}

/// Below this squared sine between two directions their cross product is too inaccurate to decide which feature is
/// closest, and the boundary is examined as well.
const NEARLY_PARALLEL: f64 = 1e-10;

/// The parameter in [0, 1] of the point closest to `q` on the segment from the origin to `u`, and the vector from
/// there to `q`.
#[inline]
fn point_segment(q: DVec3, u: DVec3) -> (f64, DVec3) {
    let s = segment_parameter(q, u);
    (s, q - s * u)
}

/// Distance of vertex 0 from the triangle of vertices 1, 2, 3, which may be degenerate.
#[inline]
pub fn point_triangle(x: &[DVec3; 4]) -> Separation {
    let (ap, ab, ac) = (x[0] - x[1], x[2] - x[1], x[3] - x[1]);
    let n = ab.cross(ac);
    let area = n.length_squared();
    let b1 = ap.cross(ac).dot(n);
    let b2 = ab.cross(ap).dot(n);

    let mut best = Separation { weights: [0.0; 4], vector: DVec3::ZERO, squared: f64::INFINITY };
    if area > 0.0 && b1 >= 0.0 && b2 >= 0.0 && b1 + b2 <= area {
        let (b1, b2) = (b1 / area, b2 / area);
        let r = ap - b1 * ab - b2 * ac;
        best = Separation { weights: [1.0, b1 + b2 - 1.0, -b1, -b2], vector: r, squared: r.length_squared() };
        if area > NEARLY_PARALLEL * ab.length_squared() * ac.length_squared() {
            return best;
        }
    }
    let mut offer = |r: DVec3, w: [f64; 3]| {
        let squared = r.length_squared();
        if squared < best.squared {
            best = Separation { weights: [1.0, w[0], w[1], w[2]], vector: r, squared };
        }
    };
    let (s, r) = point_segment(ap, ab);
    offer(r, [s - 1.0, -s, 0.0]);
    let (s, r) = point_segment(ap, ac);
    offer(r, [s - 1.0, 0.0, -s]);
    let (s, r) = point_segment(x[0] - x[2], x[3] - x[2]);
    offer(r, [0.0, s - 1.0, -s]);
    best
}

/// Distance between the edge of vertices 0, 1 and the edge of vertices 2, 3, either of which may be a point.
#[inline]
pub fn edge_edge(x: &[DVec3; 4]) -> Separation {
    let (u, v, w) = (x[1] - x[0], x[3] - x[2], x[0] - x[2]);
    let n = u.cross(v);
    let area = n.length_squared();

    let mut best = Separation { weights: [0.0; 4], vector: DVec3::ZERO, squared: f64::INFINITY };
    let s = v.cross(w).dot(n) / area;
    if area > 0.0 && (0.0..=1.0).contains(&s) {
        // The projection onto the other edge, rather than a second determinant, keeps r exact to first order
        // where the edges are nearly parallel and s is uncertain.
        let q = w + s * u;
        let length = v.length_squared();
        let t = q.dot(v) / length;
        if (0.0..=1.0).contains(&t) {
            let r = q - t * v;
            best = Separation { weights: [1.0 - s, s, t - 1.0, -t], vector: r, squared: r.length_squared() };
            if area > NEARLY_PARALLEL * u.length_squared() * length {
                return best;
            }
        }
    }
    // Otherwise an end of one of the edges takes part.
    let mut offer = |r: DVec3, weights: [f64; 4]| {
        let squared = r.length_squared();
        if squared < best.squared {
            best = Separation { weights, vector: r, squared };
        }
    };
    let (t, r) = point_segment(w, v);
    offer(r, [1.0, 0.0, t - 1.0, -t]);
    let (t, r) = point_segment(x[1] - x[2], v);
    offer(r, [0.0, 1.0, t - 1.0, -t]);
    let (s, r) = point_segment(-w, u);
    offer(-r, [1.0 - s, s, -1.0, 0.0]);
    let (s, r) = point_segment(x[3] - x[0], u);
    offer(-r, [1.0 - s, s, 0.0, -1.0]);
    best
}
