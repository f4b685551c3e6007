//! Limbs that were outside of the garment and are shut up in it, or were inside and are beside it.
//!
//! A point of the body belongs to the nearest bone, at a parameter along it. The design says by the same point of the source
//! skeleton whether the garment covers what is there. Only ends of limbs are looked at for what is shut up: where cuffs and
//! hems end is for the position term, and a limb that comes out of the garment is in its place.

use glam::DVec3;
use rayon::prelude::*;

use super::nearest::{Part, parts_of_bones};
use super::opening::{Opening, nothing_goes_through};
use super::{LEAF_REACH, Misplacement, Outcome};
use crate::control::{Cancel, Cancelled};
use crate::geometry::closest_point::{ClosestPoint, closest_on_segment, ray_triangle};
use crate::geometry::cover::cover;
use crate::input::skeleton::BoneGraph;

/// Points of the body that are looked at, in all and at the least and the most for one bone.
const SAMPLES: usize = 1024;
const FEWEST: usize = 16;
const MOST: usize = 64;
/// A point is outside where the garment covers it less than this, and inside where it covers it more than that.
const OUTSIDE: f64 = 0.35;
const INSIDE: f64 = 0.85;
/// An end of a limb is shut up where this share is of what was outside, beyond the middle of its last bone and in the last
/// quarter of that.
const SHUT_UP: f64 = 0.8;
/// The part of the body around a bone is beside the garment where this share is of what was inside.
const BESIDE: f64 = 0.9;
/// A limb may go through an opening that is longer around than this share of its last bone: a cuff, and no buttonhole.
const WIDE: f64 = 0.3;
/// What was outside, or inside, is judged from so many points on, and where it is this share of the part: a cuff may cover a
/// little more or less.
const JUDGED: usize = 6;
const LEAST: f64 = 0.4;

/// A point of the body's surface.
struct Sample {
    triangle: u32,
    parameter: f64,
    /// How much the garment covers it, in the design and now.
    cover: [f64; 2],
}

impl Sample {
    fn is_outside(&self, in_result: usize) -> bool {
        self.cover[in_result] < OUTSIDE
    }

    fn is_inside(&self, in_result: usize) -> bool {
        self.cover[in_result] > INSIDE
    }
}

/// The limbs that are elsewhere than in the design; `graph` is that of the skeletons.
pub(super) fn misplaced(
    outcome: &Outcome<'_>,
    graph: &BoneGraph,
    openings: &[Opening],
    cancel: &Cancel,
) -> Result<Vec<Misplacement>, Cancelled> {
    let trees = [outcome.design, outcome.result].map(ClosestPoint::new);
    let segments = outcome.source.lengthened(LEAF_REACH);
    let mut found = Vec::new();
    for (bone, parts) in (0u32..).zip(parts_of_bones(outcome.body, outcome.target, graph)) {
        cancel.check()?;
        let samples = samples(bone, &parts, outcome, &trees);
        let [first, last] = outcome.source.bones[bone as usize].map(|j| graph.is_leaf(j));
        // Along the bone towards the end, which has parameter 1 there.
        let ends = [(last, 1.0, 0.0), (first, -1.0, 1.0)].into_iter().filter(|(is_end, ..)| *is_end);
        let ends = ends.filter(|_| {
            !leaves_through_cloth(bone, &segments, outcome, graph)
                || is_beside_empty_opening(bone, &segments, outcome, graph, openings)
        });
        found.extend(ends.filter_map(|(_, sign, offset)| shut_up(bone, &samples, |s| sign * s + offset)));
        let inner = || samples.iter().filter(|s| (0.0..=1.0).contains(&s.parameter));
        let beside = share_of(inner(), |s| s.is_inside(0), |s| s.is_outside(1));
        if let Some((triangle, share)) = beside.filter(|(_, share)| *share >= BESIDE) {
            found.push(Misplacement::Beside { bone, triangle, share });
        }
    }
    Ok(found)
}

/// Whether an opening of the design is where the limb ends, though the bone passes beside it, and nothing goes through it in the
/// result: the cuff of a sleeve whose skeleton is in another pose.
fn is_beside_empty_opening(
    bone: u32,
    segments: &[[DVec3; 2]],
    outcome: &Outcome<'_>,
    graph: &BoneGraph,
    openings: &[Opening],
) -> bool {
    let of_limb: Vec<u32> =
        outcome.source.bones[bone as usize].iter().flat_map(|&j| graph.bones_at(j)).copied().collect();
    let distance = |p: DVec3, &bone: &u32| {
        let [a, b] = segments[bone as usize];
        p.distance_squared(closest_on_segment(p, a, b - a))
    };
    openings.iter().any(|opening| {
        let disc = opening.disc(outcome.design);
        let nearest =
            (0..segments.len() as u32).min_by(|a, b| distance(disc.middle, a).total_cmp(&distance(disc.middle, b)));
        nearest.is_some_and(|nearest| of_limb.contains(&nearest))
            && disc.length > WIDE * outcome.source.point_at(bone, 0.0).distance(outcome.source.point_at(bone, 1.0))
            && nothing_goes_through(opening, outcome)
    })
}

