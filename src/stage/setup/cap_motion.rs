//! The vertices of a cap follow its rim.
//!
//! Caps take no part in the solution ([`crate::stage::start::caps`]); their rims do, being open boundaries there. A vertex
//! within a cap is read where the affine map that suits the rim best takes it, corrected by what that map leaves at the
//! rim's vertices, near ones more than far ones. The map takes the rim's normal along, so that a dome stays one.

use glam::{DMat3, DVec3};

use crate::geometry::mesh::TriangleMesh;

/// Vertices of a cap, at rest and bound to its rim.
#[derive(Clone, Debug, Default)]
pub struct CapMotion {
    /// Vertices within the cap, which no other triangle uses.
    inner: Vec<u32>,
    /// Sides of the rim: edges of the cap's triangles that one of them has, in its direction.
    rim: Vec<[u32; 2]>,
    /// Vertices of the rim.
    corners: Vec<u32>,
}

impl CapMotion {
    /// Of the cap made of `triangles` of `garment`; `kept` tells which vertices other triangles use.
    pub fn new(garment: &TriangleMesh, triangles: &[u32], kept: &[bool]) -> Self {
        let own = || triangles.iter().map(|&t| garment.triangles[t as usize]);
        let mut sides: Vec<([u32; 2], [u32; 2])> =
            own().flat_map(|[a, b, c]| [[a, b], [b, c], [c, a]]).map(|[a, b]| ([a.min(b), a.max(b)], [a, b])).collect();
        sides.sort_unstable();
        let single = sides.chunk_by(|a, b| a.0 == b.0).filter(|same| same.len() == 1).map(|same| same[0].1);
        let mut vertices: Vec<u32> = own().flatten().collect();
        vertices.sort_unstable();
        vertices.dedup();
        let (corners, inner) = vertices.into_iter().partition(|&v| kept[v as usize]);
        Self { inner, rim: single.collect(), corners }
    }

    /// Moves the vertices within the cap to where the rim in `x` takes them from `rest`.
    pub fn carry(&self, rest: &[DVec3], x: &mut [DVec3]) {
        if self.inner.is_empty() || self.corners.is_empty() {
            return;
        }
        let (before, now) = (self.frame(rest), self.frame(x));
        let map = before.map_to(&now, &self.corners, rest, x);
        let image = |p: DVec3| now.centre + map * (p - before.centre);
        for &v in &self.inner {
            let p = rest[v as usize];
            let (mut sum, mut weight) = (DVec3::ZERO, 0.0);
            for &corner in &self.corners {
                let c = corner as usize;
                let share = 1.0 / p.distance_squared(rest[c]).max(f64::MIN_POSITIVE);
                sum += share * (x[c] - image(rest[c]));
                weight += share;
            }
            let place = image(p) + sum / weight;
            x[v as usize] = if place.is_finite() { place } else { now.centre };
        }
    }

    fn frame(&self, x: &[DVec3]) -> Frame {
        let centre = self.corners.iter().map(|&v| x[v as usize]).sum::<DVec3>() / self.corners.len() as f64;
        let area = |&[a, b]: &[u32; 2]| 0.5 * (x[a as usize] - centre).cross(x[b as usize] - centre);
        Frame { centre, area: self.rim.iter().map(area).sum() }
    }
}

/// Where a rim is, and how it lies: its area vector.
struct Frame {
    centre: DVec3,
    area: DVec3,
}

impl Frame {
    /// The linear map from this frame to `now` that suits the `corners` best, the normals being two more of them.
    fn map_to(&self, now: &Self, corners: &[u32], rest: &[DVec3], x: &[DVec3]) -> DMat3 {
        let outer = |a: DVec3, b: DVec3| DMat3::from_cols(a * b.x, a * b.y, a * b.z);
        let (mut moved, mut own) = (DMat3::ZERO, DMat3::ZERO);
        let mut add = |q: DVec3, p: DVec3| {
            moved += outer(q, p);
            own += outer(p, p);
        };
        corners.iter().map(|&v| v as usize).for_each(|v| add(x[v] - now.centre, rest[v] - self.centre));
        // As long as the rim is wide, and as often as it has vertices.
        let spread = (corners.len() as f64 / 2.0).sqrt();
        let height = |frame: &Self| frame.area.normalize_or_zero() * frame.area.length().sqrt() * spread;
        add(height(now), height(self));
        let inverse = own.inverse();
        if inverse.is_finite() { moved * inverse } else { DMat3::IDENTITY }
    }
}
