//! The floating-point format in which a caller stores positions, and its rounding error.

use glam::DVec3;

use crate::geometry::mesh::TriangleMesh;

/// Floating-point format of a caller's positions.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Precision {
    /// 32-bit.
    #[default]
    F32,
    /// 64-bit.
    F64,
}

impl Precision {
    /// `p` as a caller reads it who stores this format.
    pub fn round(self, p: DVec3) -> DVec3 {
        match self {
            Self::F32 => p.as_vec3().as_dvec3(),
            Self::F64 => p,
        }
    }

    /// The other one.
    pub(crate) fn other(self) -> Self {
        match self {
            Self::F32 => Self::F64,
            Self::F64 => Self::F32,
        }
    }

    /// The most that a coordinate is moved where a result on the body `avatar` is stored in this format, in its unit.
    pub(crate) fn error_near(self, avatar: &TriangleMesh) -> f64 {
        let corners = avatar.triangles.iter().flatten().map(|&v| avatar.positions[v as usize]);
        let (low, high) = corners.fold((DVec3::MAX, DVec3::MIN), |(l, h), p| (l.min(p), h.max(p)));
        // A garment may reach beyond the body.
        let largest = low.abs().max(high.abs()).max_element() + (high - low).max_element();
        match self {
            Self::F32 => 0.5 * largest * f64::from(f32::EPSILON),
            // Computations in 64 bits are rounded, too.
            Self::F64 => 4.0 * largest * f64::EPSILON,
        }
    }
}
