//! The rims of a garment of which both sides are modelled: where the outer side of its cloth turns into the inner one.
//!
//! Such a garment is a closed surface. It has no boundary loops, so its cuffs, hems and collars would have no place along the
//! bones and no shape to keep. They are found in four steps:
//!
//! - A triangle *lies on cloth* where another one lies behind it, within `THICKEST`, and looks the other way, and one of the
//!   two looks towards the nearest bone and the other away from it. A narrow sleeve of a single side has an opposite side too,
//!   but both look away from the bone.
//! - A piece is a shell where most of its area lies on cloth.
//! - Neighbours on cloth with no sharp fold between them are one face, and the larger part of its area says whether that looks
//!   away from the bones. What lies on no cloth belongs to the face around it; a strip between two faces counts as inner.
//! - The rims are where the outer faces end: curves that wind around a bone, or are wider than a hole.
//!
//! A rim beside a boundary loop of the same piece, as where a hem is turned in, is left to that loop.

use std::collections::HashMap;

use glam::DVec3;
use rayon::prelude::*;

use super::loop_axis::HOLE;
use crate::geometry::closest_point::{ClosestPoint, closest_on_segment};
use crate::geometry::mesh::{BoundaryLoop, Hinge, NO_PIECE, Topology, TriangleMesh, label_pieces};
use crate::geometry::piece::Piece;
use crate::input::diagnostic::{Bone, Diagnostic};
use crate::input::skeleton::Skeleton;
use crate::stage::start::enclosure::Enclosures;
use crate::stage::start::winding::windings_of_loops;

/// Cloth is thinner than this; on a person five centimetres.
const THICKEST: f64 = 0.06;
/// Both sides of cloth look opposite ways where the cosine of the angle between their normals is below this.
const OPPOSITE: f64 = -0.7;
/// A fold is sharp where the cosine of the angle between the normals is below this.
const SHARP: f64 = 0.3;
/// A piece is a shell where this share of its area lies on cloth.
const MOST: f64 = 0.5;
/// A face smaller than this share of its piece is a part of what is around it.
const SMALL: f64 = 0.01;
/// Nearer than this nothing lies behind a triangle: it meets itself. A share of the size of the normalised space.
const ITSELF: f64 = 1e-9;
/// A boundary loop within this of most of a rim stands for it; on a person eight centimetres.
const BESIDE: f64 = 0.1;
/// How far bones reach beyond leaf joints, as a share of their lengths: a rim around a hand is around its arm.
const LEAF_REACH: f64 = 0.5;

/// The rims of a garment's shells.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ShellRims {
    /// The rims, in the form and order of boundary loops.
    pub loops: Vec<BoundaryLoop>,
    /// Closed pieces around bones without any rim.
    pub without: Vec<Rimless>,
}

/// A closed piece around a bone of which no rim was found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Rimless {
    /// Its triangle of lowest index.
    pub triangle: u32,
    /// How many triangles it has.
    pub triangles: usize,
    /// The first of the bones that it encloses.
    pub bone: u32,
}

/// What a triangle of a shell belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Side {
    Outer,
    Inner,
    /// Not known: it lies on no cloth.
    Open,
}

/// A piece of the garment with vertices and triangles of its own.
struct Shell<'a> {
    mesh: TriangleMesh,
    /// Unit normals, zero for a triangle without area.
    normals: Vec<DVec3>,
    areas: Vec<f64>,
    hinges: Vec<Hinge>,
    source: &'a Skeleton,
}

