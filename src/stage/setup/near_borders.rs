//! Borders that lie on or beside another part of the garment: the two fronts of a placket, the hem of a shirt over the
//! waistband of trousers, the flap of a pocket.
//!
//! Nothing but the body holds two such parts to each other, and it lets a placket gape, or close the other way round, and a
//! shirt ride up. So each vertex of a boundary loop is held to the nearest triangle
//!
//! - that is within `REACH` of it,
//! - whose side that looks out is the same: two trouser legs that touch look at each other, and may part,
//! - and that is another piece, or as far as `APART` along the surface: the end of a slit holds itself.
//!
//! Pieces that are held as a whole are left out, on both sides.

use std::collections::BinaryHeap;

use glam::DVec3;
use rayon::prelude::*;

use super::loose_pieces::THIN;
use crate::energy::attachment::Hold;
use crate::geometry::bvh::{Aabb, Bvh};
use crate::geometry::closest_point::closest_on_triangle;
use crate::geometry::mesh::{Topology, is_wide};
use crate::input::diagnostic::Diagnostic;

/// Distance up to which a border lies beside something; on a person two centimetres.
const REACH: f64 = 0.02;

/// What is nearer than this along the surface is the same part of it; on a person eight centimetres.
const APART: f64 = 0.1;

/// Both sides look the same way where the cosine of the angle between their normals is above this.
const SAME_WAY: f64 = 0.5;

/// How much more a border is held than a vertex of a loose piece with the same area.
const STRENGTH: f64 = 10.0;

/// The borders of a garment that are held to what they lie on or beside.
#[derive(Clone, Debug, Default)]
pub struct NearBorders {
    /// What holds their vertices, in the order of the vertices.
    pub holds: Vec<Hold>,
    /// The triangle of each hold.
    pub triangles: Vec<u32>,
}

/// A garment with what is asked of it again and again.
struct Garment<'a> {
    rest: &'a [DVec3],
    triangles: &'a [[u32; 3]],
    /// The triangles at each vertex.
    at: Vec<Vec<u32>>,
    /// Per triangle: a normal of twice its area.
    normals: Vec<DVec3>,
}

impl NearBorders {
    /// The near borders of a garment with vertices `rest`. `is_held` says which vertices are held already, with their piece.
    pub fn find(rest: &[DVec3], triangles: &[[u32; 3]], topology: &Topology, is_held: &[bool]) -> Self {
        let mut borders: Vec<u32> = topology.loops.iter().flat_map(|curve| &curve.vertices).copied().collect();
        borders.sort_unstable();
        borders.dedup();
        borders.retain(|&v| !is_held[v as usize]);
        let garment = Garment::new(rest, triangles);
        let near = garment.near(&borders, is_held);
        let found: Vec<Option<(Hold, u32)>> =
            borders.par_iter().zip(near).map(|(&v, near)| garment.hold(v, near)).collect();
        let (holds, triangles) = found.into_iter().flatten().unzip();
        Self { holds, triangles }
    }

    /// What to report; `vertex` and `triangle` give the caller's indices.
    pub fn diagnostics(&self, vertex: impl Fn(u32) -> u32, triangle: impl Fn(u32) -> u32) -> Vec<Diagnostic> {
        let nearest = self.holds.iter().zip(&self.triangles).min_by(|a, b| a.0.distance.total_cmp(&b.0.distance));
        let widest = self.holds.iter().map(|hold| hold.distance).fold(0.0, f64::max);
        let found = nearest.map(|(hold, &t)| Diagnostic::KeptTogether {
            vertices: self.holds.len(),
            vertex: vertex(hold.vertex),
            triangle: triangle(t),
            distance: widest,
        });
        found.into_iter().collect()
    }
}

impl<'a> Garment<'a> {
    fn new(rest: &'a [DVec3], triangles: &'a [[u32; 3]]) -> Self {
        let mut at = vec![Vec::new(); rest.len()];
        for (t, corners) in (0u32..).zip(triangles) {
            corners.iter().for_each(|&v| at[v as usize].push(t));
        }
        let normal = |t: &[u32; 3]| {
            let [a, b, c] = t.map(|v| rest[v as usize]);
            (b - a).cross(c - a)
        };
        Self { rest, triangles, at, normals: triangles.iter().map(normal).collect() }
    }

