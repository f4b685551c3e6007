//! Seams whose two sides were left a hair apart: which vertices close them.
//!
//! Two boundary edges are a seam where they run in opposite directions, their ends are within the weld distance of each
//! other, and their triangles lie on either side of them: the surface goes on from one to the other. Two sides of a thin sheet
//! turn back on each other at their rims, and stay apart, as do vertices that meet at a point.

use std::collections::HashMap;

use glam::DVec3;

use crate::geometry::border_edges::{BorderEdge, border_edges};
use crate::geometry::mesh::TriangleMesh;

/// Two vertices are welded only where this share of the shortest edge at either is longer than the gap between them: a
/// triangle never loses a side.
const SHARE_OF_EDGES: f64 = 0.25;

/// The triangles at a seam turn back on each other where the cosine of the angle between them is above this: 30 degrees.
const FOLDED: f64 = 0.87;

/// An edge with one triangle.
struct BoundaryEdge {
    /// In the direction in which the triangle has it.
    ends: [u32; 2],
    /// From the edge to the third corner, across the edge; of unit length.
    inward: DVec3,
}

/// Two boundary edges, by their indices, and the wider of the gaps between their ends.
struct Match {
    gap: f64,
    edges: [usize; 2],
}

/// The vertex that each vertex of `mesh` becomes, the lowest where several are welded: seams whose sides are up to `distance`
/// apart are closed. `mesh` has no two vertices in one place, and no duplicate triangles but those that repeat a corner.
pub fn close_seams(mesh: &TriangleMesh, distance: f64) -> Vec<u32> {
    let count = mesh.positions.len();
    let unwelded = || (0..count as u32).collect();
    if distance <= 0.0 {
        return unwelded();
    }
    let edges = boundary_edges(mesh);
    let mut matches = matches(mesh, &edges, distance);
    if matches.is_empty() {
        return unwelded();
    }
    matches.sort_by(|m, n| m.gap.total_cmp(&n.gap).then(m.edges.cmp(&n.edges)));
    let mut clusters = Clusters::new(mesh, distance);
    let mut is_closed = vec![false; edges.len()];
    for Match { edges: [j, k], .. } in matches {
        let ([a, b], [c, d]) = (edges[j].ends, edges[k].ends);
        if !is_closed[j] && !is_closed[k] && clusters.may_merge(a, d) && clusters.may_merge(b, c) {
            clusters.merge(a, d);
            clusters.merge(b, c);
            (is_closed[j], is_closed[k]) = (true, true);
        }
    }
    clusters.of
}

/// The mean length of the sides of triangles; 0 without any.
pub fn mean_edge(mesh: &TriangleMesh) -> f64 {
    let (mut sum, mut count) = (0.0, 0.0);
    for t in &mesh.triangles {
        for k in 0..3 {
            let [v, w] = [t[k], t[(k + 1) % 3]];
            if v != w {
                sum += mesh.positions[v as usize].distance(mesh.positions[w as usize]);
                count += 1.0;
            }
        }
    }
    sum / f64::max(count, 1.0)
}

fn boundary_edges(mesh: &TriangleMesh) -> Vec<BoundaryEdge> {
    let edge = |border: BorderEdge| {
        let [a, b] = border.ends;
        let [pa, pb, pc] = [a, b, border.opposite].map(|v| mesh.positions[v as usize]);
        let inward = (pc - pa).reject_from(pb - pa).try_normalize()?;
        inward.is_finite().then_some(BoundaryEdge { ends: [a, b], inward })
    };
    border_edges(&mesh.triangles).into_iter().filter_map(edge).collect()
}

