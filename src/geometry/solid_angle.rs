//! The solid angle of a triangle. Over a closed surface they sum up to 4 pi times its winding number.

use std::f64::consts::PI;

use glam::DVec3;

use super::mesh::TriangleMesh;
use crate::maths;

/// The solid angle, in steradians, under which `p` sees a triangle with these corners: positive where it sees the back
/// (Van Oosterom and Strackee 1983).
pub fn solid_angle(p: DVec3, corners: [DVec3; 3]) -> f64 {
    let [a, b, c] = corners.map(|corner| corner - p);
    let [la, lb, lc] = [a, b, c].map(DVec3::length);
    let below = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
    2.0 * maths::atan2(a.dot(b.cross(c)), below)
}

/// How often `triangles` of `mesh` wind around `p`: the solid angle under which it sees them, over 4 pi. Of a closed surface that
/// faces outwards 1 inside and 0 outside, where triangles are missing something between.
pub fn winding(mesh: &TriangleMesh, triangles: impl IntoIterator<Item = u32>, p: DVec3) -> f64 {
    triangles.into_iter().map(|t| solid_angle(p, mesh.corners(t))).sum::<f64>() / (4.0 * PI)
}
