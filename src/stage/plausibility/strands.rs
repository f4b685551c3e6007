//! Loose sheets of the body, such as strands of hair, that begin outside of the garment and end under it.
//!
//! They stick out of nothing, so that there is room for them under the cloth; but hair hangs over a shirt. A sheet is flat and open,
//! on one side of its bones, and hangs where a limb ends, as at the head: what a hat covers lies there as well, and is no hair under
//! a shirt.

use glam::DVec3;

use super::{Misplacement, Outcome};
use crate::control::{Cancel, Cancelled};
use crate::geometry::border_edges::border_edges;
use crate::geometry::closest_point::ClosestPoint;
use crate::geometry::cover::cover_towards;
use crate::geometry::mesh::{TriangleMesh, triangle_area};
use crate::geometry::piece::Piece;
use crate::input::skeleton::BoneGraph;
use crate::input::weld::weld_vertices;

/// A sheet has a border so long that its square is so many times the area: a square has 16, a bust cut off at the chest 1.
const FLAT: f64 = 10.0;
/// It is on one side of its bones where the mean of the directions to it is so long: all around it would be none.
const ONE_SIDE: f64 = 0.35;
/// A triangle is under the cloth where this is in so much of the directions away from the bone, and outside where it is in less than
/// the other.
const COVERED: f64 = 0.75;
const OUTSIDE: f64 = 0.25;
/// So much of the area of a sheet is outside, and under the cloth.
const LEAST: f64 = 0.1;
/// Sheets are told from this area under cloth on, as of a lock of hair.
const LEAST_AREA: f64 = 0.0025;
/// Triangles of one sheet that are looked at, and sheets, the largest.
const SAMPLES: usize = 60;
const SHEETS: usize = 256;

/// The sheets that end under the garment, as one finding; `graph` is that of the skeletons.
pub(super) fn strands(
    outcome: &Outcome<'_>,
    graph: &BoneGraph,
    cancel: &Cancel,
) -> Result<Option<Misplacement>, Cancelled> {
    let sheets = sheets(outcome);
    if sheets.is_empty() {
        return Ok(None);
    }
    let cloth = ClosestPoint::new(outcome.result);
    let (mut whole, mut under, mut largest) = (0.0, 0.0, None);
    for sheet in &sheets {
        cancel.check()?;
        let Some(found) = hidden(sheet, outcome, graph, &cloth) else { continue };
        whole += sheet.area;
        under += found.area;
        if largest.as_ref().is_none_or(|largest: &Hidden| largest.area < found.area) {
            largest = Some(found);
        }
    }
    let told = largest.filter(|_| under >= LEAST_AREA);
    Ok(told.map(|Hidden { bone, triangle, .. }| Misplacement::Under { bone, triangle, share: under / whole }))
}

/// The flat and open pieces of the body, without what the garment is not meant to fit, the largest first.
fn sheets(outcome: &Outcome<'_>) -> Vec<Piece> {
    let Outcome { body, collision_only, .. } = *outcome;
    let (to_welded, lowest) = weld_vertices(body);
    let corners = |t: &[u32; 3]| t.map(|v| lowest[to_welded[v as usize] as usize]);
    // Both sides of a strand may be modelled.
    let mut kept: Vec<([u32; 3], u32)> = Vec::new();
    for (k, t) in (0u32..).zip(&body.triangles) {
        let mut sorted = corners(t);
        sorted.sort_unstable();
        if sorted[0] != sorted[1] && sorted[1] != sorted[2] && collision_only.binary_search(&k).is_err() {
            kept.push((sorted, k));
        }
    }
    kept.sort_unstable();
    kept.dedup_by_key(|(sorted, _)| *sorted);
    kept.sort_unstable_by_key(|&(_, k)| k);
    let welded: Vec<[u32; 3]> = kept.iter().map(|&(_, k)| corners(&body.triangles[k as usize])).collect();
    let mut pieces = Piece::find(&body.positions, &welded, []);
    let mut piece_of = vec![0; welded.len()];
    for (p, piece) in pieces.iter().enumerate() {
        piece.triangles.iter().for_each(|&t| piece_of[t as usize] = p);
    }
    let mut borders = vec![0.0; pieces.len()];
    for edge in border_edges(&welded) {
        let [a, b] = edge.ends.map(|v| body.positions[v as usize]);
        borders[piece_of[edge.triangle as usize]] += a.distance(b);
    }
    for piece in &mut pieces {
        piece.triangles.iter_mut().for_each(|t| *t = kept[*t as usize].1);
    }
    let all: f64 = pieces.iter().map(|piece| piece.area).sum();
    let mut sheets: Vec<Piece> = pieces
        .into_iter()
        .zip(borders)
        .filter(|(piece, border)| border * border > FLAT * piece.area && piece.area < 0.5 * all)
        .map(|(piece, _)| piece)
        .collect();
    sheets.sort_by(|a, b| b.area.total_cmp(&a.area).then(a.triangles[0].cmp(&b.triangles[0])));
    sheets.truncate(SHEETS);
    sheets
}

/// What of a sheet is under the cloth.
struct Hidden {
    bone: u32,
    triangle: u32,
    area: f64,
}

/// What of a sheet is under the cloth at other bones than those at which it begins; none where it does not begin outside of the garment
/// at the end of a limb.
fn hidden(sheet: &Piece, outcome: &Outcome<'_>, graph: &BoneGraph, cloth: &ClosestPoint) -> Option<Hidden> {
    let Outcome { target, body, .. } = *outcome;
    let every = sheet.triangles.len().div_ceil(SAMPLES);
    let is_at_end = |bone: u32| target.bones[bone as usize].iter().any(|&joint| graph.is_leaf(joint));
    let (mut looked, mut outside, mut sum) = (0.0, 0.0, DVec3::ZERO);
    let mut under: Vec<(f64, u32, u32)> = Vec::new();
    for &t in sheet.triangles.iter().step_by(every) {
        let middle = body.centre(t);
        let at = |bone: u32| target.point_at(bone, graph.project(target, bone, middle));
        let bones = 0..target.bones.len() as u32;
        let bone = bones.min_by(|&a, &b| at(a).distance_squared(middle).total_cmp(&at(b).distance_squared(middle)))?;
        let away = (middle - at(bone)).normalize_or_zero();
        let area = area(body, t);
        looked += area;
        sum += area * away;
        let covered = cover_towards(cloth, middle, away);
        if covered > COVERED && !is_at_end(bone) {
            under.push((area, bone, t));
        } else if covered < OUTSIDE && is_at_end(bone) {
            outside += area;
        }
    }
    let hidden: f64 = under.iter().map(|(area, ..)| area).sum();
    let &(_, bone, triangle) = under.last()?;
    let is_told = sum.length() > ONE_SIDE * looked && outside > LEAST * looked && hidden > LEAST * looked;
    is_told.then(|| Hidden { bone, triangle, area: sheet.area * hidden / looked })
}

fn area(mesh: &TriangleMesh, triangle: u32) -> f64 {
    triangle_area(mesh.corners(triangle))
}
