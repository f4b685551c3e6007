//! Cloth that is drawn out in one place and has shrunk in another, far beyond what any body asks for: what comes of a garment in
//! another unit than its skeleton, where that is around a bone all the same.

use super::{Distorted, Outcome};
use crate::geometry::mesh::TriangleMesh;
use crate::geometry::quantile::quantile_of_sorted;

/// This share of the cloth, by its area in the design, is left out at either end.
const LEFT_OUT: f64 = 0.05;
/// The largest of the rest may be so many times as large as the smallest, as lengths: where bodies differ most, it is 7.
const MOST: f64 = 15.0;

/// How far the cloth is distorted, where that is gross.
pub(super) fn distorted(outcome: &Outcome<'_>) -> Option<Distorted> {
    let [design, result] = [outcome.design, outcome.result].map(TriangleMesh::areas);
    let scale = |(t, (&before, &now)): (u32, (&f64, &f64))| (before > 0.0).then(|| ((now / before).sqrt(), before, t));
    let mut scales: Vec<(f64, f64, u32)> = (0..).zip(design.iter().zip(&result)).filter_map(scale).collect();
    scales.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.2.cmp(&b.2)));
    let at =
        |share: f64| quantile_of_sorted(&scales, |scale| scale.1, share).map(|&(scale, _, triangle)| (scale, triangle));
    let ((smaller, shrunk), (larger, drawn_out)) = (at(LEFT_OUT)?, at(1.0 - LEFT_OUT)?);
    (larger > MOST * smaller).then_some(Distorted { scales: [smaller, larger], triangles: [shrunk, drawn_out] })
}
