//! How much a surface covers a point: the share of directions in which it is seen from there.
//!
//! In a sleeve that is nearly 1, at a cuff a half, beyond it a few hundredths. Holes in the cloth, the number of its pieces and
//! their winding make no difference.

use std::sync::LazyLock;

use glam::DVec3;

use super::closest_point::ClosestPoint;
use crate::maths;

/// Directions in which a point looks.
pub const DIRECTIONS: usize = 64;
/// The cosine of the half-angle of [`cover_towards`].
const CONE: f64 = 0.64;

/// The share of [`DIRECTIONS`], spread evenly, in which `surface` is seen from `p`.
pub fn cover(surface: &ClosestPoint, p: DVec3) -> f64 {
    static SPREAD: LazyLock<[DVec3; DIRECTIONS]> = LazyLock::new(|| std::array::from_fn(|k| direction(k, DIRECTIONS)));
    SPREAD.iter().filter(|&&d| surface.meets_ray(p, d)).count() as f64 / DIRECTIONS as f64
}

/// The share of directions within some 50 degrees of `axis`, a unit vector, in which `surface` is seen from `p`.
pub fn cover_towards(surface: &ClosestPoint, p: DVec3, axis: DVec3) -> f64 {
    let within = (0..2 * DIRECTIONS).map(|k| direction(k, 2 * DIRECTIONS)).filter(|d| d.dot(axis) > CONE);
    let (all, seen) = within.fold((0, 0), |(all, seen), d| (all + 1, seen + u32::from(surface.meets_ray(p, d))));
    f64::from(seen) / f64::from(all.max(1))
}

/// Direction `k` of `count` that are spread evenly: points on a spiral around the sphere, in rings of equal area.
pub fn direction(k: usize, count: usize) -> DVec3 {
    let golden_angle = std::f64::consts::PI * (3.0 - 5.0_f64.sqrt());
    let z = 1.0 - (2 * k + 1) as f64 / count as f64;
    let (sin, cos) = maths::sin_cos(golden_angle * k as f64);
    let radius = (1.0 - z * z).sqrt();
    DVec3::new(radius * cos, radius * sin, z)
}