    fn corners(&self, t: u32) -> [DVec3; 3] {
        self.triangles[t as usize].map(|v| self.rest[v as usize])
    }

    /// The triangles whose boxes are within reach of each of `borders`, ascending.
    fn near(&self, borders: &[u32], is_held: &[bool]) -> Vec<Vec<u32>> {
        let boxes: Vec<Aabb> =
            borders.iter().map(|&v| self.rest[v as usize]).map(|p| Aabb::around(p, p, REACH)).collect();
        let is_usable = |&t: &u32| !is_held[self.triangles[t as usize][0] as usize] && is_wide(self.corners(t), THIN);
        let usable: Vec<u32> = (0..self.triangles.len() as u32).filter(is_usable).collect();
        let around = |&t: &u32| {
            let [a, b, c] = self.corners(t);
            Aabb::around(a.min(b).min(c), a.max(b).max(c), 0.0)
        };
        let (own, theirs) = (Bvh::new(&boxes), Bvh::new(&usable.iter().map(around).collect::<Vec<_>>()));
        let mut near = vec![Vec::new(); borders.len()];
        if let Some(roots) = own.roots(&theirs) {
            own.traverse(Some(&theirs), roots, &mut Vec::new(), |v, t| near[v as usize].push(usable[t as usize]));
        }
        near.iter_mut().for_each(|list| list.sort_unstable());
        near
    }

    /// What holds the border's vertex `v`, of the triangles `near`.
    fn hold(&self, v: u32, near: Vec<u32>) -> Option<(Hold, u32)> {
        let p = self.rest[v as usize];
        let outward = self.at[v as usize].iter().map(|&t| self.normals[t as usize]).sum::<DVec3>().try_normalize()?;
        let looks_out =
            |&t: &u32| self.normals[t as usize].try_normalize().is_some_and(|normal| normal.dot(outward) > SAME_WAY);
        let mut sorted: Vec<(f64, u32)> = near
            .into_iter()
            .filter(looks_out)
            .map(|t| (closest_on_triangle(p, &self.corners(t)).distance(p), t))
            .filter(|&(distance, _)| distance <= REACH)
            .collect();
        // Most borders have only themselves nearby: what shares a vertex needs no search.
        let is_own = |t: u32| self.triangles[t as usize].contains(&v);
        sorted.retain(|&(_, t)| !is_own(t));
        if sorted.is_empty() {
            return None;
        }
        sorted.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let same = self.within(v);
        let is_apart = |t: u32| self.triangles[t as usize].iter().all(|w| same.binary_search(w).is_err());
        let (distance, t) = sorted.into_iter().find(|&(_, t)| is_apart(t))?;
        let area = STRENGTH * self.at[v as usize].iter().map(|&t| self.normals[t as usize].length()).sum::<f64>() / 6.0;
        Some((Hold { vertex: v, triangle: self.triangles[t as usize], distance, area }, t))
    }

    /// The vertices within `APART` of `v` along edges, ascending (Dijkstra).
    fn within(&self, v: u32) -> Vec<u32> {
        let mut heap = BinaryHeap::from([(std::cmp::Reverse(Length(0.0)), v)]);
        let mut done: Vec<u32> = Vec::new();
        let mut seen = std::collections::HashSet::new();
        while let Some((std::cmp::Reverse(Length(length)), v)) = heap.pop() {
            if !seen.insert(v) {
                continue;
            }
            done.push(v);
            for &w in self.at[v as usize].iter().flat_map(|&t| &self.triangles[t as usize]) {
                let far = length + self.rest[v as usize].distance(self.rest[w as usize]);
                if far <= APART && !seen.contains(&w) {
                    heap.push((std::cmp::Reverse(Length(far)), w));
                }
            }
        }
        done.sort_unstable();
        done
    }
}

/// A length in the order of numbers.
#[derive(Clone, Copy, PartialEq)]
struct Length(f64);

impl Eq for Length {}

impl PartialOrd for Length {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Length {
    fn cmp(&self, other: &Self) -> std::cmp::Ordering {
        self.0.total_cmp(&other.0)
    }
}
