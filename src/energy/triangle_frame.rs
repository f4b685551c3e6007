//! The frame of a triangle, two edges and a normal, by which a term follows the triangle's deformation; and a vertex that is
//! bound to one (deformation transfer, Sumner and Popovic 2004).

use glam::{DMat3, DVec3};

use super::{Row, Sink};

/// Below this squared length (of the normalised space, to the fourth) a normal counts as zero: the square
/// root has no derivative there.
const MIN_SQUARED_NORMAL: f64 = 1e-60;

/// How the normal of a triangle's frame grows with the triangle.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SurfaceForm {
    /// Like an edge: any similarity of the rest shape costs nothing, uniform scale included.
    #[default]
    Similarity,
    /// Like an area, as the paper prints it: a uniform scale costs wherever the rest shape is bent.
    Printed,
}

/// The normal of a triangle in the chosen form, with what its differential
/// `dN = scale dn - radial n (n . dn)` needs.
#[derive(Clone, Copy)]
pub(super) struct Normal {
    pub value: DVec3,
    pub n: DVec3,
    pub scale: f64,
    pub radial: f64,
}

impl Normal {
    /// From `n`, the product of two edges.
    #[inline]
    pub fn new(n: DVec3, form: SurfaceForm) -> Self {
        match form {
            SurfaceForm::Printed => Self { value: n, n, scale: 1.0, radial: 0.0 },
            SurfaceForm::Similarity => {
                let squared = n.length_squared();
                if squared < MIN_SQUARED_NORMAL {
                    return Self { value: DVec3::ZERO, n, scale: 0.0, radial: 0.0 };
                }
                let scale = 1.0 / squared.sqrt().sqrt();
                Self { value: n * scale, n, scale, radial: 0.5 * scale / squared }
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

/// A vertex v in the frame of a triangle (a, b, c), as both lie at rest:
///
/// ```text
/// r = v - a - c1 e1 - c2 e2 - c3 N(e1 x e2),   e1 = b - a,  e2 = c - a,  N(n) = n / sqrt(|n|),
/// ```
///
/// with the coefficients for which r is zero at rest, and so wherever a similarity moves all four.
#[derive(Clone, Copy, Debug)]
pub(super) struct BoundVertex {
    /// `[a, b, c, v]`.
    pub vertices: [u32; 4],
    /// Factors of `e1`, `e2` and the normal.
    factors: [f64; 3],
}

impl BoundVertex {
    /// None for a triangle without area.
    pub fn new(rest: &[DVec3], vertices: [u32; 4]) -> Option<Self> {
        let [a, b, c, v] = vertices.map(|i| rest[i as usize]);
        let (e1, e2) = (b - a, c - a);
        let normal = Normal::new(e1.cross(e2), SurfaceForm::Similarity);
        Some(Self { vertices, factors: coefficients(v - a, e1, e2, &normal)? })
    }

    /// Its frame at the vertices `x`.
    #[inline]
    pub fn at(&self, x: &[DVec3]) -> CurrentBinding {
        let [a, b, c, v] = self.vertices.map(|i| x[i as usize]);
        let (e1, e2) = (b - a, c - a);
        let normal = Normal::new(e1.cross(e2), SurfaceForm::Similarity);
        CurrentBinding { factors: self.factors, e1, e2, arm: v - a, normal }
    }
}

/// A [`BoundVertex`] at a configuration.
pub(super) struct CurrentBinding {
    factors: [f64; 3],
    e1: DVec3,
    e2: DVec3,
    arm: DVec3,
    normal: Normal,
}

impl CurrentBinding {
    /// r.
    #[inline]
    pub fn residual(&self) -> DVec3 {
        let [c1, c2, c3] = self.factors;
        self.arm - self.e1 * c1 - self.e2 * c2 - self.normal.value * c3
    }

    /// Derivatives of r by a, b, c, v.
    #[inline]
    pub fn jacobian(&self) -> [DMat3; 4] {
        let [c1, c2, c3] = self.factors;
        let Normal { n, scale, radial, .. } = self.normal;
        let by_e1 = scaled_cross(c1, self.e2 * (-c3 * scale)) - outer(n * (c3 * radial), self.e2.cross(n));
        let by_e2 = scaled_cross(c2, self.e1 * (c3 * scale)) - outer(n * (c3 * radial), n.cross(self.e1));
        [by_e1 + by_e2 - DMat3::IDENTITY, -by_e1, -by_e2, DMat3::IDENTITY]
    }
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