impl ShellRims {
    /// The rims of the shells of `garment`, whose connectivity is `topology`, around the bones of `source`. `is_held` says which
    /// vertices are held with their piece: these have none.
    pub fn find(garment: &TriangleMesh, topology: &Topology, is_held: &[bool], source: &Skeleton) -> Self {
        let segments = source.lengthened(LEAF_REACH);
        let mut pieces = Piece::find(&garment.positions, &garment.triangles, []);
        pieces.retain(|piece| !piece.triangles.is_empty() && !is_held[piece.vertices[0] as usize]);
        let mut borders: HashMap<u32, Vec<&[u32]>> = HashMap::new();
        let mut piece_of = vec![0; garment.positions.len()];
        for (k, piece) in (0u32..).zip(&pieces) {
            piece.vertices.iter().for_each(|&v| piece_of[v as usize] = k);
        }
        for curve in &topology.loops {
            borders.entry(piece_of[curve.vertices[0] as usize]).or_default().push(&curve.vertices);
        }
        let found: Vec<Self> = (0u32..pieces.len() as u32)
            .into_par_iter()
            .map(|k| {
                let borders = borders.get(&k).map_or(&[][..], |borders| borders);
                of_piece(garment, &pieces[k as usize], borders, source, &segments)
            })
            .collect();
        let mut rims = Self::default();
        for piece in found {
            rims.loops.extend(piece.loops);
            rims.without.extend(piece.without);
        }
        rims.loops.sort_by(|a, b| a.vertices.cmp(&b.vertices));
        rims
    }

    /// What to report; `triangle` gives the caller's indices.
    pub fn diagnostics(&self, source: &Skeleton, triangle: impl Fn(u32) -> u32) -> Vec<Diagnostic> {
        let mut diagnostics = Vec::new();
        Diagnostic::list(&mut diagnostics, &self.without, |piece| Diagnostic::RimsNotFound {
            triangles: piece.triangles,
            triangle: triangle(piece.triangle),
            bone: Bone { index: piece.bone, joints: source.bones[piece.bone as usize] },
        });
        diagnostics
    }
}

/// The rims of one piece, whose boundary loops are `borders`.
fn of_piece(
    garment: &TriangleMesh,
    piece: &Piece,
    borders: &[&[u32]],
    source: &Skeleton,
    segments: &[[DVec3; 2]],
) -> ShellRims {
    let own = |v: u32| piece.vertices.binary_search(&v).unwrap_or(0) as u32;
    let borders: Vec<Vec<u32>> = borders.iter().map(|border| border.iter().map(|&v| own(v)).collect()).collect();
    let shell = Shell::new(
        TriangleMesh {
            positions: piece.vertices.iter().map(|&v| garment.positions[v as usize]).collect(),
            triangles: piece.triangles.iter().map(|&t| garment.triangles[t as usize].map(own)).collect(),
        },
        source,
    );
    let mut loops = shell.sides().map_or_else(Vec::new, |sides| shell.ends_of_outer(&sides));
    loops.retain(|rim| !shell.is_beside(rim, &borders));
    let are_openings = |curves: &[Vec<u32>]| -> Vec<bool> {
        let around = curves.iter().map(Vec::as_slice).collect::<Vec<_>>();
        let around = windings_of_loops(&shell.mesh, &around, segments);
        curves.iter().zip(around).map(|(curve, winding)| winding.linked || shell.width(curve) >= HOLE).collect()
    };
    let mut keep = are_openings(&loops).into_iter();
    loops.retain(|_| keep.next() == Some(true));
    let mut without = Vec::new();
    // What is smaller is no garment that somebody would miss the cuffs of.
    if loops.is_empty() && piece.size() >= HOLE && !are_openings(&borders).contains(&true) {
        let enclosures = Enclosures::find(&shell.mesh, segments);
        let bone = enclosures.of(0).and_then(|enclosure| enclosure.segments.first());
        let (triangle, triangles) = (piece.triangles[0], piece.triangles.len());
        without.extend(bone.map(|&bone| Rimless { triangle, triangles, bone }));
    }
    let in_garment = |rim: Vec<u32>| rim.into_iter().map(|v| piece.vertices[v as usize]).collect();
    let loops = loops.into_iter().map(|rim| BoundaryLoop { vertices: in_garment(rim) }).collect();
    ShellRims { loops, without }
}

