//! One-ring pairs: the pairs of primitives of triangles that have a vertex in common, listed once. Their boxes nearly
//! always overlap, so that a search through a tree would only find them again.

use super::surface::Surface;
use crate::memory::bytes;

/// A vertex of more triangles than these takes no part in the list, whose length grows with the square of the valence.
const MAX_VALENCE: usize = 16;

/// The pairs of primitives, without a vertex in common, of neighbouring triangles of one surface.
#[derive(Clone, Debug, Default)]
pub struct OneRingPairs {
    /// A point, then the corners of a triangle.
    pub point_triangle: Vec<[u32; 4]>,
    /// Two edges.
    pub edge_edge: Vec<[u32; 4]>,
    /// For each vertex, whether more than [`MAX_VALENCE`] triangles have it.
    exceeds_valence: Vec<bool>,
}

impl OneRingPairs {
    /// Lists the pairs of `surface`. Each is listed by the triangles that own its primitives.
    pub fn new(surface: &Surface) -> Self {
        let mut vertex_triangles: Vec<Vec<u32>> = vec![Vec::new(); surface.vertex_count];
        for (t, corners) in (0..).zip(&surface.triangles) {
            for (k, &v) in corners.iter().enumerate() {
                // A triangle that repeats a corner is listed once there.
                if !corners[..k].contains(&v) {
                    vertex_triangles[v as usize].push(t);
                }
            }
        }
        let exceeds_valence = vertex_triangles.iter().map(|triangles| triangles.len() > MAX_VALENCE).collect();
        let mut found = Self { exceeds_valence, ..Self::default() };
        for (v, triangles) in (0..).zip(&vertex_triangles) {
            for (k, &s) in triangles.iter().enumerate() {
                for &t in &triangles[k + 1..] {
                    // Triangles with several vertices in common count at one of them.
                    let corners = [s, t].map(|t| surface.triangles[t as usize]);
                    if found.shared(corners[0], corners[1]) == Some(v) {
                        found.list(surface, s, t);
                    }
                }
            }
        }
        found.point_triangle.shrink_to_fit();
        found.edge_edge.shrink_to_fit();
        found
    }

    fn list(&mut self, surface: &Surface, s: u32, t: u32) {
        for (s, t) in [(s, t), (t, s)] {
            let (points, [i, j, k]) = (surface.triangles[s as usize], surface.triangles[t as usize]);
            for (c, &v) in points.iter().enumerate() {
                if surface.ownership(s).corner(c) && surface.ownership(t).face() && ![i, j, k].contains(&v) {
                    self.point_triangle.push([v, i, j, k]);
                }
            }
        }
        for [i, j] in surface.owned_sides(s) {
            for [k, l] in surface.owned_sides(t) {
                if i != k && i != l && j != k && j != l {
                    self.edge_edge.push([i, j, k, l]);
                }
            }
        }
    }

    /// Whether the pairs of two triangles with these corners are listed.
    #[inline]
    pub fn has(&self, s: [u32; 3], t: [u32; 3]) -> bool {
        self.shared(s, t).is_some()
    }

    /// The smallest common vertex of two triangles within [`MAX_VALENCE`].
    #[inline]
    fn shared(&self, s: [u32; 3], t: [u32; 3]) -> Option<u32> {
        let common = |v: u32| (v == t[0] || v == t[1] || v == t[2]) && !self.exceeds_valence[v as usize];
        let at = |v: u32| if common(v) { v } else { u32::MAX };
        let least = at(s[0]).min(at(s[1])).min(at(s[2]));
        (least != u32::MAX).then_some(least)
    }

    /// Bytes that it holds.
    pub fn memory(&self) -> u64 {
        bytes(&self.point_triangle) + bytes(&self.edge_edge) + bytes(&self.exceeds_valence)
    }
}
