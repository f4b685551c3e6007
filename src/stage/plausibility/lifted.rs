//! Cloth that stands off the body over something that sticks out of it, such as wings under a vest.
//!
//! Whatever the thing is nearest to, the cloth over it lies much farther from the bones than in the design, beside the rest of the
//! garment, and farther than the cloth of the design anywhere. Bodies that are wider all around, or here and there, lift little of it
//! so far.

use super::nearest::parts_of_bones;
use super::{Lifted, Outcome};
use crate::geometry::closest_point::ClosestPoint;
use crate::geometry::mesh::TriangleMesh;
use crate::geometry::quantile::quantile;
use crate::input::skeleton::{BoneGraph, Skeleton};

/// The share of the cloth, by its area in the design, of which how many times as far from the bones as in the design it lies is
/// the measure for the rest.
const NEAR: f64 = 0.25;
/// Cloth stands off where that is so many times more for it, and it is so many times farther from the bones than all but a tenth of
/// the design.
const MORE: f64 = 3.0;
const BEYOND: (f64, f64) = (1.2, 0.9);
/// So much of the cloth may: of the closet's garments 0.07 at most do.
const MOST: f64 = 0.1;
/// Below this distance from a bone none is told from another, and cloth of less area, such as a necklace, lies where it finds room:
/// of less area both in the design and in the result, for sandals that were blown up to the knees are no small thing any more.
const LEAST_DISTANCE: f64 = 0.02;
const LEAST_AREA: f64 = 0.25;
/// From this share of the last bone of a limb on, a hem or cuff of the design may lie over what ends the limb, as trousers over the
/// toes of a boot. A garment of which more than half is there, such as a shoe, is judged there.
const END: f64 = 0.8;
/// Cloth lies on what is worn where that is nearer than the body, and nearer than this share of its distance from the bones.
const ON_WORN: f64 = 0.5;

/// The cloth that stands off, where that is gross; none where the caller wants what is under it to be there. So he does with what the
/// body wears already, as shoes under trousers.
pub(super) fn lifted(outcome: &Outcome<'_>, graph: &BoneGraph) -> Option<Lifted> {
    let Outcome { design, result, source, target, worn, collision_only, .. } = *outcome;
    let areas = design.areas();
    let whole: f64 = areas.iter().sum();
    let largest = whole.max(result.areas().iter().sum());
    if largest < LEAST_AREA || !collision_only.is_empty() {
        return None;
    }
    let (before, now) = (places(design, source, graph), places(result, target, graph));
    let at_ends: f64 = before.iter().zip(&areas).filter(|(place, _)| place.at_end).map(|(_, area)| area).sum();
    let is_judged = |t: usize| !before[t].at_end || at_ends > 0.5 * whole;
    let ratio = |t: usize| now[t].distance.max(LEAST_DISTANCE) / before[t].distance.max(LEAST_DISTANCE);
    let near = quantile((0..areas.len()).map(|t| (ratio(t), areas[t])).collect(), NEAR)?;
    let far =
        BEYOND.0 * quantile(before.iter().map(|place| place.distance).zip(areas.iter().copied()).collect(), BEYOND.1)?;
    let is_off = |&t: &usize| is_judged(t) && ratio(t) > MORE * near && now[t].distance > far;
    let mut stands_off: Vec<usize> = (0..areas.len()).filter(is_off).collect();
    if !(worn.triangles.is_empty() || stands_off.is_empty()) {
        let [body, worn] = [outcome.body, worn].map(ClosestPoint::new);
        stands_off.retain(|&t| {
            let middle = result.centre(t as u32);
            let from_worn = worn.distance(middle);
            body.distance(middle) <= from_worn || from_worn > ON_WORN * now[t].distance
        });
    }
    let area: f64 = stands_off.iter().map(|&t| areas[t]).sum();
    let farthest = stands_off.into_iter().max_by(|&a, &b| ratio(a).total_cmp(&ratio(b)).then(b.cmp(&a)))?;
    (area > MOST * whole).then(|| Lifted { triangle: farthest as u32, times: ratio(farthest) / near })
}

/// Where a triangle is.
#[derive(Clone, Copy, Default)]
struct Place {
    /// From the nearest bone.
    distance: f64,
    /// At the end of a limb, or beyond.
    at_end: bool,
}

/// The place of each triangle.
fn places(mesh: &TriangleMesh, skeleton: &Skeleton, graph: &BoneGraph) -> Vec<Place> {
    let mut places = vec![Place::default(); mesh.triangles.len()];
    for (bone, parts) in skeleton.bones.iter().zip(parts_of_bones(mesh, skeleton, graph)) {
        let [first, last] = bone.map(|joint| graph.is_leaf(joint));
        for part in parts {
            let at_end = last && part.parameter > END || first && part.parameter < 1.0 - END;
            places[part.triangle as usize] = Place { distance: part.distance, at_end };
        }
    }
    places
}
