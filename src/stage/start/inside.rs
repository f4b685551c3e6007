//! What the bones of the design lie inside of, so that a repair of the start leads none of them out.
//!
//! A bone that passes through the sole of a shoe can be kept clear of it inside or beside. Both keep the guarantee, but beside
//! the shoe the avatar grows beside it too. So what each piece of the garment encloses must be the same before and after, but
//! for bones that are retracted whole.

use glam::DVec3;

use super::bent_skeleton::BentSkeleton;
use super::enclosure::{Enclosure, Enclosures, enclosed_share_of_area, surrounded};
use crate::geometry::mesh::{NO_PIECE, TriangleMesh};
use crate::geometry::section::{Gap, Section};

/// A bone that keeps less than this share of its length is retracted whole, and lies in its joint.
const LEAST_LENGTH: f64 = 0.05;

/// A piece of the garment that was around a bone, and the bone.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Lost {
    /// The piece, as in [`Enclosures::pieces`].
    pub piece: u32,
    /// The bone.
    pub bone: u32,
}

/// Which pieces of a garment are around which bones, as it was designed.
pub struct Design<'a> {
    garment: &'a TriangleMesh,
    /// The bones, each as far as there is anything on it.
    bones: Vec<[DVec3; 2]>,
    enclosures: Enclosures,
    /// Each piece by itself.
    pieces: Vec<TriangleMesh>,
    /// The first triangle of each piece.
    first: Vec<u32>,
}

impl<'a> Design<'a> {
    /// What `garment` encloses of `bones`, each as far as there is anything on it.
    pub fn new(garment: &'a TriangleMesh, bones: Vec<[DVec3; 2]>) -> Self {
        let enclosures = Enclosures::find(garment, &bones);
        let mut own = vec![Vec::new(); enclosures.pieces.len()];
        let mut first = vec![u32::MAX; own.len()];
        for (k, t) in (0u32..).zip(&garment.triangles) {
            let piece = enclosures.piece_of[t[0] as usize];
            if piece != NO_PIECE {
                own[piece as usize].push(t.map(|v| garment.positions[v as usize]));
                first[piece as usize] = first[piece as usize].min(k);
            }
        }
        let pieces = own.into_iter().map(TriangleMesh::from_corners).collect();
        Self { garment, bones, enclosures, pieces, first }
    }

    /// The share of the garment's area that is around the nearest bone.
    pub fn share(&self) -> f64 {
        enclosed_share_of_area(self.garment, &self.bones)
    }

    /// The pairs of piece and bone of which `bent`, with the `extents` of the source's bones, has led the bone out of the piece.
    pub fn lost(&self, bent: &BentSkeleton, extents: &[[f64; 2]]) -> Vec<Lost> {
        let parts = bent.segments(extents);
        let now = Enclosures::find(self.garment, &parts);
        let mut lost = Vec::new();
        for (piece, (before, now)) in (0u32..).zip(self.enclosures.pieces.iter().zip(&now.pieces)) {
            for &bone in &before.segments {
                let of_bone = |&part: &u32| bent.bone_of(part) == bone;
                if now.segments.iter().any(of_bone) {
                    continue;
                }
                let own: Vec<[DVec3; 2]> = (0..parts.len() as u32).filter(of_bone).map(|k| parts[k as usize]).collect();
                let length: f64 = own.iter().map(|[a, b]| a.distance(*b)).sum();
                let [a, b] = self.bones[bone as usize];
                if length >= LEAST_LENGTH * a.distance(b) && !self.surrounds(piece, &own) {
                    lost.push(Lost { piece, bone });
                }
            }
        }
        lost
    }

    fn surrounds(&self, piece: u32, segments: &[[DVec3; 2]]) -> bool {
        let mesh = &self.pieces[piece as usize];
        surrounded(&mesh.positions, mesh.triangles.clone(), segments, Gap::Half).encloses
    }

    /// All that pieces are around of the bones that are marked.
    pub fn around(&self, bones: &[bool]) -> Vec<Lost> {
        let of = |(piece, enclosure): (u32, &Enclosure)| -> Vec<Lost> {
            let marked = enclosure.segments.iter().filter(|&&bone| bones[bone as usize]);
            marked.map(|&bone| Lost { piece, bone }).collect()
        };
        (0..).zip(&self.enclosures.pieces).flat_map(of).collect()
    }

    /// Of what is `lost`, the first of each piece that was around bones and is around none of them now.
    pub fn emptied(&self, lost: &[Lost]) -> Vec<Lost> {
        let all = |l: &&Lost| {
            let of_piece = lost.iter().filter(|other| other.piece == l.piece).count();
            of_piece == self.enclosures.pieces[l.piece as usize].segments.len()
        };
        let mut emptied: Vec<Lost> = lost.iter().filter(all).copied().collect();
        emptied.dedup_by_key(|l| l.piece);
        emptied
    }

    /// What each bone must stay inside of so that nothing of `lost` is.
    pub fn keep(&self, lost: &[Lost]) -> Vec<Option<Inside<'_>>> {
        let mut kept: Vec<Option<Inside>> = self.bones.iter().map(|_| None).collect();
        for &Lost { piece, bone } in lost {
            let inside = kept[bone as usize].get_or_insert_with(|| Inside { pieces: Vec::new() });
            inside.pieces.push(&self.pieces[piece as usize]);
        }
        kept
    }

    /// The first triangle of a piece.
    pub fn triangle(&self, piece: u32) -> u32 {
        self.first[piece as usize]
    }

    /// The diagonal of a piece's bounding box.
    pub fn size(&self, piece: u32) -> f64 {
        let points = || self.pieces[piece as usize].positions.iter().copied();
        points().fold(DVec3::INFINITY, DVec3::min).distance(points().fold(DVec3::NEG_INFINITY, DVec3::max))
    }
}

/// Pieces that a bone must stay inside of.
pub struct Inside<'a> {
    pieces: Vec<&'a TriangleMesh>,
}

impl Inside<'_> {
    /// Which of the points at `offsets` from `base`, across `along`, may be used: those that all pieces enclose that enclose
    /// `base`; where none does, those that any piece encloses. All, where that would leave none.
    pub fn at(&self, base: DVec3, along: DVec3, offsets: &[DVec3]) -> Vec<bool> {
        let sections: Vec<Section> = self.pieces.iter().map(|piece| Section::cut(piece, base, along)).collect();
        let around: Vec<&Section> = sections.iter().filter(|section| section.encloses(base)).collect();
        let may = |&offset: &DVec3| {
            let p = base + offset;
            if around.is_empty() {
                sections.iter().any(|section| section.encloses(p))
            } else {
                around.iter().all(|section| section.encloses(p))
            }
        };
        let allowed: Vec<bool> = offsets.iter().map(may).collect();
        if allowed.contains(&true) { allowed } else { vec![true; offsets.len()] }
    }
}
