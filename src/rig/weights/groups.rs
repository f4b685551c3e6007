//! Vertices that move as one.

use crate::error::{Error, ErrorKind, Result};
use crate::input::skin::SkinWeights;

/// `skin` with one vector of weights for all vertices of each group: their mean. A vertex in several groups goes with the
/// last of them.
///
/// # Errors
/// [`ErrorKind::InvalidArgument`] where a vertex is out of range.
pub fn move_as_one(skin: &SkinWeights, groups: &[Vec<u32>]) -> Result<SkinWeights> {
    let mut rows: Vec<Vec<(u32, f64)>> = (0..skin.vertex_count()).map(|v| skin.weights(v).to_vec()).collect();
    for (k, group) in groups.iter().enumerate() {
        if let Some(v) = group.iter().find(|v| **v as usize >= rows.len()) {
            let message = format!("rigid group {k} has vertex {v}, the garment has {} vertices", rows.len());
            return Err(Error::new(ErrorKind::InvalidArgument, message));
        }
        let share = 1.0 / group.len() as f64;
        let members = group.iter().flat_map(|&v| skin.weights(v as usize));
        let mean = sum_up(&mut members.map(|&(joint, weight)| (joint, share * weight)).collect::<Vec<_>>());
        group.iter().for_each(|&v| rows[v as usize].clone_from(&mean));
    }
    Ok(SkinWeights::from_rows(skin.joint_count(), rows))
}

/// Each joint once, ascending, with the sum of its weights.
pub(super) fn sum_up(weights: &mut [(u32, f64)]) -> Vec<(u32, f64)> {
    // Stable, so that sums are in the order of the list.
    weights.sort_by_key(|w| w.0);
    weights.chunk_by(|a, b| a.0 == b.0).map(|same| (same[0].0, same.iter().map(|w| w.1).sum())).collect()
}
