//! Bounds of one surface over a part of a motion: boxes and planes for the broad phase.

use glam::DVec3;
use rayon::prelude::*;

use super::bodies::Motion;
use super::surface::Surface;
use crate::geometry::bvh::{Aabb, Bvh};
use crate::memory::bytes;

/// Primitives a thread takes at once when it bounds them, at least.
const CHUNK: usize = 2048;

/// The plane of a triangle at the beginning.
#[derive(Clone, Copy, Debug)]
pub(super) struct Plane {
    /// The unit normal, zero where the triangle has no area.
    pub normal: DVec3,
    /// The projection interval on the normal: the smallest coordinate at the beginning and at the end, then the largest.
    pub interval: [[f64; 2]; 2],
}

/// One surface with its bounds over a part of a motion.
pub(super) struct SweptSurface {
    /// Boxes of the vertices.
    pub vertices: Vec<Aabb>,
    /// Positions of the vertices at the beginning and at the end.
    pub positions: Vec<[DVec3; 2]>,
    /// Planes of the triangles.
    pub planes: Vec<Plane>,
    /// The tree over the triangles.
    pub tree: Bvh,
}

impl SweptSurface {
    /// Builds the tree over the triangles of `surface` with its vertices at rest.
    pub fn new(surface: &Surface, at_rest: impl Fn(usize) -> DVec3) -> Self {
        let vertices: Vec<Aabb> =
            (0..surface.vertex_count).map(|i| Aabb::around(at_rest(i), at_rest(i), 0.0)).collect();
        let triangles: Vec<Aabb> = surface.triangles.iter().map(|&t| triangle_box(&vertices, t)).collect();
        Self { tree: Bvh::new(&triangles), vertices, positions: Vec::new(), planes: Vec::new() }
    }

    /// Bytes that it holds.
    pub fn memory(&self) -> u64 {
        bytes(&self.vertices) + bytes(&self.positions) + bytes(&self.planes) + self.tree.memory()
    }

    /// Refits the bounds to the first `part` of `motion`, in which the surface's vertices are numbered from `offset`. Boxes
    /// get the margin on all sides.
    pub fn refit(&mut self, surface: &Surface, motion: &Motion, offset: u32, part: f64, margin: f64) {
        fill(&mut self.positions, surface.vertex_count, |v| {
            let v = v as u32 + offset;
            [motion.position(v, 0.0), motion.position(v, part)]
        });
        let positions = &self.positions;
        fill(&mut self.vertices, surface.vertex_count, |v| Aabb::around(positions[v][0], positions[v][1], margin));
        fill(&mut self.planes, surface.triangles.len(), |t| {
            let [a, b, c] = surface.triangles[t];
            let (a, b, c) = (&positions[a as usize], &positions[b as usize], &positions[c as usize]);
            let normal = (b[0] - a[0]).cross(c[0] - a[0]).normalize_or_zero();
            let interval = [0, 1].map(|end| interval(normal, a[end], b[end], c[end]));
            Plane { normal, interval: [[interval[0][0], interval[1][0]], [interval[0][1], interval[1][1]]] }
        });
        let vertices = &self.vertices;
        self.tree.refit(|t| triangle_box(vertices, surface.triangles[t as usize]));
    }
}

/// The projection interval of three points on `n`: smallest and largest coordinate.
#[inline]
pub(super) fn interval(n: DVec3, a: DVec3, b: DVec3, c: DVec3) -> [f64; 2] {
    let (a, b, c) = (n.dot(a), n.dot(b), n.dot(c));
    [a.min(b).min(c), a.max(b).max(c)]
}

/// The box of a triangle from those of the vertices.
#[inline]
fn triangle_box(vertices: &[Aabb], [a, b, c]: [u32; 3]) -> Aabb {
    vertices[a as usize].union(vertices[b as usize]).union(vertices[c as usize])
}

/// Replaces the content of `out` by `count` new ones.
fn fill<T: Send>(out: &mut Vec<T>, count: usize, of: impl Fn(usize) -> T + Sync + Send) {
    out.clear();
    (0..count).into_par_iter().with_min_len(CHUNK).map(of).collect_into_vec(out);
}
