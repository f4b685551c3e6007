//! A planar cross-section of the garment, and whether it encloses a point of its plane.

use glam::{DVec2, DVec3};

use crate::geometry::closest_point::closest_on_segment;
use crate::geometry::mesh::TriangleMesh;

/// Directions around a point, one bit each.
const DIRECTIONS: u32 = 64;
/// The widest gap that a section may leave around what it encloses, in directions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Gap {
    /// Below half a turn, which is the narrowest gap for a point outside of something convex. A cape still passes.
    Half = 28,
    /// A quarter of a turn: an open collar or bangle passes, and glasses or a pair of earrings do not.
    Quarter = 16,
}

/// The curve in which a plane cuts the garment.
pub struct Section {
    origin: DVec3,
    u: DVec3,
    v: DVec3,
    segments: Vec<[DVec2; 2]>,
}

impl Section {
    /// Cuts `garment` by the plane through `origin` across `normal`; a normal without length counts as z.
    pub fn cut(garment: &TriangleMesh, origin: DVec3, normal: DVec3) -> Self {
        let normal = normal.try_normalize().unwrap_or(DVec3::Z);
        let (u, v) = normal.any_orthonormal_pair();
        let mut section = Self { origin, u, v, segments: Vec::new() };
        for triangle in &garment.triangles {
            let corners = triangle.map(|v| garment.positions[v as usize] - origin);
            let heights = corners.map(|c| c.dot(normal));
            if heights == [0.0; 3] {
                // It lies in the plane, as a flat brim may: its edges.
                let [a, b, c] = corners.map(|p| DVec2::new(p.dot(u), p.dot(v)));
                section.segments.extend([[a, b], [b, c], [c, a]]);
                continue;
            }
            let mut ends = [DVec2::ZERO; 2];
            let mut count = 0;
            for (i, j) in [(0, 1), (1, 2), (2, 0)] {
                if (heights[i] >= 0.0) != (heights[j] >= 0.0) && count < 2 {
                    let p = corners[i].lerp(corners[j], heights[i] / (heights[i] - heights[j]));
                    ends[count] = DVec2::new(p.dot(u), p.dot(v));
                    count += 1;
                }
            }
            if count == 2 {
                section.segments.push(ends);
            }
        }
        section
    }

    /// The garment's edges, seen along `normal`, which has length 1, in the plane through `origin`: for one that is flat and
    /// lies along the plane.
    pub fn projected(garment: &TriangleMesh, origin: DVec3, normal: DVec3) -> Self {
        let (u, v) = normal.any_orthonormal_pair();
        let flat = |corner: u32| {
            let p = garment.positions[corner as usize] - origin;
            DVec2::new(p.dot(u), p.dot(v))
        };
        let sides = |&[a, b, c]: &[u32; 3]| [[a, b], [b, c], [c, a]].map(|side| side.map(flat));
        Self { origin, u, v, segments: garment.triangles.iter().flat_map(sides).collect() }
    }

    /// The pieces of the curve, seen from the origin along [`Self::axes`].
    pub fn segments(&self) -> &[[DVec2; 2]] {
        &self.segments
    }

    /// The two directions that span the plane.
    pub fn axes(&self) -> [DVec3; 2] {
        [self.u, self.v]
    }

    /// The distance from `p`, which lies in the plane, to the curve; infinite where there is none.
    pub fn distance(&self, p: DVec3) -> f64 {
        let centre = DVec2::new((p - self.origin).dot(self.u), (p - self.origin).dot(self.v)).extend(0.0);
        let distance =
            |&[a, b]: &[DVec2; 2]| closest_on_segment(centre, a.extend(0.0), (b - a).extend(0.0)).distance(centre);
        self.segments.iter().map(distance).fold(f64::INFINITY, f64::min)
    }

    /// Whether the garment encloses `p`, which lies in the plane, but for a gap of less than half a turn.
    pub fn encloses(&self, p: DVec3) -> bool {
        self.encloses_but_for(p, Gap::Half)
    }

    /// Whether the garment encloses `p`, which lies in the plane: a test of the angles under which its curve is seen from there.
    pub fn encloses_but_for(&self, p: DVec3, widest: Gap) -> bool {
        let centre = DVec2::new((p - self.origin).dot(self.u), (p - self.origin).dot(self.v));
        let mut covered = 0u64;
        for &[a, b] in &self.segments {
            let (a, b) = (a - centre, b - centre);
            let turn = a.perp_dot(b);
            let (from, to) = if turn >= 0.0 { (direction(a), direction(b)) } else { (direction(b), direction(a)) };
            // Fewer than half of all directions: a segment is never seen under more than half a turn.
            let width = (to + DIRECTIONS - from) % DIRECTIONS;
            let bits = if width >= DIRECTIONS / 2 { 1 } else { (2u64 << width) - 1 };
            covered |= bits.rotate_left(from);
        }
        let mut empty = !covered;
        if covered == 0 {
            return false;
        }
        // Each round takes one direction off every gap.
        for _ in 0..widest as u32 {
            empty &= empty.rotate_left(1);
        }
        empty == 0
    }
}

/// The number of a direction, counted once around. Steps are not of equal angle, but opposite directions are half of the
/// numbers apart.
fn direction(p: DVec2) -> u32 {
    let length = p.x.abs() + p.y.abs();
    if length == 0.0 {
        return 0;
    }
    let quarter = if p.y >= 0.0 { 1.0 - p.x / length } else { 3.0 + p.x / length };
    (0.25 * f64::from(DIRECTIONS) * quarter) as u32 % DIRECTIONS
}
