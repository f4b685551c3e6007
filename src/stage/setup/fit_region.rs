//! Which part of a garment fits, decided by its distance from the body that it was designed on (section 3.4.4).
//!
//! ```text
//! w(d) = 1 - smoothstep((d - D) / D),   smoothstep(s) = s^2 (3 - 2 s) on [0, 1]
//! ```
//!
//! What was designed up to D away from the body follows it; what was designed twice as far away, or farther, such as the hem
//! of a wide skirt, hangs as it was designed.

use glam::DVec3;
use rayon::prelude::*;

use crate::geometry::closest_point::ClosestPoint;

/// The fit weight of each of the vertices `rest` around `body`. `reach` is D, above 0; all weights are 1 where it is
/// infinite.
pub fn fit_region(rest: &[DVec3], body: &ClosestPoint, reach: f64) -> Vec<f64> {
    if reach.is_infinite() {
        return vec![1.0; rest.len()];
    }
    rest.par_iter().map(|&p| weight(body.distance(p), reach)).collect()
}

fn weight(distance: f64, reach: f64) -> f64 {
    let s = ((distance - reach) / reach).clamp(0.0, 1.0);
    1.0 - s * s * (3.0 - 2.0 * s)
}
