//! The frame of a triangle, two edges and a normal, by which a term follows how the triangle deforms.

use glam::{DMat3, DVec3};

use super::Sink;
use super::surface::SurfaceForm;

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

/// Hands elements `weight |residual|^2` over four vertices to a sink, the Hessian being Gauss-Newton's,
/// `2 weight J^T J`. Keeps its memory between elements.
pub(super) struct LeastSquares {
    rows: [[f64; 12]; 3],
    block: [f64; 144],
}

impl LeastSquares {
    pub fn new() -> Self {
        Self { rows: [[0.0; 12]; 3], block: [0.0; 144] }
    }

    /// Adds one element; `jacobian` holds the derivatives of the residual by each of `vertices`.
    #[inline]
    pub fn add(
        &mut self,
        sink: &mut dyn Sink,
        vertices: &[u32; 4],
        jacobian: &[DMat3; 4],
        residual: DVec3,
        weight: f64,
    ) {
        let force = residual * (2.0 * weight);
        let root = (2.0 * weight).sqrt();
        for (i, j) in jacobian.iter().enumerate() {
            for (c, column) in [j.x_axis, j.y_axis, j.z_axis].into_iter().enumerate() {
                let column = column * root;
                self.rows[0][3 * i + c] = column.x;
                self.rows[1][3 * i + c] = column.y;
                self.rows[2][3 * i + c] = column.z;
            }
            let gradient = DVec3::new(force.dot(j.x_axis), force.dot(j.y_axis), force.dot(j.z_axis));
            sink.gradient(vertices[i], gradient);
        }
        let [r0, r1, r2] = &self.rows;
        for (a, line) in self.block.chunks_exact_mut(12).enumerate() {
            for (b, entry) in line.iter_mut().enumerate() {
                *entry = r0[a] * r0[b] + r1[a] * r1[b] + r2[a] * r2[b];
            }
        }
        sink.block(vertices, &self.block);
    }
}
