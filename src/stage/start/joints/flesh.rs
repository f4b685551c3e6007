//! A body around its skeleton: what is inside of it, and where.

use std::collections::HashMap;
use std::sync::{Arc, Mutex, PoisonError};

use glam::DVec3;
use rayon::prelude::*;

use crate::geometry::closest_point::ClosestPoint;
use crate::geometry::cover::cover;
use crate::geometry::mesh::TriangleMesh;
use crate::geometry::solid_angle::winding;

/// The body winds around a point inside this often at least, and less than half of it around one that is surely outside;
/// between the two the body is open nearby.
const INSIDE: f64 = 0.5;
/// And a point inside sees the body in this share of all directions at least: one before a cap that is turned over, which
/// half of them meet, seems to be wound around.
const SEEN: f64 = 0.6;
/// A point that sees the body in more than this share of all directions is not surely outside: a body with two sides, whose
/// triangles face both ways, winds around nothing.
const COVERED: f64 = 0.95;

/// The surface of a body.
pub struct Flesh {
    /// Its mesh, in the space of its skeleton.
    pub mesh: Arc<TriangleMesh>,
    tree: ClosestPoint,
    /// What was found out about points, by their bits: the same few are asked for again and again, and of a body that is shared
    /// by every garment.
    windings: Mutex<HashMap<[u64; 3], f64>>,
}

impl Flesh {
    /// The body with this surface, which may be open, pass through itself, and face either way.
    pub fn new(mesh: impl Into<Arc<TriangleMesh>>) -> Self {
        let mesh = mesh.into();
        let tree = ClosestPoint::new(&mesh);
        Self { mesh, tree, windings: Mutex::default() }
    }

    /// Distance to the surface.
    pub fn distance(&self, p: DVec3) -> f64 {
        self.tree.distance(p)
    }

    /// Whether `p` is inside.
    pub fn contains(&self, p: DVec3) -> bool {
        self.winding(p) >= INSIDE && cover(&self.tree, p) >= SEEN
    }

    /// Whether `p` is outside without a doubt.
    pub fn excludes(&self, p: DVec3) -> bool {
        // The cover first: of most points it is whole, and found sooner.
        cover(&self.tree, p) <= COVERED && self.winding(p) < 0.5 * INSIDE
    }

    /// How often the surface winds around `p`, in either orientation: 1 inside, 0 outside, between them near holes.
    pub fn winding(&self, p: DVec3) -> f64 {
        let known = || self.windings.lock().unwrap_or_else(PoisonError::into_inner);
        let bits = p.to_array().map(f64::to_bits);
        if let Some(&winding) = known().get(&bits) {
            return winding;
        }
        // The lock is not held meanwhile: two that ask for the same at once find the same.
        let winding = self.count_winding(p);
        known().insert(bits, winding);
        winding
    }

    fn count_winding(&self, p: DVec3) -> f64 {
        // In pieces of fixed size, so that the sum does not depend on the number of threads.
        let triangles: Vec<u32> = (0..self.mesh.triangles.len() as u32).collect();
        let of_part = |part: &[u32]| winding(&self.mesh, part.iter().copied(), p);
        let parts: Vec<f64> = triangles.par_chunks(4096).map(of_part).collect();
        parts.iter().sum::<f64>().abs()
    }

    /// The middle of the limb that is nearest to `p`, which is outside: half-way from where the shortest way to the surface
    /// enters the body to where that line leaves it. None where it does not pass through a body there.
    pub fn middle_near(&self, p: DVec3) -> Option<DVec3> {
        let entry = self.tree.closest(p)?;
        let along = (entry.point - p).try_normalize()?;
        let inside = p + entry.distance * (1.0 + 1e-9) * along;
        let middle = inside + 0.5 * self.tree.first_hit(inside, along)? * along;
        self.contains(middle).then_some(middle)
    }
}
