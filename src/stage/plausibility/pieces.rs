//! Pieces of the garment whose size is far from what it should be.
//!
//! A piece around a bone has the size of the body there, whatever that is. One that is around none, such as a pouch, hangs on
//! what is near it and should have become larger or smaller as that has.

use glam::DVec3;

use super::opening::Opening;
use super::{Outcome, Resized};
use crate::geometry::mesh::{NO_PIECE, TriangleMesh, label_pieces};

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

#[derive(Clone, Copy, Default)]
struct Piece {
    first: u32,
    triangles: usize,
    /// Of the design and of the result.
    area: [f64; 2],
    low: DVec3,
    high: DVec3,
    is_around_bone: bool,
}

impl Piece {
    /// By what factor it became larger.
    fn scale(&self) -> f64 {
        (self.area[1] / self.area[0]).sqrt()
    }
}

/// The pieces whose size is far from what it should be, in the order of their lowest vertices.
pub(super) fn resized(outcome: &Outcome<'_>, openings: &[Opening]) -> Vec<Resized> {
    let (labels, pieces) = pieces(outcome, openings);
    let areas = [outcome.design, outcome.result].map(|mesh| mesh.areas());
    let whole: f64 = pieces.iter().map(|piece| piece.area[0]).sum();
    let least = least_judged(&pieces);
    let mut seen = 0.0;
    let mut found = Vec::new();
    for (label, piece) in (0u32..).zip(&pieces).filter(|(_, piece)| piece.area[0] > 0.0 && piece.area[0] >= least) {
        let scale = piece.scale();
        let (scale, reported, gross) = if piece.is_around_bone {
            (scale, GROSS_AROUND_BONE, GROSS_AROUND_BONE)
        } else {
            (scale / scale_beside(outcome.design, &areas, label, piece, &labels), REPORTED, GROSS)
        };
        let is_beyond = |factor: f64| scale.max(scale.recip()) > factor;
        if is_beyond(reported) {
            seen += if is_beyond(gross) { piece.area[0] } else { 0.0 };
            found.push(Resized {
                triangle: piece.first,
                triangles: piece.triangles,
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

/// The piece of each vertex, and the pieces.
fn pieces(outcome: &Outcome<'_>, openings: &[Opening]) -> (Vec<u32>, Vec<Piece>) {
    let triangles = &outcome.design.triangles;
    let links = triangles.iter().flat_map(|&[a, b, c]| [[a, b], [b, c]]);
    let (labels, count) = label_pieces(outcome.design.positions.len(), links);
    let mut pieces = vec![Piece { low: DVec3::INFINITY, high: DVec3::NEG_INFINITY, ..Piece::default() }; count];
    let areas = [outcome.design.areas(), outcome.result.areas()];
    for (t, corners) in triangles.iter().enumerate() {
        let piece = &mut pieces[labels[corners[0] as usize] as usize];
        if piece.triangles == 0 {
            piece.first = t as u32;
        }
        piece.triangles += 1;
        (0..2).for_each(|k| piece.area[k] += areas[k][t]);
    }
    for (&p, &label) in outcome.design.positions.iter().zip(&labels).filter(|(_, label)| **label != NO_PIECE) {
        let piece = &mut pieces[label as usize];
        (piece.low, piece.high) = (piece.low.min(p), piece.high.max(p));
    }
    for opening in openings.iter().filter(|opening| opening.bone.is_some()) {
        pieces[labels[opening.vertices[0] as usize] as usize].is_around_bone = true;
    }
    (labels, pieces)
}

/// The area of the smallest piece that is judged.
fn least_judged(pieces: &[Piece]) -> f64 {
    let mut areas: Vec<f64> = pieces.iter().filter(|piece| !piece.is_around_bone).map(|piece| piece.area[0]).collect();
    areas.sort_by(|a, b| b.total_cmp(a));
    areas.get(JUDGED).copied().unwrap_or(0.0)
}

/// By what factor what is beside `piece` became larger; 1 where nothing is near it.
fn scale_beside(design: &TriangleMesh, areas: &[Vec<f64>; 2], label: u32, piece: &Piece, labels: &[u32]) -> f64 {
    let reach = NEIGHBOURHOOD * piece.low.distance(piece.high);
    let distance = |t: &[u32; 3]| {
        let middle = t.iter().map(|&v| design.positions[v as usize]).sum::<DVec3>() / 3.0;
        (piece.low - middle).max(middle - piece.high).max(DVec3::ZERO).length()
    };
    let mut sums = [0.0; 2];
    for (t, corners) in design.triangles.iter().enumerate() {
        if labels[corners[0] as usize] != label && distance(corners) <= reach {
            (0..2).for_each(|k| sums[k] += areas[k][t]);
        }
    }
    if sums.iter().all(|sum| *sum > 0.0) { (sums[1] / sums[0]).sqrt() } else { 1.0 }
}
