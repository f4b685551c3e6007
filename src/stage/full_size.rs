//! Whether parts of the avatar that hold the garment between them touch each other at full size, where nothing can pass
//! between them.

use glam::DVec3;
use rayon::prelude::*;

use super::setup::problem::Problem;
use crate::contact::distance::{edge_edge, point_triangle};
use crate::geometry::mesh::{TriangleMesh, label_pieces};
use crate::geometry::solid_angle::winding;
use crate::input::body::Body;
use crate::input::weld::weld_vertices;
use crate::verify::intersections;

/// How far off a surface its two sides are tested.
const SIDE_OFFSET: f64 = 1e-6;
/// A point whose winding number is farther from 0 than this is inside the body.
const INSIDE: f64 = 0.5;
/// The share that another part has in the winding number where it is this part that a point lies in. Parts are open where
/// the next bone begins, so that it is not 1.
const SHARE: f64 = 0.25;
/// Pairs whose triangles are tested for lying inside the body as a whole.
const OVERLAP_PAIRS: usize = 3;

/// A connected piece with less than this share of the triangles of the largest is a loose piece.
const LOOSE: f64 = 0.5;

/// What moves with one bone and hangs together: the bone, and the number of the connected piece.
pub type Part = (Option<u32>, u32);

/// Two triangles of the avatar that push against the garment from its two sides.
pub struct Pair {
    /// The triangles of the body.
    pub triangles: [u32; 2],
    /// The parts that they belong to.
    pub parts: [Part; 2],
    /// Where the contact points are at full size.
    pub points: [DVec3; 2],
}

/// The body at full size and its parts.
pub struct FullSize<'a> {
    problem: &'a Problem,
    /// Number of triangles of the avatar without its layers.
    avatar_triangles: usize,
    /// Vertices in one place are one vertex.
    to_welded: Vec<u32>,
    /// The connected piece of each vertex.
    pieces: Vec<u32>,
    /// The triangles of each connected piece.
    sizes: Vec<usize>,
    /// Up to this distance, things touch.
    touching: f64,
}

impl<'a> FullSize<'a> {
    /// The avatar of `problem`. What is nearer than `touching` touches.
    pub fn new(problem: &'a Problem, body: &Body, touching: f64) -> Self {
        let mesh = &problem.avatar;
        let (to_welded, places) = weld_vertices(mesh);
        let welded = |v: u32| to_welded[v as usize];
        let links = mesh.triangles.iter().flat_map(|&[a, b, c]| [[welded(a), welded(b)], [welded(b), welded(c)]]);
        let (labels, _) = label_pieces(places.len(), links);
        let pieces: Vec<u32> = to_welded.iter().map(|&w| labels[w as usize]).collect();
        let mut sizes = vec![0; places.len()];
        mesh.triangles.iter().for_each(|&[a, ..]| sizes[pieces[a as usize] as usize] += 1);
        Self { problem, avatar_triangles: body.avatar_size()[1], to_welded, pieces, sizes, touching }
    }

    /// The part that a piece of the projected avatar belongs to.
    pub fn part(&self, piece: u32) -> Part {
        let projected = &self.problem.projected;
        let [corner, ..] = self.problem.avatar.triangles[projected.origins[piece as usize] as usize];
        (projected.bones[piece as usize], self.pieces[corner as usize])
    }

    /// How many triangles the connected piece of a part has, where that is a loose piece beside a body much larger.
    pub fn loose(&self, part: Part) -> Option<usize> {
        let size = self.sizes[part.1 as usize];
        let largest = self.sizes.iter().copied().max().unwrap_or(0);
        ((size as f64) < LOOSE * largest as f64).then_some(size)
    }

    /// The triangles of the body that belong to `part` wholly or partly, ascending.
    fn triangles_of(&self, part: Part) -> Vec<u32> {
        let origins = &self.problem.projected.origins;
        let pieces = (0..origins.len() as u32).filter(|&piece| self.part(piece) == part);
        // The pieces are in the order of what they are pieces of.
        let mut triangles: Vec<u32> = pieces.map(|piece| origins[piece as usize]).collect();
        triangles.dedup();
        triangles
    }

    fn corners(&self, t: u32) -> [DVec3; 3] {
        self.problem.avatar.triangles[t as usize].map(|v| self.problem.avatar.positions[v as usize])
    }

