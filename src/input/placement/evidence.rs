//! What tells a right reading of a mesh from a wrong one, beside its distance from the bones: the bones of a body are inside of
//! it, and those of a garment go through its openings and not through its cloth.

use glam::DVec3;
use rayon::prelude::*;

use crate::geometry::closest_point::ray_triangle;
use crate::geometry::mesh::{Topology, TriangleMesh, area_vector};
use crate::geometry::missing_faces::are_missing_faces;
use crate::geometry::solid_angle::winding;
use crate::input::skeleton::Skeleton;

/// Points along a bone, at most and where there are many triangles, and pairs of point and triangle.
const ALONG: usize = 6;
const MOST_PAIRS: usize = 8_000_000;
/// More bones say nothing that these do not, and take long.
pub(super) const MOST_BONES: usize = 200;
/// A bone reaches beyond a leaf joint by this share of its length.
pub(super) const LEAF_REACH: f64 = 0.5;
/// The area of an opening that a limb fits through is more than this share of its squared length: a circle has 0.08, a slit none.
const ROUND: f64 = 0.01;

/// The share of the bones' length that is inside of a body.
pub fn inside_share(body: &TriangleMesh, skeleton: &Skeleton) -> f64 {
    let bones: Vec<[DVec3; 2]> = skeleton.bones.iter().map(|bone| bone.map(|j| skeleton.joints[j as usize])).collect();
    let every = bones.len().div_ceil(MOST_BONES).max(1);
    let some = bones.len().div_ceil(every).max(1);
    let along = (MOST_PAIRS / body.triangles.len().max(1) / some).clamp(1, ALONG);
    let points: Vec<(DVec3, f64)> = bones
        .iter()
        .step_by(every)
        .flat_map(|&[a, b]| (0..along).map(move |k| (a.lerp(b, (k as f64 + 0.5) / along as f64), a.distance(b))))
        .collect();
    let is_inside = |p: DVec3| winding(body, 0..body.triangles.len() as u32, p).abs() > 0.5;
    let inside: Vec<bool> = points.par_iter().map(|&(p, _)| is_inside(p)).collect();
    let whole: f64 = points.iter().map(|point| point.1).sum();
    let part: f64 = points.iter().zip(inside).filter(|(_, inside)| *inside).map(|(point, _)| point.1).sum();
    part / whole.max(f64::MIN_POSITIVE)
}

/// How a garment is on bones.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Threading {
    /// Openings through which a bone goes.
    pub through: usize,
    /// Bones that pass through cloth.
    pub pierced: usize,
}

impl Threading {
    /// By how many openings and bones `self` is better than `other`; none where it is worse in one of the two.
    pub fn better_than(&self, other: &Self) -> Option<usize> {
        Some(self.through.checked_sub(other.through)? + other.pierced.checked_sub(self.pierced)?)
    }
}

/// A garment with its openings.
pub struct Threaded<'a> {
    garment: &'a TriangleMesh,
    openings: Vec<Opening>,
}

/// A boundary loop.
struct Opening {
    /// Triangles from its middle.
    fan: Vec<[DVec3; 3]>,
    middle: DVec3,
    length: f64,
    is_cut: bool,
}

impl<'a> Threaded<'a> {
    /// The openings of `garment`.
    pub fn new(garment: &'a TriangleMesh) -> Self {
        let topology = Topology::new(garment.positions.len(), &garment.triangles);
        let missing = are_missing_faces(garment, &topology);
        let opening = |vertices: &[u32], is_missing: bool| {
            let points: Vec<DVec3> = vertices.iter().map(|&v| garment.positions[v as usize]).collect();
            let middle = points.iter().sum::<DVec3>() / points.len().max(1) as f64;
            let edges = || points.iter().zip(points.iter().cycle().skip(1));
            let fan = edges().map(|(&p, &q)| [middle, p, q]).collect();
            let length: f64 = edges().map(|(p, q)| p.distance(*q)).sum();
            let is_cut = !is_missing && area_vector(&points).length() > ROUND * length * length;
            Opening { fan, middle, length, is_cut }
        };
        let openings = topology.loops.iter().zip(missing).map(|(l, is_missing)| opening(&l.vertices, is_missing));
        Self { garment, openings: openings.collect() }
    }

    /// How many openings there are.
    pub fn openings(&self) -> usize {
        self.openings.len()
    }

    /// Middle and length of an opening.
    pub fn opening(&self, k: usize) -> (DVec3, f64) {
        (self.openings[k].middle, self.openings[k].length)
    }

    /// Whether a garment was cut with this opening: it is no slit along a seam, nor are there a few faces missing.
    pub fn is_cut(&self, k: usize) -> bool {
        self.openings[k].is_cut
    }

    /// Whether a segment passes through cloth.
    pub fn passes_cloth(&self, segment: [DVec3; 2]) -> bool {
        let all = 0..self.garment.triangles.len() as u32;
        all.into_par_iter().any(|t| meets(segment, &self.garment.corners(t)))
    }

    /// Whether a segment goes through an opening. Forth and back through its fan is not through.
    pub fn goes_through(&self, k: usize, [a, b]: [DVec3; 2]) -> bool {
        let sense = |[p, q, r]: &[DVec3; 3]| if (b - a).dot((*q - *p).cross(*r - *p)) < 0.0 { -1 } else { 1 };
        self.openings[k].fan.iter().filter(|corners| meets([a, b], corners)).map(sense).sum::<i32>() != 0
    }

    /// The openings through which no bone of `skeleton` goes.
    pub fn empty_openings(&self, skeleton: &Skeleton) -> Vec<usize> {
        let segments = skeleton.lengthened(LEAF_REACH);
        let is_empty = |&k: &usize| segments.iter().all(|&segment| !self.goes_through(k, segment));
        (0..self.openings.len()).into_par_iter().filter(is_empty).collect()
    }

    /// How it is on the bones of `skeleton`.
    pub fn on(&self, skeleton: &Skeleton) -> Threading {
        if skeleton.bones.len() > MOST_BONES {
            return Threading::default();
        }
        Threading {
            through: self.openings.len() - self.empty_openings(skeleton).len(),
            pierced: skeleton.lengthened(0.0).into_iter().filter(|&bone| self.passes_cloth(bone)).count(),
        }
    }
}

fn meets([a, b]: [DVec3; 2], corners: &[DVec3; 3]) -> bool {
    ray_triangle(a, b - a, corners).is_some_and(|along| along <= 1.0)
}
