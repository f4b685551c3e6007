//! Boundary loops where faces are missing, as in a net or a damaged mesh, as against openings that a garment was cut with.
//!
//! An opening ends the cloth: a sleeve stands on its cuff, and a collar slopes towards the neck. Where a few faces are missing, the cloth
//! goes on around the hole as it was, so that the triangles beside it face as the hole does.

use glam::DVec3;

use super::mesh::{BoundaryLoop, Topology, TriangleMesh, area_vector};

/// More edges than this are no hole of a few faces, and so many are the hole of one to three.
const MOST_EDGES: usize = 12;
const FEW_EDGES: usize = 5;
/// The triangles beside such a hole face as it does, by the mean of the cosines: beside one of few edges, and of more. A cuff has 0 to
/// 0.75.
const ALIKE_FEW: f64 = 0.5;
const ALIKE: f64 = 0.8;

/// For each loop of `topology`, which is that of `mesh`, whether only a few faces are missing there.
pub fn are_missing_faces(mesh: &TriangleMesh, topology: &Topology) -> Vec<bool> {
    let is_small = |l: &&BoundaryLoop| l.vertices.len() <= MOST_EDGES;
    let mut wanted: Vec<[u32; 2]> = topology.loops.iter().filter(is_small).flat_map(edges).collect();
    if wanted.is_empty() {
        return vec![false; topology.loops.len()];
    }
    wanted.sort_unstable();
    let mut normal_beside = vec![DVec3::ZERO; wanted.len()];
    for (t, &[a, b, c]) in (0u32..).zip(&mesh.triangles) {
        let [p, q, r] = mesh.corners(t);
        let normal = (q - p).cross(r - p).normalize_or_zero();
        for (v, w) in [(a, b), (b, c), (c, a)] {
            if let Ok(k) = wanted.binary_search(&[v.min(w), v.max(w)]) {
                normal_beside[k] = normal;
            }
        }
    }
    let beside = |edge: [u32; 2]| wanted.binary_search(&edge).map_or(DVec3::ZERO, |k| normal_beside[k]);
    let is_missing = |l: &BoundaryLoop| {
        let points: Vec<DVec3> = l.vertices.iter().map(|&v| mesh.positions[v as usize]).collect();
        let facing = area_vector(&points).normalize_or_zero();
        let alike: f64 = edges(l).map(|edge| beside(edge).dot(facing).abs()).sum();
        let least = if points.len() <= FEW_EDGES { ALIKE_FEW } else { ALIKE };
        alike >= least * points.len() as f64
    };
    topology.loops.iter().map(|l| is_small(&l) && is_missing(l)).collect()
}

/// The edges along a loop, the lower index first.
fn edges(of: &BoundaryLoop) -> impl Iterator<Item = [u32; 2]> + '_ {
    let next = of.vertices.iter().cycle().skip(1);
    of.vertices.iter().zip(next).map(|(&v, &w)| [v.min(w), v.max(w)])
}