/// All pairs of edges that could be a seam.
fn matches(mesh: &TriangleMesh, edges: &[BoundaryEdge], distance: f64) -> Vec<Match> {
    let at = |v: u32| mesh.positions[v as usize];
    let mut reach = vec![distance; mesh.positions.len()];
    for t in &mesh.triangles {
        for k in 0..3 {
            let [v, w] = [t[k], t[(k + 1) % 3]];
            if v != w {
                let share = SHARE_OF_EDGES * at(v).distance(at(w));
                [v, w].map(|v| v as usize).into_iter().for_each(|v| reach[v] = reach[v].min(share));
            }
        }
    }
    let gap = |v: u32, w: u32| {
        let gap = at(v).distance(at(w));
        (gap <= reach[v as usize].min(reach[w as usize])).then_some(gap)
    };
    // Edges by the cell of their first end.
    let cell = |p: DVec3| (p / distance).floor().to_array();
    let key = |c: [f64; 3]| c.map(|x| (x + 0.0).to_bits());
    let mut starting: HashMap<[u64; 3], Vec<usize>> = HashMap::new();
    for (k, edge) in edges.iter().enumerate() {
        starting.entry(key(cell(at(edge.ends[0])))).or_default().push(k);
    }
    let mut found = Vec::new();
    for (j, edge) in edges.iter().enumerate() {
        let [a, b] = edge.ends;
        let [x, y, z] = cell(at(b));
        for step in 0..27 {
            let [i, j_, k_] = [step % 3, step / 3 % 3, step / 9].map(|s| f64::from(s) - 1.0);
            let Some(near) = starting.get(&key([x + i, y + j_, z + k_])) else { continue };
            for &k in near.iter().filter(|&&k| k > j) {
                let [c, d] = edges[k].ends;
                if let (Some(first), Some(second)) = (gap(b, c), gap(a, d))
                    && first.max(second) > 0.0
                    && edge.inward.dot(edges[k].inward) < FOLDED
                {
                    found.push(Match { gap: first.max(second), edges: [j, k] });
                }
            }
        }
    }
    found
}

/// Vertices that are welded.
struct Clusters<'a> {
    mesh: &'a TriangleMesh,
    distance: f64,
    /// The lowest vertex of the cluster of each.
    of: Vec<u32>,
    /// The vertices of each cluster of several, by its lowest.
    members: HashMap<u32, Vec<u32>>,
    /// The triangles at each vertex of the boundary.
    triangles: Vec<Vec<u32>>,
}

impl<'a> Clusters<'a> {
    fn new(mesh: &'a TriangleMesh, distance: f64) -> Self {
        let count = mesh.positions.len();
        let mut triangles = vec![Vec::new(); count];
        for (t, corners) in (0u32..).zip(&mesh.triangles) {
            corners.iter().for_each(|&v| triangles[v as usize].push(t));
        }
        Self { mesh, distance, of: (0..count as u32).collect(), members: HashMap::new(), triangles }
    }

    fn members(&self, of: u32) -> Vec<u32> {
        self.members.get(&of).cloned().unwrap_or_else(|| vec![of])
    }

    /// Whether the clusters of two vertices may become one: it is no wider than the distance, and no triangle has two corners
    /// in it.
    fn may_merge(&self, v: u32, w: u32) -> bool {
        let [v, w] = [v, w].map(|v| self.of[v as usize]);
        if v == w {
            return true;
        }
        let (these, those) = (self.members(v), self.members(w));
        let at = |v: u32| self.mesh.positions[v as usize];
        let is_within = these.iter().all(|&p| those.iter().all(|&q| at(p).distance(at(q)) <= self.distance));
        let touches = |&t: &u32| self.mesh.triangles[t as usize].iter().any(|&c| self.of[c as usize] == w);
        is_within && !these.iter().any(|&p| self.triangles[p as usize].iter().any(touches))
    }

    fn merge(&mut self, v: u32, w: u32) {
        let [v, w] = [v, w].map(|v| self.of[v as usize]);
        if v == w {
            return;
        }
        let (low, high) = (v.min(w), v.max(w));
        let mut all = self.members(low);
        let more = self.members(high);
        more.iter().for_each(|&p| self.of[p as usize] = low);
        all.extend(more);
        self.members.remove(&high);
        self.members.insert(low, all);
    }
}
