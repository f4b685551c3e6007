//! Crumpled surfaces: such as pass through themselves beside where they are, as noise on their vertices makes them.
//!
//! Layers that pass through each other are far apart along the surface, or are not joined at all, and a few triangles beside
//! each other pass through one another in many a design: so it is the share of the area that tells.

use super::mesh::{Topology, TriangleMesh, neighbours};

/// Triangles are beside each other where so many edges lead from one to the other at most.
const REACH: usize = 3;

/// Triangles that pass through others beside them.
#[derive(Clone, Debug, PartialEq)]
pub struct Crumpled {
    /// Pairs of triangles that pass through each other and are beside each other.
    pub pairs: usize,
    /// The first of them.
    pub first: [u32; 2],
    /// The share of the surface's area that takes part.
    pub share: f64,
}

/// What of `mesh`, whose intersecting pairs of triangles are `pairs` in ascending order, is crumpled; none where nothing is.
pub fn crumpled(mesh: &TriangleMesh, pairs: &[[u32; 2]]) -> Option<Crumpled> {
    if pairs.is_empty() {
        return None;
    }
    let around = neighbours(mesh.positions.len(), &Topology::new(mesh.positions.len(), &mesh.triangles).edges);
    let mut reached = vec![u32::MAX; mesh.positions.len()];
    let mut takes_part = vec![false; mesh.triangles.len()];
    let (mut count, mut first) = (0, None);
    for group in pairs.chunk_by(|a, b| a[0] == b[0]) {
        let own = group[0][0];
        let mut front = mesh.triangles[own as usize].to_vec();
        front.iter().for_each(|&v| reached[v as usize] = own);
        for _ in 0..REACH {
            let mut next = Vec::new();
            for w in front.iter().flat_map(|&v| &around[v as usize]) {
                if std::mem::replace(&mut reached[*w as usize], own) != own {
                    next.push(*w);
                }
            }
            front = next;
        }
        for pair in
            group.iter().filter(|pair| mesh.triangles[pair[1] as usize].iter().any(|&v| reached[v as usize] == own))
        {
            first = first.or(Some(*pair));
            count += 1;
            pair.iter().for_each(|&t| takes_part[t as usize] = true);
        }
    }
    let areas = mesh.areas();
    let whole: f64 = areas.iter().sum();
    let part: f64 = areas.iter().zip(takes_part).filter(|(_, takes_part)| *takes_part).map(|(area, _)| area).sum();
    Some(Crumpled { pairs: count, first: first?, share: part / whole.max(f64::MIN_POSITIVE) })
}