    fn share_a_vertex(&self, s: u32, t: u32) -> bool {
        let places = |t: u32| self.problem.avatar.triangles[t as usize].map(|v| self.to_welded[v as usize]);
        let other = places(t);
        places(s).iter().any(|v| other.contains(v))
    }

    /// The smallest distance of two triangles of a pair at full size, all pairs being of the same two parts; none where they
    /// touch, or where one of them touches the other's part or lies inside it.
    pub fn gap(&self, pairs: &[Pair]) -> Option<f64> {
        let (mut gap, mut touch) = (f64::INFINITY, false);
        for Pair { triangles: [s, t], points: [p, q], .. } in pairs {
            if self.share_a_vertex(*s, *t) {
                // Neighbours, which always touch, are as far apart as the contact points on them.
                gap = gap.min(p.distance(*q));
            } else {
                let distance = triangle_distance(self.corners(*s), self.corners(*t));
                (gap, touch) = (gap.min(distance), touch || distance <= self.touching);
            }
        }
        (!touch && !self.meet(pairs) && !self.overlap(pairs)).then_some(gap)
    }

    /// Whether triangles of `pairs` intersect the part on the other side, neighbours apart.
    fn meet(&self, pairs: &[Pair]) -> bool {
        let mesh = |triangles: &[u32]| TriangleMesh::from_corners(triangles.iter().map(|&t| self.corners(t)));
        let same = pairs.iter().any(|pair| pair.parts[0] == pair.parts[1]);
        let mut parts: Vec<Part> = pairs.iter().flat_map(|pair| pair.parts).collect();
        parts.sort_unstable();
        parts.dedup();
        for part in parts {
            // The triangles that are on the other side of the garment than `part`.
            let mut here: Vec<u32> = Vec::new();
            let mut there: Vec<u32> = if same { Vec::new() } else { self.triangles_of(part) };
            for pair in pairs {
                match (same, pair.parts[0] == part) {
                    (true, _) => {
                        here.push(pair.triangles[0]);
                        there.push(pair.triangles[1]);
                    }
                    (false, true) => here.push(pair.triangles[1]),
                    (false, false) => here.push(pair.triangles[0]),
                }
            }
            there.retain(|&t| !here.iter().any(|&s| self.share_a_vertex(s, t)));
            if intersections(&mesh(&here), Some(&mesh(&there)), 1).is_ok_and(|found| found.count > 0) {
                return true;
            }
        }
        false
    }

    /// Whether a triangle of the strongest of `pairs` lies as a whole inside the avatar, and within the other part: the two
    /// parts have grown into each other. For an avatar that is closed, or almost.
    fn overlap(&self, pairs: &[Pair]) -> bool {
        let sides = |&Pair { triangles: [s, t], parts: [a, b], .. }: &Pair| [(s, a, b), (t, b, a)];
        let sides: Vec<(u32, Part, Part)> = pairs.iter().take(OVERLAP_PAIRS).flat_map(sides).collect();
        let winding = |triangles: &[u32], p: DVec3| winding(&self.problem.avatar, triangles.iter().copied(), p);
        let avatar: Vec<u32> = (0..self.avatar_triangles as u32).collect();
        sides.par_iter().any(|&(t, own, other)| {
            let [a, b, c] = self.corners(t);
            let (centre, normal) = ((a + b + c) / 3.0, (b - a).cross(c - a).normalize_or_zero());
            let is_inside = |p: DVec3| winding(&avatar, p).abs() > INSIDE;
            normal != DVec3::ZERO
                && is_inside(centre + SIDE_OFFSET * normal)
                && is_inside(centre - SIDE_OFFSET * normal)
                && (own == other || winding(&self.triangles_of(other), centre).abs() > SHARE)
        })
    }
}

/// The distance of two triangles that do not intersect.
fn triangle_distance(s: [DVec3; 3], t: [DVec3; 3]) -> f64 {
    let mut squared = f64::INFINITY;
    for (from, to) in [(s, t), (t, s)] {
        for p in from {
            squared = squared.min(point_triangle(&[p, to[0], to[1], to[2]]).squared);
        }
    }
    for i in 0..3 {
        for j in 0..3 {
            squared = squared.min(edge_edge(&[s[i], s[(i + 1) % 3], t[j], t[(j + 1) % 3]]).squared);
        }
    }
    squared.sqrt()
}
