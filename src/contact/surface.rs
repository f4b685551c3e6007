//! Connectivity of a surface for contact, with "representative triangles" (Curtis et al. 2008): each vertex and
//! each edge belongs to exactly one triangle, so that a search for close triangles meets every pair of a point
//! and a triangle, or of two edges, exactly once.

use crate::memory::bytes;

/// Marks a side of a triangle whose edge another triangle owns.
const NOT_OWNED: u32 = u32::MAX;

/// Triangles, their edges, and who owns what.
#[derive(Clone, Debug, Default)]
pub struct Surface {
    /// Three vertex indices a triangle.
    pub triangles: Vec<[u32; 3]>,
    /// The sides of the triangles, each once, smaller index first, in ascending order. A side from a vertex to
    /// itself is no edge.
    pub edges: Vec<[u32; 2]>,
    /// Number of vertices, isolated ones included.
    pub vertex_count: usize,
    /// For each triangle, bit k is set if it owns its corner k.
    owned_corners: Vec<u8>,
    /// For each triangle, the index of the edge from corner k to corner k + 1 if it owns that.
    owned_edges: Vec<[u32; 3]>,
}

impl Surface {
    /// The surface made of `triangles`, whose indices are below `vertex_count`.
    ///
    /// A vertex outside all triangles is owned by none and takes no part in contact.
    pub fn new(vertex_count: usize, triangles: Vec<[u32; 3]>) -> Self {
        let mut edges: Vec<[u32; 2]> =
            triangles.iter().flat_map(|t| (0..3).map(|k| side(t, k))).filter(|e| e[0] != e[1]).collect();
        edges.sort_unstable();
        edges.dedup();

        let mut vertex_taken = vec![false; vertex_count];
        let mut edge_taken = vec![false; edges.len()];
        let mut owned_corners = Vec::with_capacity(triangles.len());
        let mut owned_edges = Vec::with_capacity(triangles.len());
        for t in &triangles {
            let (mut corners, mut sides) = (0, [NOT_OWNED; 3]);
            for (k, owned) in sides.iter_mut().enumerate() {
                if !std::mem::replace(&mut vertex_taken[t[k] as usize], true) {
                    corners |= 1 << k;
                }
                if let Ok(e) = edges.binary_search(&side(t, k))
                    && !std::mem::replace(&mut edge_taken[e], true)
                {
                    *owned = e as u32;
                }
            }
            owned_corners.push(corners);
            owned_edges.push(sides);
        }
        Self { triangles, edges, vertex_count, owned_corners, owned_edges }
    }

    /// Bytes that it holds.
    pub fn memory(&self) -> u64 {
        bytes(&self.triangles) + bytes(&self.edges) + bytes(&self.owned_corners) + bytes(&self.owned_edges)
    }

    /// The vertices that `triangle` owns.
    #[inline]
    pub fn owned_vertices(&self, triangle: u32) -> impl Iterator<Item = u32> + '_ {
        let t = self.triangles[triangle as usize];
        let mask = self.owned_corners[triangle as usize];
        (0..3).filter(move |k| mask & (1 << k) != 0).map(move |k| t[k])
    }

    /// The indices of the edges that `triangle` owns.
    #[inline]
    pub fn owned_edges(&self, triangle: u32) -> impl Iterator<Item = u32> + '_ {
        self.owned_edges[triangle as usize].into_iter().filter(|&e| e != NOT_OWNED)
    }

    /// True for a triangle with three distinct corners. Any other is an edge or a point: it owns like every
    /// triangle, but no point is ever paired with it.
    #[inline]
    pub fn has_face(&self, triangle: u32) -> bool {
        let [a, b, c] = self.triangles[triangle as usize];
        a != b && b != c && c != a
    }
}

/// Side k of a triangle, smaller index first.
fn side(t: &[u32; 3], k: usize) -> [u32; 2] {
    let (a, b) = (t[k], t[(k + 1) % 3]);
    [a.min(b), a.max(b)]
}
