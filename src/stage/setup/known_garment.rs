//! What follows from a garment and the body that it was designed on, whatever the target: once for all targets and all that is
//! tried on one.

use std::sync::Arc;

use glam::DVec3;

use super::carried_pieces::{self, CarriedPiece, Found};
use super::closed_pieces;
use super::hanging_pieces::HangingPieces;
use super::loose_pieces::LoosePieces;
use super::shape::{Curves, Outline};
use super::source_body::SourceBody;
use crate::control::Cancel;
use crate::energy::attachment::SizeHold;
use crate::error::Result;
use crate::input::skeleton::Skeleton;
use crate::memo::{Memo, MeshBits, PointBits};
use crate::stage::start::enclosure;
use crate::verify::intersections_with_cancel;
/// Values of a kind that are kept: a garment has one skeleton, but where joints are mended or bones retreat for a target.
const MOST: usize = 8;

/// What is known of a garment and its body. Each is looked up by all that it is computed from, so that it does not matter whether
/// it was known.
pub struct KnownGarment {
    intersections: Memo<MeshBits, Vec<[u32; 2]>>,
    pieces: Memo<Around, Pieces>,
    curves: Memo<(MeshBits, SkeletonBits, Vec<bool>), Curves>,
    distances: Memo<(MeshBits, PointBits), Vec<f64>>,
}

/// What the pieces of a garment are found by: the garment, the bones as far as there is anything on them, the skeleton and the body
/// that it was designed on.
#[derive(PartialEq)]
struct Around {
    garment: MeshBits,
    segments: PointBits,
    source: SkeletonBits,
    body: Option<MeshBits>,
}

#[derive(PartialEq)]
struct SkeletonBits {
    joints: PointBits,
    bones: Vec<[u32; 2]>,
}

/// The pieces of a garment that have their place from something else than the bones inside of them.
pub struct Pieces {
    /// Those that are held to others, and those that hang on others.
    pub loose: LoosePieces,
    /// What keeps the size of those that are near nothing.
    pub sizes: Vec<SizeHold>,
    /// Those that are around no bone.
    pub carried: Vec<CarriedPiece>,
    /// They are not all of the garment, and the rest is around no bone either.
    pub is_beside: bool,
}

impl Default for KnownGarment {
    fn default() -> Self {
        Self {
            intersections: Memo::new(MOST),
            pieces: Memo::new(MOST),
            curves: Memo::new(MOST),
            distances: Memo::new(MOST),
        }
    }
}

impl KnownGarment {
    /// The pairs of triangles of `garment` that intersect.
    ///
    /// # Errors
    /// `Cancelled`.
    pub(super) fn intersections(&self, garment: &MeshBits, cancel: &Cancel) -> Result<Arc<Vec<[u32; 2]>>> {
        let find = || Ok(intersections_with_cancel(&garment.0, None, usize::MAX, cancel)?.pairs);
        self.intersections.get(garment.clone(), cancel, find)
    }

    /// The pieces of `garment` around `source`, of which `segments` have something on them. `body` is what it was designed on.
    ///
    /// # Errors
    /// `Cancelled`.
    pub(super) fn pieces(
        &self,
        garment: &MeshBits,
        segments: &[[DVec3; 2]],
        source: &Skeleton,
        body: Option<&SourceBody>,
        cancel: &Cancel,
    ) -> Result<Arc<Pieces>> {
        let key = Around {
            garment: garment.clone(),
            segments: PointBits(segments.iter().flatten().copied().collect()),
            source: SkeletonBits::of(source),
            body: body.map(|body| body.mesh.clone()),
        };
        let find = || {
            let garment = &*garment.0;
            let surface = body.map(|body| &body.surface);
            let mut loose = LoosePieces::find(&garment.positions, &garment.triangles);
            let hanging = HangingPieces::find(&garment.positions, &garment.triangles, source, &loose);
            loose.holds.extend(hanging.holds);
            loose.hanging = hanging.pieces;
            let Found { mut carried, is_worn } = carried_pieces::find(garment, &loose, segments, source, surface);
            carried.extend(closed_pieces::find(garment, &loose, &carried, source, surface));
            let is_beside =
                !is_worn && !carried_pieces::is_whole(garment, &carried) && !enclosure::encloses(garment, segments);
            Ok(Pieces { loose, sizes: hanging.sizes, carried, is_beside })
        };
        self.pieces.get(key, cancel, find)
    }

    /// The curves of `garment`, whose connectivity is `outline`, around `source`.
    ///
    /// # Errors
    /// `Cancelled`.
    pub(super) fn curves(
        &self,
        garment: &MeshBits,
        outline: &Outline,
        source: &Skeleton,
        cancel: &Cancel,
    ) -> Result<Arc<Curves>> {
        let key = (garment.clone(), SkeletonBits::of(source), outline.is_held.clone());
        self.curves.get(key, cancel, || Ok(Curves::find(&garment.0, outline, source)))
    }

    /// The signed distances of `points` from `body`.
    ///
    /// # Errors
    /// `Cancelled`.
    pub(in crate::stage) fn distances(
        &self,
        body: &SourceBody,
        points: Vec<DVec3>,
        cancel: &Cancel,
    ) -> Result<Arc<Vec<f64>>> {
        let find = || Ok(body.signed_distances(&points));
        self.distances.get((body.mesh.clone(), PointBits(points.clone())), cancel, find)
    }
}

impl SkeletonBits {
    fn of(skeleton: &Skeleton) -> Self {
        Self { joints: PointBits(skeleton.joints.clone()), bones: skeleton.bones.clone() }
    }
}
