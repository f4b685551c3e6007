//! The uniform cubic B-spline in three dimensions on the 4 x 4 x 4 nodes around a cell:
//! `D(p) = sum_ijk c_ijk B_i(u) B_j(v) B_k(w)`.

use glam::{DMat3, DVec3};

/// The coefficients around a cell: node (i, j, k) is entry 16 i + 4 j + k.
pub(super) type Coefficients = [f64; 64];

/// The four basis functions, and their first and second derivatives, at `t` in [0, 1) of a cell of unit width.
#[inline]
fn basis(t: f64) -> [[f64; 4]; 3] {
    let s = 1.0 - t;
    let (tt, ss) = (t * t, s * s);
    [
        [ss * s / 6.0, (4.0 + tt * (3.0 * t - 6.0)) / 6.0, (4.0 + ss * (3.0 * s - 6.0)) / 6.0, tt * t / 6.0],
        [-0.5 * ss, t * (1.5 * t - 2.0), -s * (1.5 * s - 2.0), 0.5 * tt],
        [s, 3.0 * t - 2.0, 3.0 * s - 2.0, t],
    ]
}

/// The derivatives of order (a, b, c) along the axes with a + b + c < N, as entry `[a][b][c]`, at the point
/// `t` of the cell. The others are 0.
#[inline]
fn contract<const N: usize>(c: &Coefficients, t: DVec3) -> [[[f64; N]; N]; N] {
    let (x, y, z) = (basis(t.x), basis(t.y), basis(t.z));
    let mut out = [[[0.0; N]; N]; N];
    for i in 0..4 {
        let mut plane = [[0.0; N]; N];
        for j in 0..4 {
            let row = &c[16 * i + 4 * j..][..4];
            for (oz, wz) in z.iter().enumerate().take(N) {
                let along = (row[0] * wz[0] + row[1] * wz[1]) + (row[2] * wz[2] + row[3] * wz[3]);
                for (oy, wy) in y.iter().enumerate().take(N - oz) {
                    plane[oy][oz] += wy[j] * along;
                }
            }
        }
        for (ox, wx) in x.iter().enumerate().take(N) {
            for oy in 0..N - ox {
                for oz in 0..N - ox - oy {
                    out[ox][oy][oz] += wx[i] * plane[oy][oz];
                }
            }
        }
    }
    out
}

/// The value at the point `t` of the cell.
#[inline]
pub(super) fn value(c: &Coefficients, t: DVec3) -> f64 {
    contract::<1>(c, t)[0][0][0]
}

/// The value and the gradient (for a cell of unit width).
#[inline]
pub(super) fn value_gradient(c: &Coefficients, t: DVec3) -> (f64, DVec3) {
    let d = contract::<2>(c, t);
    (d[0][0][0], DVec3::new(d[1][0][0], d[0][1][0], d[0][0][1]))
}

/// The value, the gradient and the Hessian (for a cell of unit width).
#[inline]
pub(super) fn value_gradient_hessian(c: &Coefficients, t: DVec3) -> (f64, DVec3, DMat3) {
    let d = contract::<3>(c, t);
    let (xy, xz, yz) = (d[1][1][0], d[1][0][1], d[0][1][1]);
    let hessian = DMat3::from_cols_array(&[d[2][0][0], xy, xz, xy, d[0][2][0], yz, xz, yz, d[0][0][2]]);
    (d[0][0][0], DVec3::new(d[1][0][0], d[0][1][0], d[0][0][1]), hessian)
}
