//! Pieces of the garment whose size is far from what it should be.
//!
//! A piece around a bone has the size of the body there, whatever that is. One that is around none, such as a pouch, hangs on
//! what is near it and should have become larger or smaller as that has.

use glam::DVec3;

use super::opening::Opening;
use super::{Outcome, Resized};
use crate::geometry::mesh::TriangleMesh;
use crate::geometry::piece::Piece;

/// A piece is reported where it became larger or smaller than it should by more than this factor, and is gross beyond that.
const REPORTED: f64 = 2.0;
const GROSS: f64 = 4.0;
/// The factor for a piece around a bone, beside the skeletons: heads differ by a factor of four and more.
const GROSS_AROUND_BONE: f64 = 16.0;
/// Pieces that have less than this share of the garment's area together are not gross: nobody sees them.
const SEEN: f64 = 1e-3;
/// Pieces around no bone that are judged, the largest: it bounds the search in a garment of thousands of sequins.
const JUDGED: usize = 256;
/// Neighbours of a piece are nearer to it than this many times its own size.
const NEIGHBOURHOOD: f64 = 1.0;

/// The pieces whose size is far from what it should be, in the order of their lowest vertices.
pub(super) fn resized(outcome: &Outcome<'_>, openings: &[Opening]) -> Vec<Resized> {
    let design = outcome.design;
    let pieces = Piece::find(&design.positions, &design.triangles, []);
    let areas = [design, outcome.result].map(TriangleMesh::areas);
    let is_around_bone = around_bones(&pieces, openings);
    let whole: f64 = pieces.iter().map(|piece| piece.area).sum();
    let least = least_judged(&pieces, &is_around_bone);
    let mut seen = 0.0;
    let mut found = Vec::new();
    for (piece, around_bone) in pieces.iter().zip(is_around_bone) {
        if piece.area <= 0.0 || piece.area < least {
            continue;
        }
        let now: f64 = piece.triangles.iter().map(|&t| areas[1][t as usize]).sum();
        let scale = (now / piece.area).sqrt();
        let (scale, reported, gross) = if around_bone {
            (scale, GROSS_AROUND_BONE, GROSS_AROUND_BONE)
        } else {
            (scale / scale_beside(design, &areas, piece), REPORTED, GROSS)
        };
        let is_beyond = |factor: f64| scale.max(scale.recip()) > factor;
        if is_beyond(reported) {
            seen += if is_beyond(gross) { piece.area } else { 0.0 };
            found.push(Resized {
                triangle: piece.triangles[0],
                triangles: piece.triangles.len(),
                scale,
                is_gross: is_beyond(gross),
            });
        }
    }
    if seen < SEEN * whole {
        found.iter_mut().for_each(|piece| piece.is_gross = false);
    }
    found
}

/// For each piece whether a bone goes through an opening of it.
fn around_bones(pieces: &[Piece], openings: &[Opening]) -> Vec<bool> {
    let through = || openings.iter().filter(|opening| opening.bone.is_some()).map(|opening| opening.vertices[0]);
    pieces.iter().map(|piece| through().any(|v| piece.vertices.binary_search(&v).is_ok())).collect()
}

/// The area of the smallest piece that is judged.
fn least_judged(pieces: &[Piece], is_around_bone: &[bool]) -> f64 {
    let free = pieces.iter().zip(is_around_bone).filter(|(_, around_bone)| !**around_bone);
    let mut areas: Vec<f64> = free.map(|(piece, _)| piece.area).collect();
    areas.sort_by(|a, b| b.total_cmp(a));
    areas.get(JUDGED).copied().unwrap_or(0.0)
}

/// By what factor what is beside `piece` became larger; 1 where nothing is near it.
fn scale_beside(design: &TriangleMesh, areas: &[Vec<f64>; 2], piece: &Piece) -> f64 {
    let reach = NEIGHBOURHOOD * piece.size();
    let mut own = piece.triangles.iter().peekable();
    let mut sums = [0.0; 2];
    for t in 0..design.triangles.len() as u32 {
        if own.next_if_eq(&&t).is_some() {
            continue;
        }
        let middle = design.centre(t);
        if (piece.low - middle).max(middle - piece.high).max(DVec3::ZERO).length() <= reach {
            (0..2).for_each(|k| sums[k] += areas[k][t as usize]);
        }
    }
    if sums.iter().all(|sum| *sum > 0.0) { (sums[1] / sums[0]).sqrt() } else { 1.0 }
}
