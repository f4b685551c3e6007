//! The uniform cubic B-spline in three dimensions on the 4 x 4 x 4 nodes around a cell:
//! `D(p) = sum_ijk c_ijk B_i(u) B_j(v) B_k(w)`.
//!
//! Rows of four nodes along the last axis are contracted along the first two axes first, as vectors; the last axis
//! follows. All functions compute the value by the same operations, and so to the same bits.

use glam::DVec3;

use crate::simd::f64x4::F64x4;

/// The four basis functions, or their derivatives, at a point of a cell.
type Weights = [f64; 4];

/// The basis functions at `t` in [0, 1) of a cell of unit width.
#[inline(always)]
fn basis(t: f64) -> Weights {
    let s = 1.0 - t;
    let (tt, ss) = (t * t, s * s);
    const SIXTH: f64 = 1.0 / 6.0;
    [ss * s * SIXTH, (4.0 + tt * (3.0 * t - 6.0)) * SIXTH, (4.0 + ss * (3.0 * s - 6.0)) * SIXTH, tt * t * SIXTH]
}

/// Their first derivatives.
#[inline(always)]
fn slopes(t: f64) -> Weights {
    let s = 1.0 - t;
    [-0.5 * s * s, t * (1.5 * t - 2.0), -s * (1.5 * s - 2.0), 0.5 * t * t]
}

/// The value at the point `t` of the cell; `row(i, j)` are the nodes (i, j, 0..4).
#[inline(always)]
pub(super) fn value<V: F64x4>(row: impl Fn(usize, usize) -> [f32; 4], t: DVec3) -> f64 {
    let (x, y) = (basis(t.x), basis(t.y));
    let mut sum = V::splat(0.0);
    for (i, &wx) in x.iter().enumerate() {
        let mut plane = V::splat(0.0);
        for (j, &wy) in y.iter().enumerate() {
            plane = plane.add_scaled(wy, V::widen(row(i, j)));
        }
        sum = sum.add_scaled(wx, plane);
    }
    sum.dot(basis(t.z))
}

/// The value and the gradient (for a cell of unit width).
#[inline(always)]
pub(super) fn value_gradient<V: F64x4>(row: impl Fn(usize, usize) -> [f32; 4], t: DVec3) -> (f64, DVec3) {
    let (x, y, z) = (basis(t.x), basis(t.y), basis(t.z));
    let (dx, dy) = (slopes(t.x), slopes(t.y));
    let (mut sum, mut by_x, mut by_y) = (V::splat(0.0), V::splat(0.0), V::splat(0.0));
    for (i, (&wx, dx)) in x.iter().zip(dx).enumerate() {
        let (mut plane, mut plane_y) = (V::splat(0.0), V::splat(0.0));
        for (j, (&wy, &dy)) in y.iter().zip(&dy).enumerate() {
            let row = V::widen(row(i, j));
            plane = plane.add_scaled(wy, row);
            plane_y = plane_y.add_scaled(dy, row);
        }
        sum = sum.add_scaled(wx, plane);
        by_x = by_x.add_scaled(dx, plane);
        by_y = by_y.add_scaled(wx, plane_y);
    }
    (sum.dot(z), DVec3::new(by_x.dot(z), by_y.dot(z), sum.dot(slopes(t.z))))
}
