//! What a caller asks of the fit alone, in the normalised space.

use glam::DVec3;

use super::fit_region::fit_region;
use super::normalization::Normalization;
use crate::error::{Error, ErrorKind, Result};
use crate::geometry::closest_point::ClosestPoint;
use crate::options::Options;

/// The largest offset that is accepted, in the normalised space. A larger one is one in another unit.
const MAX_OFFSET: f64 = 1.0;

/// `offset`, which is in the target's unit, in the normalised space.
pub fn normalised_offset(offset: f64, target: &Normalization, options: &Options) -> Result<f64> {
    let offset = offset * target.scale;
    if offset > MAX_OFFSET {
        return Err(Error::new(
            ErrorKind::InvalidArgument,
            format!(
                "option offset is {}, which is more than half the size of the target skeleton; it is a length in the unit \
                 of the target's coordinate system",
                options.offset
            ),
        ));
    }
    Ok(offset)
}

/// How much each vertex fits where the caller does not say it: what was designed near to the body, but for what is `placed`.
pub fn fit_weights(rest: &[DVec3], body: Option<&ClosestPoint>, distance: f64, placed: &[u32]) -> Vec<f64> {
    let mut weights = match body {
        Some(body) => fit_region(rest, body, distance),
        None => vec![1.0; rest.len()],
    };
    placed.iter().for_each(|&v| weights[v as usize] = 0.0);
    weights
}
