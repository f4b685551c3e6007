//! Which pieces of a garment are carried: those around no bone, such as a cape, a backpack, a badge or an earring.
//!
//! Pieces that hang together, for one is held to the other or they nearly touch, are one. Such a piece is carried if
//! - neither it nor the garment with it encloses the bones beside it; or the garment does so as well without it, and the piece
//!   is not sewn to the others along its borders, as the panels of a coat are;
//! - it is near enough to the body, and neither tiny nor huge beside it: else it is in another place or unit;
//! - it is no tube: a piece with two openings is for a limb to go through.
//!
//! What is small and leaves a gap of more than a quarter of a turn around a bone is around none: the temples of glasses do
//! not close, and a pair of earrings is no collar.
//!
//! It is stiff where it is small, is open around a bone, or is closed and the thicker the larger it is; else it is soft.

use glam::DVec3;
use rayon::prelude::*;

use super::loose_pieces::LoosePieces;
use crate::geometry::closest_point::ClosestPoint;
use crate::geometry::mesh::{Topology, TriangleMesh, area_vector, label_pieces, triangle_area};
use crate::geometry::missing_faces::are_missing_faces;
use crate::geometry::piece::Piece;
use crate::geometry::section::Gap;
use crate::input::skeleton::Skeleton;
use crate::stage::start::enclosure::{enclosed_share_at, encloses, encloses_but_for};

/// Corners of a piece from which its enclosure is tested.
const SAMPLES: usize = 64;
/// The garment encloses the bones beside a piece where this share of its corners says so.
const MIN_ENCLOSED_SHARE: f64 = 0.1;
/// The garment encloses bones without a piece as well as with it where the shares differ by a factor above this.
const AS_WELL: f64 = 0.9;
/// Pieces that are tested, the largest first: it bounds the time for a garment of thousands of sequins.
const MOST_PIECES: usize = 64;
/// Two pieces hang together where they are nearer than this share of the larger one's size, or that of the smaller one's.
const NEAR_LARGER: f64 = 0.05;
const NEAR_SMALLER: f64 = 0.5;
/// A border vertex nearer than this to another piece may be sewn to it, and a piece is sewn where this share of its is.
const SEAM: f64 = 0.02;
const SEWN: f64 = 0.5;
/// Farther from all bones, or from the source body, nothing is carried; the skeleton is 2 long.
const MAX_FROM_BONE: f64 = 0.5;
const MAX_FROM_BODY: f64 = 0.3;
/// Smaller or larger than this is in another unit.
const SIZES: [f64; 2] = [0.015, 4.0];
/// An opening is a boundary loop whose area is more than this share of its squared length: a circle has 0.08.
const ROUND: f64 = 0.02;
/// An opening for a limb is longer than this share of the piece's size.
const WIDE: f64 = 0.4;
/// What is smaller than this is stiff: badges, glasses, earrings.
const SMALL: f64 = 0.3;
/// What is no larger than this, 30 cm on a person, may be open around a bone by a quarter of a turn, and is no garment then.
const OPEN: f64 = 0.4;
/// A closed piece is thick where its volume is more than this share of its area to the power of 1.5: a cube has 0.07, a plate
/// of 20 : 20 : 1 has 0.015. Between [`SMALL`] and twice that, the share grows from zero.
const THICK: f64 = 0.015;
/// A piece is closed where at most this share of its edges are borders: game models leave out what nobody sees.
const OPEN_EDGES: f64 = 0.1;
/// Of pieces that hang together, the largest decides whether they are thick, and those of this share of its area whether they
/// are tubes.
const LARGE: f64 = 0.5;

/// A piece that is carried.
#[derive(Clone, Debug, PartialEq)]
pub struct CarriedPiece {
    /// Its vertices, ascending.
    pub vertices: Vec<u32>,
    /// Its triangle of lowest index.
    pub triangle: u32,
    /// The bone nearest to its nearest vertex, by its index in the source skeleton.
    pub bone: u32,
    /// Its distance from the source body, or from that bone where there is none.
    pub distance: f64,
    /// It keeps its shape.
    pub stiff: bool,
    /// It is closed around that bone.
    pub closed: bool,
}

/// What was found of carried pieces.
pub struct Found {
    /// They, in the order of their lowest vertices.
    pub carried: Vec<CarriedPiece>,
    /// Another piece is around bones.
    pub is_worn: bool,
}

/// Where a piece is.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Place {
    /// Around bones.
    Worn,
    /// Around bones together with others, or sewn to them.
    WithOthers,
    /// Around no bone that it is there to enclose.
    Free,
}

/// `garment` with the triangles of `part` alone.
fn own_mesh(garment: &TriangleMesh, part: &Piece) -> TriangleMesh {
    mesh_of(garment, part.triangles.iter().copied())
}

/// Points of `part` from which its enclosure is tested.
fn samples(garment: &TriangleMesh, part: &Piece) -> Vec<DVec3> {
    let corners: Vec<u32> = part.triangles.iter().flat_map(|&t| garment.triangles[t as usize]).collect();
    let step = corners.len().div_ceil(SAMPLES).max(1);
    corners.iter().step_by(step).map(|&v| garment.positions[v as usize]).collect()
}

