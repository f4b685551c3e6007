//! T-junctions: border vertices that lie on the edge of another triangle without being joined to it, as where a fine part of a
//! garment meets a coarse one.
//!
//! To contact, such a vertex is a part of the garment that touches another one: no step may move it along the edge, and
//! hundreds of them hold the garment as a whole. To whoever made it, it is one surface. So the triangles at the vertex and
//! that with the edge are joined, as neighbours over an edge are: they have no contact with each other, and the vertex is held
//! to its place in the triangle. The slits in between are no borders.
//!
//! A border vertex is at a T-junction where
//!
//! - it is within the weld distance of the edge, and not at its ends,
//! - the next vertex on its border is there as well, so that the two borders run along each other,
//! - and the triangles do not lie on each other: those are two layers.

use glam::DVec3;

use super::loose_pieces::THIN;
use crate::energy::attachment::Hold;
use crate::geometry::bvh::{Aabb, Bvh};
use crate::geometry::closest_point::closest_on_segment;
use crate::geometry::mesh::{TriangleMesh, is_wide, triangle_area};

/// A vertex nearer than this share of the edge to one of its ends is not on the edge; nor is one farther off it.
const ENDS: f64 = 0.05;
/// Two triangles lie on each other where the cosine of the angle between the directions in which they go from the edge is
/// above this: 30 degrees.
const FOLDED: f64 = 0.87;
/// How much more a vertex is held than one of a loose piece with the same area.
const STRENGTH: f64 = 10.0;

/// An edge with one triangle: its ends, the third corner, and the triangle.
#[derive(Clone, Copy)]
struct Border {
    ends: [u32; 2],
    opposite: u32,
    triangle: u32,
}

/// The T-junctions of a garment.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TJunctions {
    /// What holds their vertices, in the order of the vertices; one with several edges is there several times.
    pub holds: Vec<Hold>,
    /// The pairs of triangles that are joined, the lower index first, in ascending order.
    pub joined: Vec<[u32; 2]>,
}

impl TJunctions {
    /// The T-junctions of `garment`, whose vertices are up to `distance` off the edges.
    pub fn find(garment: &TriangleMesh, distance: f64) -> Self {
        let borders = borders(garment);
        if distance <= 0.0 || borders.is_empty() {
            return Self::default();
        }
        let at = |v: u32| garment.positions[v as usize];
        let mut triangles: Vec<Vec<u32>> = vec![Vec::new(); garment.positions.len()];
        for (t, corners) in (0u32..).zip(&garment.triangles) {
            corners.iter().for_each(|&v| triangles[v as usize].push(t));
        }
        let mut found: Vec<(u32, u32, f64)> = Vec::new();
        for [j, k] in near(garment, &borders, distance) {
            let (on, beside) = (&borders[j as usize], &borders[k as usize]);
            if !is_wide(garment.corners(on.triangle), THIN) || lie_on_each_other(garment, on, beside) {
                continue;
            }
            let off = |v: u32| distance_to(on, at(v), at);
            let reach = distance.min(ENDS * at(on.ends[0]).distance(at(on.ends[1])));
            // Both ends of the other edge are on this one, of which one may be an end of it.
            if beside.ends.iter().all(|&v| on.ends.contains(&v) || off(v) <= reach) {
                let inner = beside.ends.iter().filter(|&&v| is_inner(on, at(v), at));
                found.extend(inner.map(|&v| (v, on.triangle, off(v))));
            }
        }
        found.sort_by_key(|&(v, t, _)| (v, t));
        found.dedup_by_key(|&mut (v, t, _)| (v, t));
        let mut all = Self::default();
        for (vertex, t, distance) in found {
            let own = &triangles[vertex as usize];
            let area = own.iter().map(|&t| triangle_area(garment.corners(t))).sum::<f64>() / 3.0;
            let triangle = garment.triangles[t as usize];
            all.holds.push(Hold { vertex, triangle, distance, area: STRENGTH * area });
            all.joined.extend(own.iter().map(|&s| [s.min(t), s.max(t)]));
        }
        all.joined.sort_unstable();
        all.joined.dedup();
        all
    }
}

/// The edges with one triangle.
fn borders(garment: &TriangleMesh) -> Vec<Border> {
    let mut sides: Vec<([u32; 2], Border)> = Vec::new();
    for (triangle, corners) in (0u32..).zip(&garment.triangles) {
        for k in 0..3 {
            let [a, b, opposite] = [0, 1, 2].map(|i| corners[(k + i) % 3]);
            if a != b && b != opposite && opposite != a {
                sides.push(([a.min(b), a.max(b)], Border { ends: [a, b], opposite, triangle }));
            }
        }
    }
    sides.sort_unstable_by_key(|&(edge, Border { triangle, .. })| (edge, triangle));
    sides.chunk_by(|s, t| s.0 == t.0).filter(|same| same.len() == 1).map(|same| same[0].1).collect()
}

/// The pairs of different borders whose boxes are within `distance`, in both orders.
fn near(garment: &TriangleMesh, borders: &[Border], distance: f64) -> Vec<[u32; 2]> {
    let around = |border: &Border| {
        let [a, b] = border.ends.map(|v| garment.positions[v as usize]);
        Aabb::around(a.min(b), a.max(b), distance)
    };
    let tree = Bvh::new(&borders.iter().map(around).collect::<Vec<_>>());
    let mut pairs = Vec::new();
    if let Some(roots) = tree.roots(&tree) {
        tree.traverse(Some(&tree), roots, &mut Vec::new(), |j, k| {
            if j != k {
                pairs.push([j, k]);
            }
        });
    }
    pairs
}

fn distance_to(border: &Border, p: DVec3, at: impl Fn(u32) -> DVec3) -> f64 {
    let [a, b] = border.ends.map(at);
    closest_on_segment(p, a, b - a).distance(p)
}

/// Whether `p`, which is on the border, is not at one of its ends.
fn is_inner(border: &Border, p: DVec3, at: impl Fn(u32) -> DVec3) -> bool {
    let [a, b] = border.ends.map(at);
    let along = (p - a).dot(b - a) / (b - a).length_squared();
    along > ENDS && along < 1.0 - ENDS
}

fn lie_on_each_other(garment: &TriangleMesh, on: &Border, beside: &Border) -> bool {
    let inward = |border: &Border| {
        let [a, b, c] = [border.ends[0], border.ends[1], border.opposite].map(|v| garment.positions[v as usize]);
        (c - a).reject_from(b - a).normalize_or_zero()
    };
    inward(on).dot(inward(beside)) > FOLDED
}
