//! The frame of a triangle, two edges and a normal, by which a term follows how the triangle deforms.

use glam::{DMat3, DVec3};

use super::surface::SurfaceForm;
use super::{Row, Sink};

/// Below this squared length (of the normalised space, to the fourth) a normal counts as none: the square
/// root has no derivative there.
const NO_NORMAL: f64 = 1e-60;

/// The normal of a triangle in the chosen form, with what its differential
/// `dN = scale dn - pull n (n . dn)` needs.
#[derive(Clone, Copy)]
pub(super) struct Normal {
    pub value: DVec3,
    pub n: DVec3,
    pub scale: f64,
    pub pull: f64,
}

impl Normal {
    /// From `n`, the product of two edges.
    #[inline]
    pub fn new(n: DVec3, form: SurfaceForm) -> Self {
        match form {
            SurfaceForm::Printed => Self { value: n, n, scale: 1.0, pull: 0.0 },
            SurfaceForm::Similarity => {
                let squared = n.length_squared();
                if squared < NO_NORMAL {
                    return Self { value: DVec3::ZERO, n, scale: 0.0, pull: 0.0 };
                }
                let scale = 1.0 / squared.sqrt().sqrt();
                Self { value: n * scale, n, scale, pull: 0.5 * scale / squared }
            }
        }
    }
}

/// Solves `c1 a + c2 b + c3 N = x` by Cramer's rule, N being a multiple of `a x b`; none without a finite answer.
pub(super) fn coefficients(x: DVec3, a: DVec3, b: DVec3, normal: &Normal) -> Option<[f64; 3]> {
    let n = normal.n;
    let squared = n.length_squared();
    let c = [x.cross(b).dot(n) / squared, a.cross(x).dot(n) / squared, x.dot(n) / normal.value.dot(n)];
    c.iter().all(|v| v.is_finite()).then_some(c)
}

/// `s I + [p]x`.
#[inline]
pub(super) fn scaled_cross(s: f64, p: DVec3) -> DMat3 {
    DMat3::from_cols(DVec3::new(s, p.z, -p.y), DVec3::new(-p.z, s, p.x), DVec3::new(p.y, -p.x, s))
}

/// `u v^T`.
#[inline]
pub(super) fn outer(u: DVec3, v: DVec3) -> DMat3 {
    DMat3::from_cols(u * v.x, u * v.y, u * v.z)
}

/// Hands an element `weight |residual|^2` over four vertices to a sink, the Hessian being Gauss-Newton's,
/// `2 weight J^T J`. `jacobian` holds the derivatives of the residual by each of `vertices`.
#[inline]
pub(super) fn least_squares(
    sink: &mut dyn Sink,
    vertices: &[u32; 4],
    jacobian: &[DMat3; 4],
    residual: DVec3,
    weight: f64,
) {
    let by_row = jacobian.map(|j| j.transpose());
    let h = 2.0 * weight;
    let row = |r: usize| Row { components: by_row.map(|j| j.col(r)), t: 0.0, g: h * residual[r], h };
    sink.low_rank(vertices, &[row(0), row(1), row(2)]);
}
