//! Which limbs a garment is on: those that it covers somewhere, and those that carry such a one, as the arm carries a glove.
//!
//! How the others stand is nothing to the garment: arms that hang beside trousers need no way past them.

use glam::DVec3;

use super::landmark::Landmark;
use super::places::index;
use super::posing::LIMBS;
use crate::geometry::closest_point::ClosestPoint;
use crate::geometry::cover::cover;
use crate::geometry::mesh::TriangleMesh;

/// A place that the garment covers by this share is in it.
const COVERED: f64 = 0.5;
/// Into how many parts a limb is cut between the places that are looked at.
const PARTS: u32 = 8;

/// For each of [`LIMBS`], whether `garment` is on it, with the landmarks of the body that it was designed on at `places`. What is
/// not known of counts.
pub fn clothed(garment: &TriangleMesh, places: &[Option<DVec3>; Landmark::COUNT]) -> [bool; LIMBS.len()] {
    let surface = ClosestPoint::new(garment);
    let is_covered = |a: DVec3, b: DVec3| {
        (0..=PARTS).any(|k| cover(&surface, a.lerp(b, f64::from(k) / f64::from(PARTS))) >= COVERED)
    };
    let mut on = LIMBS.map(|[a, b]| places[index(a)].zip(places[index(b)]).is_none_or(|(a, b)| is_covered(a, b)));
    // Each lower limb follows the upper one that carries it.
    for pair in on.chunks_exact_mut(2) {
        pair[0] |= pair[1];
    }
    on
}
