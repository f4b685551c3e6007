//! Distortion of each triangle of a garment: the surface term, element by element and without a unit.

use glam::DVec3;

use super::surface::l_surf;
use crate::geometry::mesh::{Topology, triangle_area};

/// For each of `triangles`, the mean over its hinges of `|tau1 x - tau2 x|^2` of Eq. 2, in the form that is zero for any
/// similarity, over the ratio of the garment's area at `x` to that at `rest`. So it is 0 for any similarity of the
/// garment as a whole, and the same whatever the units of both.
///
/// A triangle without a hinge that is not degenerate at rest gets 0, as do all of a garment without area.
pub fn distortion(rest: &[DVec3], x: &[DVec3], triangles: &[[u32; 3]]) -> Vec<f64> {
    let area = |x: &[DVec3]| triangles.iter().map(|t| triangle_area(t.map(|v| x[v as usize]))).sum::<f64>();
    let growth = area(x) / area(rest);
    let mut sums = vec![(0.0, 0u32); triangles.len()];
    if !(growth > 0.0 && growth.is_finite()) {
        return vec![0.0; sums.len()];
    }
    for hinge in &Topology::new(rest.len(), triangles).hinges {
        let Some(value) = l_surf(rest, x, hinge) else { continue };
        for t in hinge.triangles {
            let (sum, count) = &mut sums[t as usize];
            *sum += value;
            *count += 1;
        }
    }
    sums.into_iter().map(|(sum, count)| sum / f64::from(count.max(1)) / growth).collect()
}
