//! Connected pieces of the avatar's file that are no part of its body: a floor, a dome, a backdrop, a thing or another
//! figure that stands beside it.
//!
//! A piece is foreign where its place and size say so, never for its looks: hair, shoes, horns, wings, armour and eyes are
//! pieces too, and so are arms that were modelled apart.

use glam::DVec3;

use crate::geometry::closest_point::{ClosestPoint, closest_on_segment};
use crate::geometry::mesh::{TriangleMesh, has_area};
use crate::geometry::piece::Piece;
use crate::geometry::section::Section;
use crate::input::diagnostic::{Diagnostic, Foreignness, Subject};
use crate::input::skeleton::Skeleton;
use crate::input::weld::weld_vertices;

/// Lengths are in units of the longest side of the skeleton's bounding box.
///
/// A piece longer than this is no limb, wing or tail, unless it is around a bone within [`AROUND`].
const HUGE: f64 = 3.0;
/// A piece that encloses a bone's middle within this distance is a body.
const AROUND: f64 = 0.25;
/// A ground is longer than this, and not thicker than the second times its length.
const GROUND: f64 = 0.5;
const FLAT: f64 = 0.05;
/// The joints rise above a ground by this, and the body sinks into it no deeper than the second.
const RISES: f64 = 0.6;
const SINKS: f64 = 0.05;
/// A detached piece is farther than this from all bones...
const FROM_BONES: f64 = 0.25;
/// ...and than this from what belongs to the body.
const FROM_BODY: f64 = 0.125;
/// How far beyond a leaf joint the body is expected, in lengths of its bone.
const LEAF_REACH: f64 = 0.5;
/// The longest side of the skeleton in diagnostics.
const SIDE: f64 = 2.0;
/// Planes that are examined for a piece that surrounds all, at most.
const MAX_PLANES: usize = 4096;

/// A connected piece that is no part of the body.
#[derive(Clone, Debug, PartialEq)]
pub struct ForeignPart {
    /// Its triangles, ascending.
    pub triangles: Vec<u32>,
    /// Why it is foreign.
    pub reason: Foreignness,
    /// The longest side of its bounding box, in those of the skeleton's.
    pub size: f64,
}

impl ForeignPart {
    /// The diagnostic about it.
    pub fn diagnostic(&self, whose: Subject, left_out: bool) -> Diagnostic {
        let triangles = [self.triangles[0], self.triangles[self.triangles.len() - 1]];
        let size = SIDE * self.size;
        Diagnostic::ForeignPart { whose, count: self.triangles.len(), triangles, reason: self.reason, size, left_out }
    }
}

/// The foreign pieces of `avatar`, whose skeleton is `target`; none with a triangle for which `is_kept`, and never all. The
/// largest come first.
pub fn find(avatar: &TriangleMesh, target: &Skeleton, is_kept: impl Fn(u32) -> bool) -> Vec<ForeignPart> {
    let pieces = pieces(avatar);
    let Ok(side) = target.longest_side("") else { return Vec::new() };
    if pieces.len() < 2 {
        return Vec::new();
    }
    let scene = Scene { avatar, target, side, pieces: &pieces };
    let mut order: Vec<usize> = (0..pieces.len()).collect();
    order.sort_by(|&a, &b| pieces[b].longest_side().total_cmp(&pieces[a].longest_side()));
    let mut reasons: Vec<Option<Foreignness>> = vec![None; pieces.len()];
    let kept: Vec<bool> = pieces.iter().map(|piece| piece.triangles.iter().any(|&t| is_kept(t))).collect();
    for &k in order.iter().filter(|&&k| !kept[k]) {
        let rest = |other: usize| other != k && reasons[other].is_none();
        if let Some(reason) = scene.examine(k, rest) {
            reasons[k] = Some(reason);
        }
    }
    scene.find_detached(&mut reasons, &kept);
    if reasons.iter().all(Option::is_some) {
        return Vec::new();
    }
    let foreign = |k: usize| {
        let triangles = pieces[k].triangles.clone();
        reasons[k].map(|reason| ForeignPart { triangles, reason, size: pieces[k].longest_side() / side })
    };
    order.into_iter().filter_map(foreign).collect()
}

/// The connected pieces, vertices at one position being one.
fn pieces(mesh: &TriangleMesh) -> Vec<Piece> {
    let (to_welded, places) = weld_vertices(mesh);
    let positions: Vec<DVec3> = places.iter().map(|&v| mesh.positions[v as usize]).collect();
    let triangles: Vec<[u32; 3]> = mesh.triangles.iter().map(|t| t.map(|v| to_welded[v as usize])).collect();
    Piece::find(&positions, &triangles, [])
}

struct Scene<'a> {
    avatar: &'a TriangleMesh,
    target: &'a Skeleton,
    side: f64,
    pieces: &'a [Piece],
}

