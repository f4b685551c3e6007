//! The contour along which a surface passes through itself, and the gradient of its length:
//!
//! ```text
//! L(x) = sum over the intersecting pairs of triangles of the length |X1 - X0| of what they have in common
//! ```
//!
//! An end X = (1 - s) p + s q of such a segment is where a side (p, q) of one triangle meets the other, whose unit normal is n
//! and in which X has the barycentric coordinates b. With E = q - p, and with de and df for the motion of side and triangle
//! at X, it moves by dX = de + E (n . (df - de)) / (n . E). So the gradient of g . X is
//!
//! ```text
//! g - a n  on the side,  a n  on the triangle,  where a = (g . E) / (n . E)
//! ```
//!
//! Contours that shrink to nothing untangle cloth without knowing which side of it is the right one: Volino and
//! Magnenat-Thalmann 2006, "Resolving surface collisions through intersection contour minimization".

use glam::DVec3;

/// Where a side of a triangle meets another triangle, or a corner that two have in common.
#[derive(Clone, Copy)]
struct End {
    point: DVec3,
    side: [u32; 2],
    /// On the side, from 0 to 1.
    parameter: f64,
    /// The triangle that the side meets, with its unit normal and the barycentric coordinates there; none at a common corner,
    /// which `side` has twice.
    face: Option<Face>,
}

#[derive(Clone, Copy)]
struct Face {
    corners: [u32; 3],
    normal: DVec3,
    weights: [f64; 3],
}

/// The length of the contour of the intersecting `pairs` of triangles, and its gradient for each of the `points`. Pairs with
/// an edge in common, and those that only touch, count nothing.
pub fn contour_length(points: &[DVec3], triangles: &[[u32; 3]], pairs: &[[u32; 2]]) -> (f64, Vec<DVec3>) {
    let mut gradient = vec![DVec3::ZERO; points.len()];
    let mut sum = 0.0;
    for &[s, t] in pairs {
        let Some([a, b]) = common_segment(points, triangles[s as usize], triangles[t as usize]) else { continue };
        let along = b.point - a.point;
        let length = along.length();
        sum += length;
        a.add_gradient(points, -along / length, &mut gradient);
        b.add_gradient(points, along / length, &mut gradient);
    }
    (sum, gradient)
}

impl End {
    /// Adds the gradient of `g . X`.
    fn add_gradient(&self, points: &[DVec3], g: DVec3, gradient: &mut [DVec3]) {
        let [p, q] = self.side;
        let Some(face) = &self.face else {
            gradient[p as usize] += g;
            return;
        };
        let along = points[q as usize] - points[p as usize];
        let normal = g.dot(along) / face.normal.dot(along) * face.normal;
        gradient[p as usize] += (1.0 - self.parameter) * (g - normal);
        gradient[q as usize] += self.parameter * (g - normal);
        for (corner, weight) in face.corners.into_iter().zip(face.weights) {
            gradient[corner as usize] += weight * normal;
        }
    }
}

/// The ends of the segment that two triangles have in common.
fn common_segment(points: &[DVec3], s: [u32; 3], t: [u32; 3]) -> Option<[End; 2]> {
    let mut ends: Vec<End> = Vec::new();
    for v in s.into_iter().filter(|v| t.contains(v)) {
        ends.push(End { point: points[v as usize], side: [v, v], parameter: 0.0, face: None });
    }
    if ends.len() > 1 {
        return None;
    }
    for (sides, face) in [(s, t), (t, s)] {
        for k in 0..3 {
            let side = [sides[k], sides[(k + 1) % 3]];
            if !side.iter().any(|v| face.contains(v)) {
                ends.extend(crossing(points, side, face));
            }
        }
    }
    // Where rounding finds an end twice, the two that are farthest apart are the segment's.
    let mut farthest: Option<([End; 2], f64)> = None;
    for (i, a) in ends.iter().enumerate() {
        for b in &ends[i + 1..] {
            let distance = a.point.distance_squared(b.point);
            if distance > farthest.map_or(0.0, |(_, d)| d) {
                farthest = Some(([*a, *b], distance));
            }
        }
    }
    farthest.map(|(ends, _)| ends)
}

/// Where a side meets a triangle.
fn crossing(points: &[DVec3], side: [u32; 2], corners: [u32; 3]) -> Option<End> {
    let [p, q] = side.map(|v| points[v as usize]);
    let [a, b, c] = corners.map(|v| points[v as usize]);
    let normal = (b - a).cross(c - a);
    let (from, to) = ((p - a).dot(normal), (q - a).dot(normal));
    if (from > 0.0) == (to > 0.0) || from == to {
        return None;
    }
    let parameter = from / (from - to);
    let point = p.lerp(q, parameter);
    let area = normal.length_squared();
    let weight = |u: DVec3, v: DVec3| (u - point).cross(v - point).dot(normal) / area;
    let weights = [weight(b, c), weight(c, a), weight(a, b)];
    weights.iter().all(|&w| w >= 0.0).then(|| End {
        point,
        side,
        parameter,
        face: Some(Face { corners, normal: normal / area.sqrt(), weights }),
    })
}
