//! Whether the garment encloses the skeleton.

use glam::DVec3;
use rayon::prelude::*;

use super::section::Section;
use crate::error::{Error, ErrorKind, Result};
use crate::geometry::closest_point::closest_on_segment;
use crate::geometry::mesh::TriangleMesh;

/// Garment vertices whose nearest points on the skeleton are tested.
const SAMPLES: usize = 64;
/// The garment must enclose at least this share of them. Low, so that a cape still passes.
const MIN_ENCLOSED_SHARE: f64 = 0.1;

/// Refuses a garment that does not enclose `segments`, the skeleton's bones as far as there is anything on them.
///
/// # Errors
/// `NotEnclosed`.
pub fn check(garment: &TriangleMesh, segments: &[[DVec3; 2]]) -> Result<()> {
    if enclosed_share(garment, segments) >= MIN_ENCLOSED_SHARE {
        return Ok(());
    }
    Err(Error::new(
        ErrorKind::NotEnclosed,
        "garment: it does not enclose the source skeleton and is around none of its bones; move one onto the other, and make \
         sure that both are in one coordinate system and unit",
    ))
}

/// The share of the garment for which this holds: it encloses the nearest point of `segments`, in the plane across them.
pub fn enclosed_share(garment: &TriangleMesh, segments: &[[DVec3; 2]]) -> f64 {
    let corners: Vec<u32> = garment.triangles.iter().flatten().copied().collect();
    let enclosed: Vec<bool> = corners
        .par_iter()
        .step_by(corners.len().div_ceil(SAMPLES).max(1))
        .map(|&v| encloses_nearest(garment, segments, garment.positions[v as usize]))
        .collect();
    let count = enclosed.iter().filter(|&&is_enclosed| is_enclosed).count();
    count as f64 / enclosed.len().max(1) as f64
}

fn encloses_nearest(garment: &TriangleMesh, segments: &[[DVec3; 2]], p: DVec3) -> bool {
    let candidates = segments.iter().map(|&[a, b]| {
        let point = closest_on_segment(p, a, b - a);
        (point.distance_squared(p), point, b - a)
    });
    let nearest = candidates.min_by(|a, b| a.0.total_cmp(&b.0));
    nearest.is_some_and(|(_, point, along)| Section::cut(garment, point, along).encloses(point))
}
