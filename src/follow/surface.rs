//! A garment as it was designed and as it is now, and how its triangles have moved between.

use glam::DVec3;
use rayon::prelude::*;

use crate::geometry::triangle_motion::TriangleMotion;
use crate::maths;

/// A surface in two states.
pub struct MovedSurface {
    /// The vertices as designed.
    pub rest: Vec<DVec3>,
    /// The same vertices now.
    pub now: Vec<DVec3>,
    /// Corners of the triangles.
    pub triangles: Vec<[u32; 3]>,
    /// How each triangle has moved; none for one that has no area.
    pub motions: Vec<Option<TriangleMotion>>,
}

impl MovedSurface {
    /// The surface of `triangles` over vertices at `rest` and `now`, of which there are as many.
    pub fn new(rest: Vec<DVec3>, now: Vec<DVec3>, triangles: Vec<[u32; 3]>) -> Self {
        let corners = |points: &[DVec3], t: &[u32; 3]| t.map(|v| points[v as usize]);
        let motions = triangles.iter().map(|t| TriangleMotion::between(corners(&rest, t), corners(&now, t))).collect();
        Self { rest, now, triangles, motions }
    }

    /// The angle of a triangle at a corner as designed, in radians.
    pub fn angle_at_rest(&self, t: usize, corner: usize) -> f64 {
        angle(&self.rest, &self.triangles[t], corner)
    }

    /// The angle of a triangle at a corner as it is now, in radians.
    pub fn angle_now(&self, t: usize, corner: usize) -> f64 {
        angle(&self.now, &self.triangles[t], corner)
    }

    /// How each vertex has moved: the mean over its triangles, by their angles as designed. What has no triangle has not moved.
    pub fn vertex_motions(&self) -> Vec<TriangleMotion> {
        let mut around = vec![Vec::new(); self.rest.len()];
        for (t, triangle) in self.triangles.iter().enumerate() {
            let Some(motion) = self.motions[t] else { continue };
            for (corner, &v) in triangle.iter().enumerate() {
                around[v as usize].push((self.angle_at_rest(t, corner), motion));
            }
        }
        let mean = |around: &Vec<(f64, TriangleMotion)>| TriangleMotion::mean(around.iter().copied());
        around.par_iter().map(|around| mean(around).unwrap_or(TriangleMotion::scale(1.0))).collect()
    }

    /// The unit normal of a triangle as designed; none where it has no area.
    pub fn normal_at_rest(&self, t: usize) -> Option<DVec3> {
        let [a, b, c] = self.triangles[t].map(|v| self.rest[v as usize]);
        (b - a).cross(c - a).try_normalize()
    }
}

/// The angle of a triangle at a corner, in radians; 0 where it has none.
fn angle(points: &[DVec3], triangle: &[u32; 3], corner: usize) -> f64 {
    let [at, next, last] = [0, 1, 2].map(|k| points[triangle[(corner + k) % 3] as usize]);
    let (a, b) = (next - at, last - at);
    maths::atan2(a.cross(b).length(), a.dot(b))
}
