//! Which bones a garment encloses, for each of its connected pieces.
//!
//! A piece encloses bones
//! - where closed curves on it are linked with the skeleton ([`super::winding`]): belts, necklaces, sleeves, a skirt, a cape
//!   with a closed collar, at any tilt; or
//! - where planes across the bones cut it in curves that surround them by more than half a turn: a hat, a glove, a shoe,
//!   which end beyond a bone, and an open coat; or
//! - where it is flat and its own plane shows that it surrounds a bone so: an open belt, a bangle.
//!
//! The planes stand along the bones, and nothing is sampled at the garment's vertices, so that the answer does not depend on
//! how it is cut into triangles.

use glam::{DMat3, DVec3};
use rayon::prelude::*;

use super::winding::{Winding, windings};
use crate::error::{Error, ErrorKind};
use crate::geometry::closest_point::closest_on_segment;
use crate::geometry::mesh::{NO_PIECE, Topology, TriangleMesh, label_pieces, triangle_area};
use crate::geometry::section::{Gap, Section};
use crate::geometry::spread::spread;
use crate::maths;

/// Between planes along a bone, in the normalised space.
const SPACING: f64 = 0.02;
/// What planes along the bones show counts where it goes on for this share of the piece's size: its bounding box's diagonal.
const MIN_LENGTH: f64 = 0.05;
/// A piece is flat where its thickness is below this share of its lesser width.
const FLAT: f64 = 0.35;
/// Garment vertices whose nearest points on the skeleton are tested for [`enclosed_share`].
const SAMPLES: usize = 64;
/// A segment no longer than this has no plane across it.
const NO_LENGTH: f64 = 1e-9;
/// Points of the garment that are tested for [`enclosed_share_of_area`].
const AREA_SAMPLES: usize = 128;

/// What the connected pieces of a garment enclose.
#[derive(Clone, Debug, Default)]
pub struct Enclosures {
    /// The piece of each vertex: triangles that share a vertex belong to one piece. [`NO_PIECE`] for a vertex without an edge.
    pub piece_of: Vec<u32>,
    /// What each piece encloses.
    pub pieces: Vec<Enclosure>,
}

/// What a piece encloses.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Enclosure {
    /// It encloses something.
    pub encloses: bool,
    /// The segments that it encloses, ascending. Segments in a row without a branch count together where a closed curve is
    /// around them. Empty also where a piece is around a joint and no bone, as a sash is.
    pub segments: Vec<u32>,
}

impl Enclosures {
    /// What the pieces of `garment` enclose of `segments`: bones, each from joint to joint or as far as there is anything on
    /// it. Segments whose ends are equal, to the bit, meet there. Lengths are those of the normalised space. The index of a
    /// segment in the result is that in `segments`, so that with one segment a bone it is the bone's.
    pub fn find(garment: &TriangleMesh, segments: &[[DVec3; 2]]) -> Self {
        Self::find_but_for(garment, segments, Gap::Half)
    }

    /// The same with another gap that may be left around a bone.
    fn find_but_for(garment: &TriangleMesh, segments: &[[DVec3; 2]], widest: Gap) -> Self {
        let topology = Topology::new(garment.positions.len(), &garment.triangles);
        let (piece_of, count) = label_pieces(garment.positions.len(), topology.edges.iter().copied());
        let wound = windings(garment, &topology.edges, &piece_of, count, segments);
        let mut triangles = vec![Vec::new(); count];
        for t in &garment.triangles {
            if let Some(own) = triangles.get_mut(piece_of[t[0] as usize] as usize) {
                own.push(*t);
            }
        }
        let pieces = wound.into_par_iter().zip(triangles).map(|(Winding { linked, segments: wound }, own)| {
            if linked && !wound.is_empty() {
                return Enclosure { encloses: true, segments: wound };
            }
            let mut found = surrounded(&garment.positions, own, segments, widest);
            found.encloses |= linked;
            found
        });
        Self { pieces: pieces.collect(), piece_of }
    }

    /// Whether any piece encloses anything.
    pub fn any(&self) -> bool {
        self.pieces.iter().any(|piece| piece.encloses)
    }

    /// What the piece of a vertex encloses; none for a vertex without an edge.
    pub fn of(&self, vertex: u32) -> Option<&Enclosure> {
        Some(self.piece_of[vertex as usize])
            .filter(|&piece| piece != NO_PIECE)
            .map(|piece| &self.pieces[piece as usize])
    }
}

