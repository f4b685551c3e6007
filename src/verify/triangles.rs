//! Whether two closed triangles have a point in common, exactly, for triangles of any shape.
//!
//! Two triangles intersect exactly where a side of one intersects the other. A side and a triangle are tested by signs of
//! volumes (orientation predicates, Shewchuk 1997); coplanar ones in a projection that keeps the plane's area (dropping a
//! coordinate rounds nothing), collinear ones by intervals.

use glam::DVec3;
use robust::{Coord, Coord3D};

type Segment = [DVec3; 2];
type Triangle = [DVec3; 3];

/// Sign of the volume of the tetrahedron a, b, c, d.
#[inline]
fn orient3(a: DVec3, b: DVec3, c: DVec3, d: DVec3) -> i8 {
    let p = |v: DVec3| Coord3D { x: v.x, y: v.y, z: v.z };
    sign(robust::orient3d(p(a), p(b), p(c), p(d)))
}

/// Sign of the area of a, b, c as seen along `axis`.
#[inline]
fn orient2(axis: usize, a: DVec3, b: DVec3, c: DVec3) -> i8 {
    let (x, y) = ((axis + 1) % 3, (axis + 2) % 3);
    let p = |v: DVec3| Coord { x: v[x], y: v[y] };
    sign(robust::orient2d(p(a), p(b), p(c)))
}

#[inline]
fn sign(x: f64) -> i8 {
    i8::from(x > 0.0) - i8::from(x < 0.0)
}

/// An axis along which a, b, c are seen with an area, or `None` where they are on one line.
fn projection(a: DVec3, b: DVec3, c: DVec3) -> Option<usize> {
    (0..3).find(|&axis| orient2(axis, a, b, c) != 0)
}

fn all_of_one_sign(signs: [i8; 3]) -> bool {
    signs == [1; 3] || signs == [-1; 3]
}

fn none_of_both_signs(signs: [i8; 3]) -> bool {
    !(signs.contains(&1) && signs.contains(&-1))
}

fn sides([a, b, c]: Triangle) -> [Segment; 3] {
    [[a, b], [b, c], [c, a]]
}

/// True where two triangles have a point in common.
pub fn touch(s: Triangle, t: Triangle) -> bool {
    // On which side of the other's plane each corner is; all 0 where that other has no area.
    let of_t = t.map(|p| orient3(s[0], s[1], s[2], p));
    if all_of_one_sign(of_t) {
        return false;
    }
    let of_s = s.map(|p| orient3(t[0], t[1], t[2], p));
    if all_of_one_sign(of_s) {
        return false;
    }
    let meets = |segments: [Segment; 3], signs: [i8; 3], other: Triangle| {
        (0..3).any(|k| segment_meets(segments[k], [signs[k], signs[(k + 1) % 3]], other))
    };
    meets(sides(s), of_s, t) || meets(sides(t), of_t, s)
}

/// True where two triangles of one mesh touch beyond the corners that they share by index (see
/// [`intersections`](super::intersections)).
pub fn touch_in_mesh(points: &[DVec3], s: &[u32; 3], t: &[u32; 3]) -> bool {
    let at = |v: u32| points[v as usize];
    let (s_points, t_points) = (s.map(at), t.map(at));
    let shared = distinct(s, |v| t.contains(&v));
    match shared.as_slice() {
        [] => touch(s_points, t_points),
        [common] => {
            // Opposite to the shared corner: a side, or a point where an index is repeated, or nothing.
            let opposite = |triangle: &[u32; 3]| match distinct(triangle, |v| v != *common).as_slice() {
                [p, q] => Some([at(*p), at(*q)]),
                [p] => Some([at(*p); 2]),
                _ => None,
            };
            let meets = |side: Option<Segment>, other| side.is_some_and(|side| segment_touches(side, other));
            meets(opposite(s), t_points) || meets(opposite(t), s_points)
        }
        [p, q] => {
            let apex = |triangle: &[u32; 3]| triangle.iter().copied().find(|v| v != p && v != q);
            // A triangle that repeats an index is no more than the shared edge.
            let (Some(a), Some(b)) = (apex(s), apex(t)) else { return false };
            folded_flat([at(*p), at(*q)], at(a), at(b))
        }
        _ => true,
    }
}

/// The distinct members of a triangle that pass `keep`.
fn distinct(triangle: &[u32; 3], keep: impl Fn(u32) -> bool) -> Members {
    let mut members = Members { list: [0; 3], len: 0 };
    for &v in triangle {
        if keep(v) && !members.as_slice().contains(&v) {
            members.list[members.len] = v;
            members.len += 1;
        }
    }
    members
}

