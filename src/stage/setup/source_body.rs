//! The body that the garment was designed on, and how far off it each point is to be on the body to dress.
//!
//! ```text
//! c(p) = s(p) max(0, D(p)),
//! ```
//!
//! D the signed distance from the source body, and s the size of the limb around which p is on the target body, as a multiple of
//! its size on the source body ([`LimbSizes`]). So a sleeve is as loose for its arm as it was, whatever the rest of the body is
//! like; and what lay inside the body, where the target cannot have it, goes to the surface and not beyond.

use std::sync::Arc;

use glam::DVec3;
use rayon::prelude::*;

use super::limb_sizes::LimbSizes;
use crate::geometry::closest_point::ClosestPoint;
use crate::geometry::mesh::TriangleMesh;
use crate::input::skeleton::Skeleton;
use crate::memo::MeshBits;
use crate::memory::bytes;

/// A point on the outer side of the triangle closest to it is outside, where that side is as clear as this cosine; else rays
/// decide.
const CLEAR: f64 = 0.3;
/// Rays that vote: no two alike, none along an axis of the coordinates or a plane of symmetry.
const RAYS: [DVec3; 5] = [
    DVec3::new(0.683, 0.412, 0.603),
    DVec3::new(-0.527, 0.731, 0.433),
    DVec3::new(0.291, -0.597, 0.747),
    DVec3::new(-0.379, -0.261, -0.888),
    DVec3::new(0.811, -0.343, -0.474),
];

/// The body that the garment was designed on.
#[derive(Clone)]
pub struct SourceBody {
    /// It, normalised by its skeleton.
    pub mesh: MeshBits,
    /// Its surface.
    pub surface: ClosestPoint,
    /// 1 where its triangles face outwards, -1 where inwards.
    outward: f64,
    sizes: LimbSizes,
}

impl SourceBody {
    /// `body` around the skeleton `source`, for `avatar` around `target`, each normalised by its skeleton.
    pub fn new(body: TriangleMesh, source: &Skeleton, target: &Skeleton, avatar: &TriangleMesh) -> Self {
        let surface = ClosestPoint::new(&body);
        let volume = |&[a, b, c]: &[u32; 3]| {
            let [a, b, c] = [a, b, c].map(|v| body.positions[v as usize] - source.joints[0]);
            a.dot(b.cross(c))
        };
        let outward = body.triangles.iter().map(volume).sum::<f64>().signum();
        let sizes = LimbSizes::new((source, &surface), (target, &ClosestPoint::new(avatar)));
        Self { mesh: MeshBits(Arc::new(body)), surface, outward, sizes }
    }

    /// The clearance that `p` of the garment as designed, at this signed distance, is to have on the target body.
    pub fn clearance(&self, p: DVec3, distance: f64) -> f64 {
        self.sizes.ratio(p) * distance.max(0.0)
    }

    /// The signed distance of each of `points`.
    pub fn signed_distances(&self, points: &[DVec3]) -> Vec<f64> {
        points.par_iter().map(|&p| self.signed_distance(p)).collect()
    }

    /// The distance of `p` from the surface, negative inside.
    pub fn signed_distance(&self, p: DVec3) -> f64 {
        let Some(closest) = self.surface.closest(p) else { return f64::INFINITY };
        let side = self.outward * (p - closest.point).dot(closest.normal);
        let is_outside = side > CLEAR * closest.distance * closest.normal.length();
        if !is_outside && self.is_inside(p) { -closest.distance } else { closest.distance }
    }

    /// Whether the surface is around `p`, by the majority of some rays: it may have holes.
    fn is_inside(&self, p: DVec3) -> bool {
        2 * RAYS.into_iter().filter(|&ray| self.surface.crossings(p, ray) != 0).count() > RAYS.len()
    }

    /// Bytes that it holds.
    pub fn memory(&self) -> u64 {
        let mesh = &*self.mesh.0;
        bytes(&mesh.positions) + bytes(&mesh.triangles) + self.surface.memory() + self.sizes.memory()
    }
}
