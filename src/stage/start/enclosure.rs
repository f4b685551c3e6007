//! Whether the garment is around the skeleton, or lies beside it.

use glam::DVec3;
use rayon::prelude::*;

use super::section::Section;
use crate::error::{Error, ErrorKind, Result};
use crate::geometry::closest_point::closest_on_segment;
use crate::geometry::mesh::TriangleMesh;

/// Garment vertices whose nearest places on the skeleton are looked at.
const PLACES: usize = 64;
/// The garment must be around at least this share of them. Low, so that a cape still passes.
const AROUND: f64 = 0.1;

/// Refuses a garment that lies beside `lines`, the skeleton's bones as far as there is anything on them.
///
/// # Errors
/// `NotEnclosed`.
pub fn check(garment: &TriangleMesh, lines: &[[DVec3; 2]]) -> Result<()> {
    if share_around(garment, lines) >= AROUND {
        return Ok(());
    }
    Err(Error::new(
        ErrorKind::NotEnclosed,
        "garment: it lies beside the source skeleton and is around none of its bones; move one onto the other, and make \
         sure that both are in one space and unit",
    ))
}

/// The share of the garment for which this holds: it is around the nearest place of `lines`, in the plane across them.
pub fn share_around(garment: &TriangleMesh, lines: &[[DVec3; 2]]) -> f64 {
    let corners: Vec<u32> = garment.triangles.iter().flatten().copied().collect();
    let looks: Vec<bool> = corners
        .par_iter()
        .step_by(corners.len().div_ceil(PLACES).max(1))
        .map(|&v| surrounds_nearest(garment, lines, garment.positions[v as usize]))
        .collect();
    let around = looks.iter().filter(|&&around| around).count();
    around as f64 / looks.len().max(1) as f64
}

fn surrounds_nearest(garment: &TriangleMesh, lines: &[[DVec3; 2]], p: DVec3) -> bool {
    let places = lines.iter().map(|&[a, b]| {
        let place = closest_on_segment(p, a, b - a);
        (place.distance_squared(p), place, b - a)
    });
    let nearest = places.min_by(|a, b| a.0.total_cmp(&b.0));
    nearest.is_some_and(|(_, place, along)| Section::cut(garment, place, along).is_around(place))
}
