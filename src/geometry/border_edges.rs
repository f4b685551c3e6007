//! Edges with one triangle.

/// An edge that only one triangle has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BorderEdge {
    /// Its ends, in the order in which the triangle has them.
    pub ends: [u32; 2],
    /// The third corner.
    pub opposite: u32,
    /// The triangle.
    pub triangle: u32,
    /// Which of the triangle's corners the edge begins at: 0, 1 or 2.
    pub corner: usize,
}

/// Those of a mesh, ascending by their ends, the lower one first. What a triangle that repeats a corner has from that corner to
/// itself is no edge.
pub fn border_edges(triangles: &[[u32; 3]]) -> Vec<BorderEdge> {
    let mut sides: Vec<([u32; 2], u32, usize)> = Vec::with_capacity(3 * triangles.len());
    for (t, corners) in (0u32..).zip(triangles) {
        for k in 0..3 {
            let [a, b] = [corners[k], corners[(k + 1) % 3]];
            if a != b {
                sides.push(([a.min(b), a.max(b)], t, k));
            }
        }
    }
    sides.sort_unstable();
    let alone = sides.chunk_by(|s, t| s.0 == t.0).filter(|same| same.len() == 1);
    let edge = |&(_, triangle, corner): &([u32; 2], u32, usize)| {
        let [a, b, opposite] = [0, 1, 2].map(|i| triangles[triangle as usize][(corner + i) % 3]);
        BorderEdge { ends: [a, b], opposite, triangle, corner }
    };
    alone.map(|same| edge(&same[0])).collect()
}
