//! Connectivity of a surface for contact, with "representative triangles" (Curtis et al. 2008): each vertex and
//! each edge is owned by exactly one triangle, so that a search for close triangles finds every pair of a point
//! and a triangle, or of two edges, exactly once.

use crate::geometry::mesh::neighbours;
use crate::memory::bytes;

/// What a triangle owns, and whether it has a face.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Ownership(u8);

impl Ownership {
    const FACE: u8 = 1 << 6;

    /// Whether it owns its corner k.
    #[inline]
    pub fn corner(self, k: usize) -> bool {
        self.0 & (1 << k) != 0
    }

    /// Whether it owns the edge from its corner k to the next.
    #[inline]
    pub fn side(self, k: usize) -> bool {
        self.0 & (8 << k) != 0
    }

    /// True for a triangle with three distinct corners. Any other is an edge or a point: it owns like every
    /// triangle, but no point is ever paired with it.
    #[inline]
    pub fn face(self) -> bool {
        self.0 & Self::FACE != 0
    }
}

/// Triangles, their edges, and which triangle owns which vertices and edges.
#[derive(Clone, Debug, Default)]
pub struct Surface {
    /// Three vertex indices a triangle.
    pub triangles: Vec<[u32; 3]>,
    /// The sides of the triangles, each once, smaller index first, in ascending order. A side from a vertex to
    /// itself is no edge.
    pub edges: Vec<[u32; 2]>,
    /// Number of vertices, isolated ones included.
    pub vertex_count: usize,
    /// Pairs of triangles that are joined where none of their edges is, as at a T-junction: they take no part in contact with each
    /// other. The lower one first, in ascending order.
    joined: Vec<[u32; 2]>,
    /// Vertices and edges that each triangle owns.
    ownership: Vec<Ownership>,
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
        let mut ownership = Vec::with_capacity(triangles.len());
        for t in &triangles {
            let mut owned = Ownership(0);
            for k in 0..3 {
                if !std::mem::replace(&mut vertex_taken[t[k] as usize], true) {
                    owned.0 |= 1 << k;
                }
                if let Ok(e) = edges.binary_search(&side(t, k))
                    && !std::mem::replace(&mut edge_taken[e], true)
                {
                    owned.0 |= 8 << k;
                }
            }
            if t[0] != t[1] && t[1] != t[2] && t[2] != t[0] {
                owned.0 |= Ownership::FACE;
            }
            ownership.push(owned);
        }
        Self { triangles, edges, vertex_count, joined: Vec::new(), ownership }
    }

    /// The same, with pairs of triangles that are joined, the lower one first, in ascending order.
    pub fn with_joined(mut self, pairs: Vec<[u32; 2]>) -> Self {
        self.joined = pairs;
        self
    }

    /// The pairs of triangles that are joined where none of their edges is.
    pub fn joined(&self) -> &[[u32; 2]] {
        &self.joined
    }

    /// For each vertex, those to which an edge leads from it.
    pub fn neighbours(&self) -> Vec<Vec<u32>> {
        neighbours(self.vertex_count, &self.edges)
    }

    /// Bytes that it holds.
    pub fn memory(&self) -> u64 {
        bytes(&self.triangles) + bytes(&self.edges) + bytes(&self.joined) + bytes(&self.ownership)
    }

    /// What a triangle owns.
    #[inline]
    pub fn ownership(&self, triangle: u32) -> Ownership {
        self.ownership[triangle as usize]
    }

    /// The edges that a triangle owns, smaller index first.
    pub fn owned_sides(&self, triangle: u32) -> impl Iterator<Item = [u32; 2]> + '_ {
        let (corners, owned) = (&self.triangles[triangle as usize], self.ownership(triangle));
        (0..3).filter(move |&k| owned.side(k)).map(move |k| side(corners, k))
    }
}

/// Side k of a triangle, smaller index first.
fn side(t: &[u32; 3], k: usize) -> [u32; 2] {
    let (a, b) = (t[k], t[(k + 1) % 3]);
    [a.min(b), a.max(b)]
}
