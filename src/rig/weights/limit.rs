//! The number of influences that a host takes.

use crate::input::skin::SkinWeights;

/// `skin` with at most `influences` joints a vertex, 1 at least: the largest weights are kept (of equal ones those of the
/// lowest joints), and sum to 1 again. A vertex without weights stays without.
pub fn limited(skin: &SkinWeights, influences: usize) -> SkinWeights {
    let rows = (0..skin.vertex_count()).map(|v| {
        let mut row = skin.weights(v).to_vec();
        row.sort_by(|a, b| b.1.total_cmp(&a.1));
        row.truncate(influences.max(1));
        let sum: f64 = row.iter().map(|&(_, weight)| weight).sum();
        row.iter_mut().for_each(|(_, weight)| *weight /= sum);
        row
    });
    SkinWeights::from_rows(skin.joint_count(), rows)
}
