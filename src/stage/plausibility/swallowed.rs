//! Parts of the body without a bone of their own that are shut up in the garment: horns, tails, wings.
//!
//! Of such a part nothing says where it should be; but the garment of the design has no room for it. Around each bone the
//! garment reaches so far at most, in whatever direction, and a body of another girth widens all of it: so distances are compared
//! beside the median distance of the same cloth. What reaches much farther than that, and has cloth beyond it, is pressed under
//! the cloth. What is worn on such a part by design, as a shoe on a foot or a skirt over a tail, reaches as far in the design.

use super::nearest::{Part, parts_of_bones};
use super::{Misplacement, Outcome};
use crate::control::{Cancel, Cancelled};
use crate::geometry::closest_point::ClosestPoint;
use crate::geometry::cover::cover_towards;
use crate::geometry::mesh::label_pieces;
use crate::geometry::quantile::quantile;
use crate::input::skeleton::BoneGraph;
use crate::input::weld::weld_vertices;

/// What reaches so many times farther than the garment of the design is looked at.
const FARTHER: f64 = 1.5;
/// A part is told where a tenth of what of it is under cloth reaches so many times farther; the thick tail of an animal, which
/// widens what is worn over it, reaches 3.5 times.
const TOLD: f64 = 3.7;
/// It is told from this area under cloth on, as of a lock of hair, and is gross from that of a short tail on.
const AREAS: [f64; 2] = [0.0025, 0.01];
/// How far along the bone the garment's reach counts, in lengths of the bone, and into how many stretches it is divided for that.
const WINDOW: f64 = 0.2;
const STRETCHES: usize = 64;
/// Cloth is beyond a point where it is in this share of the directions away from the bone.
const COVERED: f64 = 0.75;
/// Points of one part that are looked at.
const SAMPLES: usize = 200;

/// A triangle of the body that reaches farther than the garment of the design.
struct Far {
    bone: u32,
    triangle: u32,
    area: f64,
    parameter: f64,
    times: f64,
}

/// The parts that are shut up in the garment; `graph` is that of the skeletons.
pub(super) fn swallowed(
    outcome: &Outcome<'_>,
    graph: &BoneGraph,
    cancel: &Cancel,
) -> Result<Vec<Misplacement>, Cancelled> {
    let far = far(outcome, graph);
    if far.is_empty() {
        return Ok(Vec::new());
    }
    cancel.check()?;
    let (to_welded, places) = weld_vertices(outcome.body);
    let corners = |t: u32| outcome.body.triangles[t as usize].map(|v| to_welded[v as usize]);
    let links = far.iter().map(|far| corners(far.triangle)).flat_map(|[a, b, c]| [[a, b], [b, c]]);
    let (labels, count) = label_pieces(places.len(), links);
    let mut parts: Vec<Vec<&Far>> = vec![Vec::new(); count];
    far.iter().for_each(|far| parts[labels[corners(far.triangle)[0] as usize] as usize].push(far));
    let cloth = ClosestPoint::new(outcome.result);
    let mut found = Vec::new();
    for part in parts {
        cancel.check()?;
        found.extend(judged(&part, outcome, &cloth));
    }
    Ok(found)
}

/// What is said of a part.
fn judged(part: &[&Far], outcome: &Outcome<'_>, cloth: &ClosestPoint) -> Option<Misplacement> {
    let area: f64 = part.iter().map(|far| far.area).sum();
    if area < AREAS[0] {
        return None;
    }
    let every = part.len().div_ceil(SAMPLES);
    let is_covered = |far: &&&Far| {
        let middle = outcome.body.centre(far.triangle);
        let away = middle - outcome.target.point_at(far.bone, far.parameter);
        cover_towards(cloth, middle, away.normalize_or_zero()) > COVERED
    };
    let looked: Vec<&&Far> = part.iter().step_by(every).collect();
    let mut covered: Vec<&&Far> = looked.iter().copied().filter(is_covered).collect();
    let sum = |all: &[&&Far]| all.iter().map(|far| far.area).sum::<f64>();
    let under = area * sum(&covered) / sum(&looked);
    covered.sort_by(|a, b| b.times.total_cmp(&a.times).then(a.triangle.cmp(&b.triangle)));
    let tenth = *covered.get(covered.len() / 10)?;
    if tenth.times < TOLD || under < AREAS[0] {
        return None;
    }
    let is_gross = under >= AREAS[1];
    Some(Misplacement::Swallowed { bone: tenth.bone, triangle: tenth.triangle, times: tenth.times, is_gross })
}

/// The triangles of the body that reach farther from their bones than the garment does there in the design.
fn far(outcome: &Outcome<'_>, graph: &BoneGraph) -> Vec<Far> {
    let Outcome { design, result, source, target, body, collision_only, .. } = *outcome;
    let cloth = parts_of_bones(design, source, graph);
    let flesh = parts_of_bones(body, target, graph);
    let mut all = Vec::new();
    for (bone, (cloth, flesh)) in (0u32..).zip(cloth.into_iter().zip(flesh)) {
        let in_result = |part: &Part| {
            let middle = result.centre(part.triangle);
            middle.distance(target.point_at(bone, graph.project(target, bone, middle)))
        };
        let median = |distance: &dyn Fn(&Part) -> f64| {
            quantile(cloth.iter().map(|part| (distance(part), part.area)).collect(), 0.5).unwrap_or(0.0)
        };
        let (designed, now) = (median(&|part| part.distance), median(&in_result));
        if designed <= 0.0 || now <= 0.0 {
            continue;
        }
        // Beyond the cloth, such as beside a vest's armhole, that at its end counts.
        let parameters = || cloth.iter().map(|part| part.parameter);
        let (first, last) =
            (parameters().fold(f64::INFINITY, f64::min), parameters().fold(f64::NEG_INFINITY, f64::max));
        let stretch = |parameter: f64| {
            let share = (parameter.clamp(first, last) - first) / (last - first).max(f64::MIN_POSITIVE);
            ((share * STRETCHES as f64) as usize).min(STRETCHES - 1)
        };
        let mut farthest = [0.0; STRETCHES];
        for part in &cloth {
            let farthest: &mut f64 = &mut farthest[stretch(part.parameter)];
            *farthest = farthest.max(part.distance);
        }
        let room = |parameter: f64| {
            let parameter = parameter.clamp(first, last);
            let near = &farthest[stretch(parameter - WINDOW)..=stretch(parameter + WINDOW)];
            near.iter().copied().fold(0.0, f64::max)
        };
        for Part { triangle, area, parameter, distance } in flesh {
            let (room, reach) = (room(parameter) / designed, distance / now);
            if room > 0.0 && reach > FARTHER * room && collision_only.binary_search(&triangle).is_err() {
                all.push(Far { bone, triangle, area, parameter, times: reach / room });
            }
        }
    }
    all
}