/// What is said to a garment that is around no bone: none of its pieces is, nor are all of them together.
pub fn refused() -> Error {
    Error::new(
        ErrorKind::NotEnclosed,
        "garment: it does not enclose the source skeleton and is around none of its bones; move one onto the other, and make \
         sure that both are in one coordinate system and unit",
    )
}

/// Whether any piece of `garment` encloses any of `segments`, or all of them together do.
pub fn encloses(garment: &TriangleMesh, segments: &[[DVec3; 2]]) -> bool {
    encloses_but_for(garment, segments, Gap::Half)
}

/// The same with another gap that may be left around a bone.
pub fn encloses_but_for(garment: &TriangleMesh, segments: &[[DVec3; 2]], widest: Gap) -> bool {
    Enclosures::find_but_for(garment, segments, widest).any()
        || surrounded(&garment.positions, garment.triangles.clone(), segments, widest).encloses
}

/// The segments that `triangles` surround, as planes show it: across the segments, and the piece's own where it is flat.
pub fn surrounded(positions: &[DVec3], triangles: Vec<[u32; 3]>, segments: &[[DVec3; 2]], widest: Gap) -> Enclosure {
    let piece = compact(positions, triangles);
    let low = piece.positions.iter().copied().fold(DVec3::INFINITY, DVec3::min);
    let high = piece.positions.iter().copied().fold(DVec3::NEG_INFINITY, DVec3::max);
    let (lengths, mut found) = lengths_along(&piece, segments, [low, high], widest);
    let encloses = lengths >= MIN_LENGTH * low.distance(high);
    if !encloses {
        found.fill(false);
    }
    if let Some((centre, normal)) = flat_plane(&piece) {
        let section = Section::projected(&piece, centre, normal);
        for (found, [a, b]) in found.iter_mut().zip(segments) {
            let [ha, hb] = [a, b].map(|p| (p - centre).dot(normal));
            if (ha < 0.0) != (hb < 0.0) && section.encloses_but_for(a.lerp(*b, ha / (ha - hb)), widest) {
                *found = true;
            }
        }
    }
    let segments: Vec<u32> = (0u32..).zip(&found).filter(|(_, found)| **found).map(|(k, _)| k).collect();
    Enclosure { encloses: !segments.is_empty(), segments }
}

/// `triangles` with vertices of their own.
fn compact(positions: &[DVec3], mut triangles: Vec<[u32; 3]>) -> TriangleMesh {
    let mut used: Vec<u32> = triangles.iter().flatten().copied().collect();
    used.sort_unstable();
    used.dedup();
    triangles.iter_mut().flatten().for_each(|v| *v = used.partition_point(|u| u < v) as u32);
    TriangleMesh { positions: used.iter().map(|&v| positions[v as usize]).collect(), triangles }
}

/// The length of `segments` that `piece`, whose bounding box is given, surrounds in the planes across them; and whether it
/// surrounds anything of each.
fn lengths_along(
    piece: &TriangleMesh,
    segments: &[[DVec3; 2]],
    [low, high]: [DVec3; 2],
    widest: Gap,
) -> (f64, Vec<bool>) {
    let along = |&[a, b]: &[DVec3; 2]| {
        let length = a.distance(b);
        let count = (length / SPACING).ceil().max(1.0);
        let surrounds = |k: usize| {
            let p = a.lerp(b, (k as f64 + 0.5) / count);
            // A curve that surrounds a point has it in its box, but for the part that may be open.
            let reach = DVec3::splat(0.5 * low.distance(high));
            let is_near = p.cmpge(low - reach).all() && p.cmple(high + reach).all();
            is_near && Section::cut(piece, p, b - a).encloses_but_for(p, widest)
        };
        let surrounding = (0..count as usize).into_par_iter().filter(|&k| surrounds(k)).count();
        surrounding as f64 * length / count
    };
    let lengths: Vec<f64> = segments.iter().map(along).collect();
    (lengths.iter().sum(), lengths.iter().map(|&length| length > 0.0).collect())
}

