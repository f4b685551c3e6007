//! Skin weights: each vertex follows the joints that own the nearby parts of the body, smoothed over the mesh.

use super::implicit::{Field, Owner};
use super::mesh::Mesh;
use super::skeleton::JOINTS;

/// Parts farther than this (metres) beyond the nearest one have little say.
const FALLOFF: f64 = 0.008;

/// Passes of smoothing over the edges.
const PASSES: usize = 12;

/// One row a joint, one weight a vertex; every column sums to 1.
pub fn skin(mesh: &Mesh, field: &Field) -> Vec<Vec<f64>> {
    let mut weights: Vec<[f64; JOINTS]> = mesh.positions.iter().map(|&p| owners(field, p)).collect();
    let edges = mesh.edges();
    for _ in 0..PASSES {
        let mut sums: Vec<([f64; JOINTS], f64)> = weights.iter().map(|w| (*w, 1.0)).collect();
        for edge in &edges {
            for [v, w] in [edge.vertices, [edge.vertices[1], edge.vertices[0]]] {
                let (sum, count) = &mut sums[v as usize];
                for (sum, weight) in sum.iter_mut().zip(&weights[w as usize]) {
                    *sum += weight;
                }
                *count += 1.0;
            }
        }
        for (weights, (sum, count)) in weights.iter_mut().zip(sums) {
            *weights = sum.map(|weight| weight / count);
        }
    }
    (0..JOINTS).map(|joint| weights.iter().map(|w| w[joint] / w.iter().sum::<f64>()).collect()).collect()
}

/// The weights of a point by the parts around it.
fn owners(field: &Field, point: glam::DVec3) -> [f64; JOINTS] {
    let parts = field.primitives().iter().filter(|part| !part.is_carved());
    let distances: Vec<(f64, Owner)> = parts.map(|part| (part.distance(point).max(0.0), part.owner)).collect();
    let nearest = distances.iter().map(|(d, _)| *d).fold(f64::INFINITY, f64::min);
    let mut weights = [0.0; JOINTS];
    for (distance, owner) in distances {
        let weight = (-(distance - nearest) / FALLOFF).exp();
        match owner {
            Owner::Joint(joint) => weights[joint] += weight,
            Owner::Passage { joints: [below, above], height, reach } => {
                let t = ((point.z - height + reach) / (2.0 * reach)).clamp(0.0, 1.0);
                let t = t * t * (3.0 - 2.0 * t);
                weights[below] += weight * (1.0 - t);
                weights[above] += weight * t;
            }
        }
    }
    weights
}
