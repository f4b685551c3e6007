//! The mollifier of nearly parallel edges (IPC, Li et al. 2020, section 4.3):
//! `m(c) = (2 - c / eps) c / eps` for `c = |u x v|^2 < eps`, and 1 beyond, with
//! `eps = 1e-3 |u|^2 |v|^2` of the edges at rest.
//!
//! The distance of two edges has a kink where they are parallel; m takes the barrier to zero there.

use glam::DVec3;

/// `eps` from the four vertices of two edges at rest.
#[inline]
pub fn threshold(rest: &[DVec3; 4]) -> f64 {
    1e-3 * (rest[1] - rest[0]).length_squared() * (rest[3] - rest[2]).length_squared()
}

/// m of the edges (0, 1) and (2, 3).
#[inline]
pub fn value(x: &[DVec3; 4], threshold: f64) -> f64 {
    let c = (x[1] - x[0]).cross(x[3] - x[2]).length_squared();
    if c >= threshold { 1.0 } else { (2.0 - c / threshold) * (c / threshold) }
}

/// m, and its gradient at the four vertices where it is not constant.
#[inline]
pub fn value_and_gradient(x: &[DVec3; 4], threshold: f64) -> (f64, Option<[DVec3; 4]>) {
    let (u, v) = (x[1] - x[0], x[3] - x[2]);
    let n = u.cross(v);
    let c = n.length_squared();
    if c >= threshold {
        return (1.0, None);
    }
    let ratio = c / threshold;
    // dm/dc times the 2 of d|n|^2.
    let scale = 4.0 * (1.0 - ratio) / threshold;
    let (du, dv) = (scale * v.cross(n), scale * n.cross(u));
    ((2.0 - ratio) * ratio, Some([-du, du, -dv, dv]))
}