/// Centre and normal of the plane of a flat piece: that of least moment of its surface. None where it is not flat.
fn flat_plane(piece: &TriangleMesh) -> Option<(DVec3, DVec3)> {
    let parts = || {
        piece.triangles.iter().map(|t| {
            let corners = t.map(|v| piece.positions[v as usize]);
            (triangle_area(corners), corners)
        })
    };
    let area: f64 = parts().map(|(area, _)| area).sum();
    if area <= 0.0 {
        return None;
    }
    let centre = parts().map(|(area, [a, b, c])| area * (a + b + c)).sum::<DVec3>() / (3.0 * area);
    let mut moments = DMat3::ZERO;
    for (area, corners) in parts() {
        let [a, b, c] = corners.map(|p| p - centre);
        // The exact second moment of a triangle: of the midpoints of its sides.
        for m in [0.5 * (a + b), 0.5 * (b + c), 0.5 * (c + a)] {
            moments += DMat3::from_cols(m * m.x, m * m.y, m * m.z) * (area / 3.0);
        }
    }
    let axes = principal_axes(moments);
    let extent = |axis: DVec3| {
        let heights = || parts().flat_map(|(_, corners)| corners).map(|p| p.dot(axis));
        heights().fold(f64::NEG_INFINITY, f64::max) - heights().fold(f64::INFINITY, f64::min)
    };
    let mut sized = axes.map(|axis| (extent(axis), axis));
    sized.sort_by(|a, b| a.0.total_cmp(&b.0));
    (sized[0].0 <= FLAT * sized[1].0).then_some((centre, sized[0].1))
}

/// The eigenvectors of a symmetric matrix, by Jacobi's rotations.
fn principal_axes(mut m: DMat3) -> [DVec3; 3] {
    let mut axes = DMat3::IDENTITY;
    // Each sweep squares the error.
    for _ in 0..12 {
        for (p, q) in [(0, 1), (0, 2), (1, 2)] {
            let mixed = m.col(q)[p];
            if mixed == 0.0 {
                continue;
            }
            let angle = 0.5 * maths::atan2(2.0 * mixed, m.col(q)[q] - m.col(p)[p]);
            let (sine, cosine) = maths::sin_cos(angle);
            let mut turn = DMat3::IDENTITY;
            turn.col_mut(p)[p] = cosine;
            turn.col_mut(q)[q] = cosine;
            turn.col_mut(p)[q] = -sine;
            turn.col_mut(q)[p] = sine;
            m = turn.transpose() * m * turn;
            axes *= turn;
        }
    }
    [axes.x_axis, axes.y_axis, axes.z_axis]
}

/// The share of the garment for which this holds: it encloses the nearest point of `segments`, in the plane across them.
pub fn enclosed_share(garment: &TriangleMesh, segments: &[[DVec3; 2]]) -> f64 {
    let corners: Vec<u32> = garment.triangles.iter().flatten().copied().collect();
    let sampled = corners.iter().step_by(corners.len().div_ceil(SAMPLES).max(1));
    let samples: Vec<DVec3> = sampled.map(|&v| garment.positions[v as usize]).collect();
    enclosed_share_at(garment, segments, &samples, Gap::Half)
}

/// The same by area, whatever the triangles that the garment is cut into.
pub fn enclosed_share_of_area(garment: &TriangleMesh, segments: &[[DVec3; 2]]) -> f64 {
    let samples: Vec<DVec3> = spread(garment, AREA_SAMPLES).into_iter().map(|(p, _)| p).collect();
    enclosed_share_at(garment, segments, &samples, Gap::Half)
}

/// The same for `samples` in place of the garment's own points, with the gap that may be left.
pub fn enclosed_share_at(garment: &TriangleMesh, segments: &[[DVec3; 2]], samples: &[DVec3], widest: Gap) -> f64 {
    let enclosed: Vec<bool> = samples.par_iter().map(|&p| encloses_nearest(garment, segments, p, widest)).collect();
    let count = enclosed.iter().filter(|&&is_enclosed| is_enclosed).count();
    count as f64 / enclosed.len().max(1) as f64
}

fn encloses_nearest(garment: &TriangleMesh, segments: &[[DVec3; 2]], p: DVec3, widest: Gap) -> bool {
    // What is retracted to a point has no direction but that of rounding.
    let long = segments.iter().filter(|[a, b]| a.distance(*b) > NO_LENGTH);
    let candidates = long.map(|&[a, b]| {
        let point = closest_on_segment(p, a, b - a);
        (point.distance_squared(p), point, b - a)
    });
    let nearest = candidates.min_by(|a, b| a.0.total_cmp(&b.0));
    nearest.is_some_and(|(_, point, along)| Section::cut(garment, point, along).encloses_but_for(point, widest))
}