impl<'a> Shell<'a> {
    fn new(mesh: TriangleMesh, source: &'a Skeleton) -> Self {
        let corners = || (0..mesh.triangles.len() as u32).map(|t| mesh.corners(t));
        let origin = mesh.positions[0];
        let volume: f64 = corners().map(|[a, b, c]| (a - origin).cross(b - origin).dot(c - origin)).sum();
        // Wound the other way around, normals point into the cloth.
        let outwards = if volume < 0.0 { -1.0 } else { 1.0 };
        Self {
            normals: corners().map(|[a, b, c]| outwards * (b - a).cross(c - a).normalize_or_zero()).collect(),
            areas: mesh.areas(),
            hinges: Topology::new(mesh.positions.len(), &mesh.triangles).hinges,
            mesh,
            source,
        }
    }

    /// Whether what looks along `normal` at `p` looks away from the nearest bone.
    fn looks_away(&self, p: DVec3, normal: DVec3) -> bool {
        let bones = self.source.bones.iter().map(|bone| {
            let [a, b] = bone.map(|joint| self.source.joints[joint as usize]);
            closest_on_segment(p, a, b - a)
        });
        let nearest = bones.min_by(|a, b| a.distance_squared(p).total_cmp(&b.distance_squared(p)));
        nearest.is_some_and(|bone| (p - bone).dot(normal) > 0.0)
    }

    /// For each triangle that lies on cloth, whether it looks away from the bones.
    fn on_cloth(&self) -> Vec<Option<bool>> {
        let tree = ClosestPoint::new(&self.mesh);
        let outwards = |t: u32| {
            let [a, b, c] = self.mesh.corners(t);
            (b - a).cross(c - a).dot(self.normals[t as usize]).signum()
        };
        (0..self.areas.len() as u32)
            .into_par_iter()
            .map(|t| {
                let (p, normal) = (self.mesh.centre(t), self.normals[t as usize]);
                if normal == DVec3::ZERO {
                    return None;
                }
                let (depth, behind) = tree.next_hit(p, -normal, ITSELF)?;
                let behind = outwards(t) * behind.normalize_or_zero();
                if depth > THICKEST || behind.dot(normal) > OPPOSITE {
                    return None;
                }
                let away = self.looks_away(p, normal);
                (away != self.looks_away(p - depth * normal, behind)).then_some(away)
            })
            .collect()
    }

    /// The side of each triangle; none where the piece is no shell.
    fn sides(&self) -> Option<Vec<Side>> {
        let cloth = self.on_cloth();
        let total: f64 = self.areas.iter().sum();
        let on_cloth: f64 =
            self.areas.iter().zip(&cloth).filter(|(_, away)| away.is_some()).map(|(area, _)| area).sum();
        if on_cloth < MOST * total {
            return None;
        }
        let mut sides = self.faces(&cloth, SMALL * total, false);
        if !sides.contains(&Side::Inner) || !sides.contains(&Side::Outer) {
            // Round all over, as a bracelet is.
            sides = self.faces(&cloth, SMALL * total, true);
        }
        self.fill(&mut sides);
        Some(sides)
    }

    /// The sides of the triangles that lie on cloth, by their faces, but for those of less area than `least`. Faces end at sharp
    /// folds, and where they are `turned` towards the bones from away from them.
    fn faces(&self, cloth: &[Option<bool>], least: f64, turned: bool) -> Vec<Side> {
        let joined = self.hinges.iter().filter_map(|hinge| {
            let [t, s] = hinge.triangles.map(|t| t as usize);
            let smooth = self.normals[t].dot(self.normals[s]) > SHARP;
            let on_cloth = cloth[t].is_some() && cloth[s].is_some();
            (smooth && on_cloth && (!turned || cloth[t] == cloth[s])).then_some(hinge.triangles)
        });
        let alone = (0u32..).zip(cloth).filter(|(_, away)| away.is_some()).map(|(t, _)| [t; 2]);
        let (face_of, count) = label_pieces(cloth.len(), alone.chain(joined));
        // The areas that look towards the bones and away from them.
        let mut areas = vec![[0.0; 2]; count];
        for (t, away) in cloth.iter().enumerate() {
            if let Some(away) = away {
                areas[face_of[t] as usize][usize::from(*away)] += self.areas[t];
            }
        }
        let side = |&face: &u32| match areas.get(face as usize) {
            Some([towards, away]) if towards + away >= least => {
                if away > towards {
                    Side::Outer
                } else {
                    Side::Inner
                }
            }
            _ => Side::Open,
        };
        face_of.iter().map(side).collect()
    }

