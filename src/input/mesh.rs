//! Triangle meshes and what is derived from their connectivity.

use glam::DVec3;

/// Vertices and triangles.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TriangleMesh {
    /// Position of each vertex.
    pub positions: Vec<DVec3>,
    /// Three vertex indices a triangle.
    pub triangles: Vec<[u32; 3]>,
}

/// Two triangles over one edge: `t1 = (v1, v2, v3)` and `t2 = (v2, v1, v4)`, as in Eq. 2 of the paper.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Hinge {
    /// `[v1, v2, v3, v4]`: the shared edge, then the corner opposite to it in each triangle.
    pub vertices: [u32; 4],
    /// Indices of `t1` and `t2`.
    pub triangles: [u32; 2],
}

/// A closed boundary curve: each vertex once, in order, the last joined to the first.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BoundaryLoop {
    /// Vertex indices along the curve.
    pub vertices: Vec<u32>,
}