struct Members {
    list: [u32; 3],
    len: usize,
}

impl Members {
    fn as_slice(&self) -> &[u32] {
        &self.list[..self.len]
    }
}

/// True where the triangles (p, q, a) and (p, q, b) have more in common than the side from p to q.
fn folded_flat([p, q]: Segment, a: DVec3, b: DVec3) -> bool {
    if orient3(p, q, a, b) != 0 {
        return false;
    }
    match (projection(p, q, a), projection(p, q, b)) {
        // Coplanar: on the same side of the common edge in this projection?
        (Some(axis), Some(_)) => orient2(axis, p, q, a) == orient2(axis, p, q, b),
        // One has no area: it is on the line through p and q, on which the other has just that side.
        (Some(_), None) | (None, Some(_)) => false,
        // A point or two segments out of one point, or segments on one line.
        _ if p == q => a != p && b != p && projection(p, a, b).is_none() && same_direction(p, a, b),
        _ => {
            let Some(k) = (0..3).find(|&k| p[k] != q[k]) else { return false };
            let (low, high) = (p[k].min(q[k]), p[k].max(q[k]));
            (a[k] > high && b[k] > high) || (a[k] < low && b[k] < low)
        }
    }
}

/// For a and b on one line with p, both different from it: whether they are on the same side of p.
fn same_direction(p: DVec3, a: DVec3, b: DVec3) -> bool {
    (0..3).all(|k| (a[k] > p[k]) == (b[k] > p[k]) && (a[k] < p[k]) == (b[k] < p[k]))
}

/// True where a segment and a triangle have a point in common.
fn segment_touches(segment: Segment, t: Triangle) -> bool {
    segment_meets(segment, segment.map(|p| orient3(t[0], t[1], t[2], p)), t)
}

/// As [`segment_touches`], given on which side of the triangle's plane the ends are.
fn segment_meets([p, q]: Segment, ends: [i8; 2], t: Triangle) -> bool {
    if ends == [0, 0] {
        return coplanar_meets([p, q], t);
    }
    // The segment reaches the plane in one point, which is in the triangle where its line has the same orientation
    // to all three sides.
    ends[0] * ends[1] <= 0 && none_of_both_signs(sides(t).map(|[a, b]| orient3(p, q, a, b)))
}

/// A segment and a triangle of one plane, or any segment and a triangle without area.
fn coplanar_meets(segment: Segment, t: Triangle) -> bool {
    let Some(axis) = projection(t[0], t[1], t[2]) else {
        return sides(t).into_iter().any(|side| segments_meet(segment, side));
    };
    let contains = |p: DVec3| none_of_both_signs(sides(t).map(|[a, b]| orient2(axis, a, b, p)));
    contains(segment[0]) || sides(t).into_iter().any(|side| segments_meet_in_plane(axis, segment, side))
}

/// True where two segments have a point in common.
fn segments_meet([p, q]: Segment, [a, b]: Segment) -> bool {
    if orient3(p, q, a, b) != 0 {
        return false;
    }
    // Some three of the four points span their plane.
    let corners = [[p, q, a], [p, q, b], [p, a, b], [q, a, b]];
    if let Some(axis) = corners.into_iter().find_map(|[x, y, z]| projection(x, y, z)) {
        return segments_meet_in_plane(axis, [p, q], [a, b]);
    }
    // Collinear: intervals on the line overlap where their projections on any axis do, if the line has an extent along
    // it; where it has none, all project to the same point.
    (0..3).all(|k| p[k].min(q[k]) <= a[k].max(b[k]) && a[k].min(b[k]) <= p[k].max(q[k]))
}

/// Two segments of a plane that is seen with its area along `axis`.
fn segments_meet_in_plane(axis: usize, [p, q]: Segment, [a, b]: Segment) -> bool {
    let (of_a, of_b) = (orient2(axis, p, q, a), orient2(axis, p, q, b));
    let (of_p, of_q) = (orient2(axis, a, b, p), orient2(axis, a, b, q));
    if of_a * of_b < 0 && of_p * of_q < 0 {
        return true;
    }
    // Otherwise an end of one is on the other: on its line and within its box.
    let within = |[c, d]: Segment, x: DVec3| {
        [(axis + 1) % 3, (axis + 2) % 3].into_iter().all(|k| c[k].min(d[k]) <= x[k] && x[k] <= c[k].max(d[k]))
    };
    (of_a == 0 && within([p, q], a))
        || (of_b == 0 && within([p, q], b))
        || (of_p == 0 && within([a, b], p))
        || (of_q == 0 && within([a, b], q))
}