/// `garment` with some of its triangles.
fn mesh_of(garment: &TriangleMesh, triangles: impl Iterator<Item = u32>) -> TriangleMesh {
    garment.with_triangles(triangles.map(|t| garment.triangles[t as usize]))
}

/// The carried pieces of `garment`. `loose` are its pieces that are held to others,
/// `segments` the bones as far as there is anything on them, `source_body` the body that it was designed on.
pub fn find(
    garment: &TriangleMesh,
    loose: &LoosePieces,
    segments: &[[DVec3; 2]],
    source: &Skeleton,
    source_body: Option<&ClosestPoint>,
) -> Found {
    // What is held to another piece goes with it.
    let holds = loose.all().map(|piece| [piece.vertices[0], garment.triangles[piece.host as usize][0]]);
    let mut parts = Piece::find(&garment.positions, &garment.triangles, holds);
    if parts.is_empty() {
        return Found { carried: Vec::new(), is_worn: false };
    }
    parts.sort_by(|a, b| b.size().total_cmp(&a.size()).then(a.vertices[0].cmp(&b.vertices[0])));
    parts.truncate(MOST_PIECES);
    let places: Vec<Place> = parts.par_iter().map(|part| place(garment, part, segments)).collect();
    let mut each = places.iter();
    parts.retain(|_| each.next() == Some(&Place::Free));
    let joined = join_near(garment, parts);
    let mut carried: Vec<CarriedPiece> =
        joined.iter().filter_map(|part| carry(garment, part, segments, source, source_body)).collect();
    carried.sort_by_key(|piece| piece.vertices[0]);
    Found { carried, is_worn: places.contains(&Place::Worn) }
}

/// True where `carried` are all the triangles of `garment`.
pub fn is_whole(garment: &TriangleMesh, carried: &[CarriedPiece]) -> bool {
    let mut is_carried = vec![false; garment.positions.len()];
    carried.iter().flat_map(|piece| &piece.vertices).for_each(|&v| is_carried[v as usize] = true);
    garment.triangles.iter().all(|t| is_carried[t[0] as usize])
}

/// Where `part` is.
fn place(garment: &TriangleMesh, part: &Piece, segments: &[[DVec3; 2]]) -> Place {
    let (own, samples) = (own_mesh(garment, part), samples(garment, part));
    let widest = if part.size() <= OPEN { Gap::Quarter } else { Gap::Half };
    if encloses_but_for(&own, segments, widest) {
        // What is small is around a bone only where it leaves no wide gap, so it is around it by the wider rule as well.
        return Place::Worn;
    }
    if part.triangles.len() == garment.triangles.len() {
        return Place::Free;
    }
    let whole = enclosed_share_at(garment, segments, &samples, widest);
    if whole < MIN_ENCLOSED_SHARE {
        return Place::Free;
    }
    let mut own = part.triangles.iter().peekable();
    let others = (0..garment.triangles.len() as u32).filter(|t| own.next_if_eq(&t).is_none());
    let others = mesh_of(garment, others);
    let without = enclosed_share_at(&others, segments, &samples, widest);
    if without >= AS_WELL * whole && !is_sewn(garment, part, &others) { Place::Free } else { Place::WithOthers }
}

/// Whether most of the border of `part` is at `others`.
fn is_sewn(garment: &TriangleMesh, part: &Piece, others: &TriangleMesh) -> bool {
    let topology = Topology::new(garment.positions.len(), &own_mesh(garment, part).triangles);
    let border: Vec<u32> = topology.loops.iter().flat_map(|l| l.vertices.iter().copied()).collect();
    let tree = ClosestPoint::new(others);
    let near = border.iter().filter(|&&v| tree.distance(garment.positions[v as usize]) < SEAM).count();
    near as f64 > SEWN * border.len() as f64
}

/// Joins parts that nearly touch.
fn join_near(garment: &TriangleMesh, parts: Vec<Piece>) -> Vec<Piece> {
    let trees: Vec<ClosestPoint> = parts.par_iter().map(|part| ClosestPoint::new(&own_mesh(garment, part))).collect();
    let mut links: Vec<[u32; 2]> = Vec::new();
    for (i, a) in parts.iter().enumerate() {
        links.push([i as u32; 2]);
        for (j, b) in parts.iter().enumerate().skip(i + 1) {
            let (small, large) = (a.size().min(b.size()), a.size().max(b.size()));
            let near = (NEAR_LARGER * large).max(NEAR_SMALLER * small);
            let is_near = |&v: &u32| trees[i].distance(garment.positions[v as usize]) < near;
            if a.gap(b) < near && b.vertices.iter().any(is_near) {
                links.push([i as u32, j as u32]);
            }
        }
    }
    let (labels, count) = label_pieces(parts.len(), links.into_iter());
    let mut joined: Vec<Option<Piece>> = (0..count).map(|_| None).collect();
    for (part, label) in parts.into_iter().zip(labels) {
        match &mut joined[label as usize] {
            Some(first) => first.merge(part),
            slot => *slot = Some(part),
        }
    }
    joined.into_iter().flatten().collect()
}