/// Whether the last bone of a limb, with what goes on beyond it, or a bone that it hangs on passes through the cloth of the
/// design. Then the end is outside by mistake, as that of a foot bone through the sole, and belongs inside.
fn leaves_through_cloth(bone: u32, segments: &[[DVec3; 2]], outcome: &Outcome<'_>, graph: &BoneGraph) -> bool {
    let design = outcome.design;
    let passes = |&bone: &u32| {
        let [a, b] = segments[bone as usize];
        let meets = |t: u32| ray_triangle(a, b - a, &design.corners(t)).is_some_and(|along| along <= 1.0);
        (0..design.triangles.len() as u32).into_par_iter().any(meets)
    };
    outcome.source.bones[bone as usize].iter().flat_map(|&joint| graph.bones_at(joint)).any(passes)
}

/// The end of the limb where `along` is 1, if it is shut up.
fn shut_up(bone: u32, samples: &[Sample], along: impl Fn(f64) -> f64) -> Option<Misplacement> {
    let mut end: Vec<&Sample> = samples.iter().filter(|s| along(s.parameter) > 0.5).collect();
    end.sort_by(|a, b| along(b.parameter).total_cmp(&along(a.parameter)));
    let tip = &end[..end.len().div_ceil(4)];
    let is_shut_up = |part: &[&Sample]| share_of(part.iter().copied(), |s| s.is_outside(0), |s| s.is_inside(1));
    let ((triangle, share), (_, of_tip)) = (is_shut_up(&end)?, is_shut_up(tip)?);
    (share.min(of_tip) >= SHUT_UP).then_some(Misplacement::Inside { bone, triangle, share })
}

/// Of the `samples` that were one thing, the share that is another now, and the triangle of the first of these. None where that
/// is none, or where too few were the one to tell by.
fn share_of<'a>(
    samples: impl Iterator<Item = &'a Sample>,
    was: impl Fn(&Sample) -> bool,
    is: impl Fn(&Sample) -> bool,
) -> Option<(u32, f64)> {
    let all: Vec<&Sample> = samples.collect();
    let judged: Vec<&&Sample> = all.iter().filter(|s| was(s)).collect();
    let changed = || judged.iter().filter(|s| is(s));
    let first = changed().next()?.triangle;
    let enough = judged.len() >= JUDGED && judged.len() as f64 >= LEAST * all.len() as f64;
    enough.then(|| (first, changed().count() as f64 / judged.len() as f64))
}

/// Points of the parts at a bone, each for an equal share of their area.
fn samples(bone: u32, parts: &[Part], outcome: &Outcome<'_>, trees: &[ClosestPoint; 2]) -> Vec<Sample> {
    let count = (SAMPLES / outcome.source.bones.len()).clamp(FEWEST, MOST);
    let whole: f64 = parts.iter().map(|part| part.area).sum();
    // Along the bone, so that each stretch of it has its share.
    let mut order: Vec<&Part> = parts.iter().collect();
    order.sort_by(|a, b| a.parameter.total_cmp(&b.parameter).then(a.triangle.cmp(&b.triangle)));
    let (mut sum, mut taken) = (0.0, Vec::new());
    for part in order {
        sum += part.area;
        // Halves, so that the first and the last stand for as much as the others.
        while taken.len() < count && sum * count as f64 >= (taken.len() as f64 + 0.5) * whole && whole > 0.0 {
            taken.push(part);
        }
    }
    let sample = |&&Part { triangle, parameter, .. }: &&Part| {
        let on_body = outcome.body.centre(triangle);
        let on_source = outcome.source.point_at(bone, parameter);
        let in_design = cover(&trees[0], on_source);
        // What is neither inside nor outside in the design is not asked about the result.
        let is_asked = !(OUTSIDE..=INSIDE).contains(&in_design);
        let in_result = if is_asked { cover(&trees[1], on_body) } else { in_design };
        Sample { triangle, parameter, cover: [in_design, in_result] }
    };
    taken.par_iter().map(sample).collect()
}
