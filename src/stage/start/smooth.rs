//! Smoothing without shrinking, by G. Taubin: A signal processing approach to fair surface design (1995).

use glam::DVec3;

use crate::geometry::mesh::{Topology, TriangleMesh};

/// A round goes towards the mean of the neighbours by the first share of the way and away from it by the second.
const SHARES: [f64; 2] = [0.5, -0.53];

/// The neighbours that each vertex of a garment follows.
pub struct Smoother {
    /// Those at borders are followed along the border alone.
    edges: Vec<[u32; 2]>,
    is_border: Vec<bool>,
    degrees: Vec<f64>,
}

impl Smoother {
    /// Of `garment`.
    pub fn new(garment: &TriangleMesh) -> Self {
        let count = garment.positions.len();
        let topology = Topology::new(count, &garment.triangles);
        let closed = topology.loops.iter().flat_map(|boundary| {
            let vertices = &boundary.vertices;
            vertices.iter().zip(vertices.iter().cycle().skip(1)).map(|(&a, &b)| [a, b])
        });
        let open = topology.open_boundaries.iter().flat_map(|path| path.windows(2).map(|pair| [pair[0], pair[1]]));
        let border: Vec<[u32; 2]> = closed.chain(open).collect();
        let mut is_border = vec![false; count];
        border.iter().flatten().for_each(|&v| is_border[v as usize] = true);
        let mut edges: Vec<[u32; 2]> = topology.edges;
        edges.retain(|edge| edge.iter().any(|&v| !is_border[v as usize]));
        let mut degrees = vec![0.0; count];
        for &[a, b] in &edges {
            for v in [a, b] {
                degrees[v as usize] += if is_border[v as usize] { 0.0 } else { 1.0 };
            }
        }
        border.iter().flatten().for_each(|&v| degrees[v as usize] += 1.0);
        edges.extend(border);
        Self { edges, is_border, degrees }
    }

    /// The points of the garment, which are at `positions`, after so many rounds.
    pub fn smoothed(&self, positions: &[DVec3], rounds: usize) -> Vec<DVec3> {
        let mut points = positions.to_vec();
        for share in (0..rounds).flat_map(|_| SHARES) {
            let mut sums = vec![DVec3::ZERO; points.len()];
            for &[a, b] in &self.edges {
                // A border does not follow what is inside of it.
                let along = self.is_border[a as usize] && self.is_border[b as usize];
                for (v, w) in [(a, b), (b, a)] {
                    if along || !self.is_border[v as usize] {
                        sums[v as usize] += points[w as usize];
                    }
                }
            }
            for ((p, sum), degree) in points.iter_mut().zip(sums).zip(&self.degrees).filter(|((_, _), d)| **d > 0.0) {
                *p += share * (sum / degree - *p);
            }
        }
        points
    }
}