/// How `part` is carried; none where nothing is near enough, or where it is no such thing.
fn carry(
    garment: &TriangleMesh,
    part: &Piece,
    segments: &[[DVec3; 2]],
    source: &Skeleton,
    source_body: Option<&ClosestPoint>,
) -> Option<CarriedPiece> {
    let size = part.size();
    if !(SIZES[0]..=SIZES[1]).contains(&size) {
        return None;
    }
    let from_bones = part.vertices.iter().filter_map(|&v| source.nearest_bone(garment.positions[v as usize]));
    let (bone, from_bone) = from_bones.min_by(|a, b| a.1.total_cmp(&b.1))?;
    let from_body = source_body.map(|body| {
        let distances = part.vertices.iter().map(|&v| body.distance(garment.positions[v as usize]));
        distances.fold(f64::INFINITY, f64::min)
    });
    if from_bone > MAX_FROM_BONE || from_body.is_some_and(|distance| distance > MAX_FROM_BODY) {
        return None;
    }
    let shells = shells(garment, part);
    if shells.iter().any(|shell| shell.area >= LARGE * shells[0].area && shell.is_tube()) {
        return None;
    }
    // Only what is small got here although it is around a bone.
    let is_open = size > SMALL && size <= OPEN && encloses(&own_mesh(garment, part), segments);
    let thick = THICK * ((size - SMALL) / SMALL).clamp(0.0, 1.0);
    Some(CarriedPiece {
        vertices: part.vertices.clone(),
        triangle: part.triangles[0],
        bone,
        distance: from_body.unwrap_or(from_bone),
        stiff: size <= SMALL || is_open || shells.first().is_some_and(|shell| shell.is_thicker(thick)),
        closed: false,
    })
}

/// A connected surface with its topology.
struct Shell {
    mesh: TriangleMesh,
    topology: Topology,
    area: f64,
}

/// The connected surfaces of `part`, the largest first.
fn shells(garment: &TriangleMesh, part: &Piece) -> Vec<Shell> {
    let all: Vec<[u32; 3]> = part.triangles.iter().map(|&t| garment.triangles[t as usize]).collect();
    let links = all.iter().flat_map(|&[a, b, c]| [[a, b], [b, c]]);
    let (labels, count) = label_pieces(garment.positions.len(), links);
    let mut triangles = vec![Vec::new(); count];
    all.iter().for_each(|t| triangles[labels[t[0] as usize] as usize].push(*t));
    let shell = |triangles: Vec<[u32; 3]>| {
        let topology = Topology::new(garment.positions.len(), &triangles);
        let area = triangles.iter().map(|t| triangle_area(t.map(|v| garment.positions[v as usize]))).sum();
        Shell { mesh: garment.with_triangles(triangles), topology, area }
    };
    let mut shells: Vec<Shell> = triangles.into_iter().map(shell).collect();
    shells.sort_by(|a, b| b.area.total_cmp(&a.area));
    shells
}

impl Shell {
    fn corners(&self) -> impl Iterator<Item = DVec3> {
        self.mesh.triangles.iter().flatten().map(|&v| self.mesh.positions[v as usize])
    }

    /// Whether there are two openings that are wide beside it.
    fn is_tube(&self) -> bool {
        let low = self.corners().fold(DVec3::INFINITY, DVec3::min);
        let high = self.corners().fold(DVec3::NEG_INFINITY, DVec3::max);
        let is_opening = |vertices: &Vec<u32>| {
            let points: Vec<DVec3> = vertices.iter().map(|&v| self.mesh.positions[v as usize]).collect();
            let length: f64 = points.iter().zip(points.iter().cycle().skip(1)).map(|(p, &next)| p.distance(next)).sum();
            area_vector(&points).length() > ROUND * length * length && length > WIDE * low.distance(high)
        };
        let all = self.topology.loops.iter().zip(are_missing_faces(&self.mesh, &self.topology));
        all.filter(|(l, is_missing)| !is_missing && is_opening(&l.vertices)).count() > 1
    }

    /// Whether it is closed, but for a little, and has more volume than this share of its area to the power of 1.5.
    fn is_thicker(&self, share: f64) -> bool {
        let border: usize = self.topology.loops.iter().map(|l| l.vertices.len()).sum::<usize>()
            + self.topology.open_boundaries.iter().map(Vec::len).sum::<usize>();
        if border as f64 > OPEN_EDGES * self.topology.edges.len() as f64 {
            return false;
        }
        let centre = self.corners().sum::<DVec3>() / (3 * self.mesh.triangles.len()).max(1) as f64;
        let volume = |t: &[u32; 3]| {
            let [a, b, c] = t.map(|v| self.mesh.positions[v as usize] - centre);
            a.cross(b).dot(c) / 6.0
        };
        let volume: f64 = self.mesh.triangles.iter().map(volume).sum();
        volume.abs() > share * self.area * self.area.sqrt()
    }
}
