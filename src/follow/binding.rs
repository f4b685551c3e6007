//! Points that are bound to a garment and go along with it, such as the vertices of a level of detail, a trim or a badge.
//!
//! A point is bound to the nearest point of the garment as designed, in barycentric coordinates. Its offset from there goes along
//! by the motion of the surface, which is interpolated between the vertices: so neighbours on both sides of an edge, whose
//! nearest triangles differ, move alike, and there is no normal that could be ambiguous.

use glam::DVec3;
use rayon::prelude::*;

use super::surface::MovedSurface;
use crate::geometry::closest_point::{ClosestPoint, barycentric};
use crate::geometry::mesh::TriangleMesh;
use crate::geometry::triangle_motion::TriangleMotion;

/// Where a point is bound.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// The vertices of the triangle.
    pub triangle: [u32; 3],
    /// Barycentric coordinates of the nearest point in it.
    pub weights: [f64; 3],
    /// From there to the point.
    pub offset: DVec3,
}

impl Place {
    /// Where each of `points` is bound to `surface` as designed; none on a surface without triangles.
    pub fn of_all(surface: &MovedSurface, points: &[DVec3]) -> Vec<Option<Self>> {
        let mesh = TriangleMesh { positions: surface.rest.clone(), triangles: surface.triangles.clone() };
        let tree = ClosestPoint::new(&mesh);
        let place = |&p: &DVec3| {
            let closest = tree.closest(p)?;
            let triangle = surface.triangles[closest.triangle as usize];
            let weights = barycentric(closest.point, triangle.map(|v| surface.rest[v as usize]));
            let base: DVec3 = (0..3).map(|k| weights[k] * surface.rest[triangle[k] as usize]).sum();
            Some(Self { triangle, weights, offset: p - base })
        };
        points.par_iter().map(place).collect()
    }

    /// How far the point is from the surface as designed.
    pub fn distance(&self) -> f64 {
        self.offset.length()
    }

    /// Where the point is now, by the motions of the vertices of `surface`.
    pub fn now(&self, surface: &MovedSurface, motions: &[TriangleMotion]) -> DVec3 {
        let corners = || (0..3).map(|k| (self.weights[k], self.triangle[k] as usize));
        let base: DVec3 = corners().map(|(weight, v)| weight * surface.now[v]).sum();
        let motion = TriangleMotion::mean(corners().map(|(weight, v)| (weight, motions[v])));
        base + motion.map_or(self.offset, |motion| motion.of_vector(self.offset))
    }
}