    /// Gives each connected part that is of no side the side of what is around it; inner where it has both for neighbours.
    fn fill(&self, sides: &mut [Side]) {
        let open = |t: u32| sides[t as usize] == Side::Open;
        let alone = (0..sides.len() as u32).filter(|&t| open(t)).map(|t| [t; 2]);
        let joined = self.hinges.iter().map(|hinge| hinge.triangles).filter(|pair| pair.iter().all(|&t| open(t)));
        let (part_of, count) = label_pieces(sides.len(), alone.chain(joined));
        let mut is_inner = vec![false; count];
        for &[t, s] in self.hinges.iter().map(|hinge| &hinge.triangles) {
            for (own, other) in [(t, s), (s, t)] {
                if part_of[own as usize] != NO_PIECE && sides[other as usize] == Side::Inner {
                    is_inner[part_of[own as usize] as usize] = true;
                }
            }
        }
        for (side, part) in sides.iter_mut().zip(part_of) {
            if part != NO_PIECE {
                *side = if is_inner[part as usize] { Side::Inner } else { Side::Outer };
            }
        }
    }

    /// The curves in which the outer faces turn into something else, but for those that are mostly boundary.
    fn ends_of_outer(&self, sides: &[Side]) -> Vec<Vec<u32>> {
        let outer = self.mesh.triangles.iter().zip(sides).filter(|(_, side)| **side == Side::Outer);
        let outer: Vec<[u32; 3]> = outer.map(|(t, _)| *t).collect();
        let turns = |hinge: &&Hinge| hinge.triangles.iter().filter(|&&t| sides[t as usize] == Side::Outer).count() == 1;
        let mut turned: Vec<[u32; 2]> = self.hinges.iter().filter(turns).map(|hinge| edge(hinge.vertices)).collect();
        turned.sort_unstable();
        let is_turned = |v: u32, w: u32| turned.binary_search(&edge([v, w, 0, 0])).is_ok();
        let loops = Topology::new(self.mesh.positions.len(), &outer).loops.into_iter().map(|curve| curve.vertices);
        let is_rim = |curve: &Vec<u32>| {
            let next = curve.iter().cycle().skip(1);
            2 * curve.iter().zip(next).filter(|(v, w)| is_turned(**v, **w)).count() > curve.len()
        };
        loops.filter(is_rim).collect()
    }

    /// The diameter of a curve, seen from its middle.
    fn width(&self, curve: &[u32]) -> f64 {
        let points = || curve.iter().map(|&v| self.mesh.positions[v as usize]);
        let centre = points().sum::<DVec3>() / curve.len().max(1) as f64;
        2.0 * points().map(|p| p.distance(centre)).fold(0.0, f64::max)
    }

    /// Whether most of a rim is beside one of the boundary loops `borders`.
    fn is_beside(&self, rim: &[u32], borders: &[Vec<u32>]) -> bool {
        let at = |v: u32| self.mesh.positions[v as usize];
        borders.iter().any(|border| {
            let is_near = |v: &&u32| border.iter().any(|&w| at(w).distance_squared(at(**v)) < BESIDE * BESIDE);
            2 * rim.iter().filter(is_near).count() > rim.len()
        })
    }
}

/// The edge of a hinge, the lower index first.
fn edge([v, w, ..]: [u32; 4]) -> [u32; 2] {
    [v.min(w), v.max(w)]
}
