//! The caller's inputs: read, checked and converted to the internal coordinate system.

pub mod body;
pub mod buffer;
pub mod coordinate_system;
pub mod curve;
pub mod diagnostic;
pub mod diagnostic_facts;
pub mod diagnostic_text;
pub mod diagnostic_words;
pub mod element;
pub mod key_pose;
mod mesh;
pub mod morph;
pub mod near_seams;
pub mod placement;
pub mod precision;
pub mod rig;
pub mod skeleton;
pub mod skin;
pub mod weld;

use glam::DVec3;

/// The largest coordinate accepted, in absolute value. Beyond it, products of coordinates, as every later computation
/// forms them, would leave the range of doubles.
pub const MAX_COORDINATE: f64 = 1e30;

/// The first point that is not usable (NaN, infinite, beyond [`MAX_COORDINATE`]), described as "x = NaN".
fn bad_coordinate(points: &[DVec3]) -> Option<(usize, String)> {
    points.iter().enumerate().find_map(|(i, p)| {
        let axis = (0..3).find(|&k| p[k].is_nan() || p[k].abs() > MAX_COORDINATE)?;
        Some((i, format!("{} = {}", ["x", "y", "z"][axis], p[axis])))
    })
}