impl Scene<'_> {
    fn points(&self, piece: usize) -> impl Iterator<Item = DVec3> {
        self.pieces[piece].triangles.iter().flat_map(|&t| self.avatar.corners(t))
    }

    fn mesh(&self, triangles: impl Iterator<Item = u32>) -> TriangleMesh {
        TriangleMesh::from_corners(triangles.map(|t| self.avatar.corners(t)))
    }

    /// What piece `k` is beside the pieces of `rest`, but for detached ones.
    fn examine(&self, k: usize, rest: impl Fn(usize) -> bool) -> Option<Foreignness> {
        let piece = &self.pieces[k];
        if piece.longest_side() <= GROUND * self.side {
            return None;
        }
        if self.surrounds(k) && self.is_dressed_by(&rest, k) {
            return Some(Foreignness::Surrounds);
        }
        if self.is_ground(k, &rest) {
            return Some(Foreignness::Ground);
        }
        let is_huge = piece.longest_side() > HUGE * self.side && !self.is_around_a_bone(k);
        (is_huge && (0..self.pieces.len()).any(rest)).then_some(Foreignness::Huge)
    }

    /// All joints are on one side of each of its triangles, and within its box.
    fn surrounds(&self, k: usize) -> bool {
        let piece = &self.pieces[k];
        let joints = &self.target.joints;
        if piece.triangles.len() > MAX_PLANES * 16
            || !joints.iter().all(|j| j.cmpge(piece.low).all() && j.cmple(piece.high).all())
        {
            return false;
        }
        let stride = piece.triangles.len().div_ceil(MAX_PLANES);
        piece
            .triangles
            .iter()
            .step_by(stride)
            .map(|&t| self.avatar.corners(t))
            .filter(|&corners| has_area(corners))
            .all(|[a, b, c]| {
                let normal = (b - a).cross(c - a);
                let above = joints.iter().filter(|&&j| (j - a).dot(normal) > 0.0).count();
                above == 0 || above == joints.len()
            })
    }

    /// The pieces of `rest` surround at least half as many bones as they do together with piece `k`.
    fn is_dressed_by(&self, rest: &impl Fn(usize) -> bool, k: usize) -> bool {
        let of = |with: bool| {
            let own = (0..self.pieces.len()).filter(|&other| rest(other) || with && other == k);
            self.mesh(own.flat_map(|other| self.pieces[other].triangles.iter().copied()))
        };
        let (alone, all) = (of(false), of(true));
        let count = |mesh: &TriangleMesh| self.middles().filter(|&[p, d]| Section::cut(mesh, p, d).encloses(p)).count();
        let own = count(&alone);
        own > 0 && 2 * own >= count(&all)
    }

    /// The middle and direction of each bone.
    fn middles(&self) -> impl Iterator<Item = [DVec3; 2]> {
        self.target.bones.iter().map(|&[a, b]| {
            let (a, b) = (self.target.joints[a as usize], self.target.joints[b as usize]);
            [a.midpoint(b), b - a]
        })
    }

    fn is_around_a_bone(&self, k: usize) -> bool {
        let mesh = self.mesh(self.pieces[k].triangles.iter().copied());
        self.middles().any(|[p, along]| {
            let section = Section::cut(&mesh, p, along);
            section.encloses(p) && section.distance(p) < AROUND * self.side
        })
    }

    /// Flat, with the joints above it, and what lies on it no deeper than soles sink in.
    fn is_ground(&self, k: usize, rest: &impl Fn(usize) -> bool) -> bool {
        let piece = &self.pieces[k];
        let area = |t: u32| {
            let [a, b, c] = self.avatar.corners(t);
            (b - a).cross(c - a)
        };
        let largest = piece.triangles.iter().map(|&t| area(t)).max_by(|a, b| a.length().total_cmp(&b.length()));
        let Some(mut normal) = largest.and_then(DVec3::try_normalize) else { return false };
        let joints = &self.target.joints;
        if (self.target.mean_joint() - piece.low.midpoint(piece.high)).dot(normal) < 0.0 {
            normal = -normal;
        }
        let span = |points: &mut dyn Iterator<Item = DVec3>| {
            points.map(|p| p.dot(normal)).fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), x| (l.min(x), h.max(x)))
        };
        let (bottom, top) = span(&mut self.points(k));
        let (feet, head) = span(&mut joints.iter().copied());
        let sinks = SINKS * self.side;
        if top - bottom > FLAT * piece.longest_side() || feet < top - sinks || head - feet < RISES * self.side {
            return false;
        }
        let mut above = false;
        for other in (0..self.pieces.len()).filter(|&other| rest(other)) {
            let (low, _) = span(&mut self.points(other));
            // What lies under the ground, such as a second one, is no sole.
            if low > top - sinks {
                above = true;
            } else if self.pieces[other].longest_side() <= HUGE * self.side {
                return false;
            }
        }
        above
    }

    /// Marks the pieces that are away from the bones and from what hangs together near them.
    fn find_detached(&self, reasons: &mut [Option<Foreignness>], kept: &[bool]) {
        let segments = self.target.lengthened(LEAF_REACH);
        let from_bones = |p: DVec3| {
            segments.iter().map(|&[a, b]| closest_on_segment(p, a, b - a).distance(p)).fold(f64::INFINITY, f64::min)
        };
        let is_near = |k: usize| {
            if self.points(k).any(|p| from_bones(p) < FROM_BONES * self.side) {
                return true;
            }
            // Large triangles may pass a bone with all their corners far away.
            let tree = ClosestPoint::new(&self.mesh(self.pieces[k].triangles.iter().copied()));
            let along = |&[a, b]: &[DVec3; 2]| (0..=4).map(move |s| a.lerp(b, f64::from(s) / 4.0));
            segments.iter().flat_map(along).any(|p| tree.distance(p) < FROM_BONES * self.side)
        };
        let (mut body, mut far): (Vec<usize>, Vec<usize>) =
            (0..self.pieces.len()).filter(|&k| reasons[k].is_none()).partition(|&k| kept[k] || is_near(k));
        // What touches the body belongs to it, and what touches that.
        let mut added = body.clone();
        while !far.is_empty() && !added.is_empty() {
            let mesh = self.mesh(added.iter().flat_map(|&k| self.pieces[k].triangles.iter().copied()));
            let tree = ClosestPoint::new(&mesh);
            let touches = |k: &usize| self.points(*k).any(|p| tree.distance(p) < FROM_BODY * self.side);
            (added, far) = far.into_iter().partition(touches);
            body.extend(&added);
        }
        if !body.is_empty() {
            far.into_iter().for_each(|k| reasons[k] = Some(Foreignness::Detached));
        }
    }
}
