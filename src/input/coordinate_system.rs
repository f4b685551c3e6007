//! Conversion between the caller's coordinate systems and the internal one.
//!
//! The internal one is right-handed, in metres: x to the right, y up, z backwards (towards a viewer who looks forward),
//! front faces counter-clockwise. It is also the default, so the default conversion is the identity.

use glam::DVec3;

use crate::error::{Error, ErrorKind, Result};

/// A direction along one of the caller's coordinate axes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Axis {
    /// Along +x.
    PositiveX,
    /// Along -x.
    NegativeX,
    /// Along +y.
    PositiveY,
    /// Along -y.
    NegativeY,
    /// Along +z.
    PositiveZ,
    /// Along -z.
    NegativeZ,
}

impl Axis {
    /// The coordinate (0, 1 or 2) and its sign.
    fn parts(self) -> (usize, f64) {
        match self {
            Axis::PositiveX => (0, 1.0),
            Axis::NegativeX => (0, -1.0),
            Axis::PositiveY => (1, 1.0),
            Axis::NegativeY => (1, -1.0),
            Axis::PositiveZ => (2, 1.0),
            Axis::NegativeZ => (2, -1.0),
        }
    }

    fn name(self) -> &'static str {
        match self {
            Axis::PositiveX => "+x",
            Axis::NegativeX => "-x",
            Axis::PositiveY => "+y",
            Axis::NegativeY => "-y",
            Axis::PositiveZ => "+z",
            Axis::NegativeZ => "-z",
        }
    }
}

/// The order of a front face's corners, seen from the front.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Winding {
    /// Counter-clockwise.
    CounterClockwise,
    /// Clockwise.
    Clockwise,
}

/// A coordinate system: which of its axes point to the right, up and forward of the scene, its unit and winding.
///
/// Handedness follows from the axes. Winding is meant as seen by a viewer, as engines state it ("left-handed, y up,
/// clockwise"), and does not depend on the coordinates: a mirrored coordinate system changes the sign of `(b - a) x (c
/// - a)` but not the winding.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CoordinateSystem {
    /// The caller's axis that points to the right.
    pub right: Axis,
    /// The caller's axis that points up.
    pub up: Axis,
    /// The caller's axis that points forward, away from the viewer.
    pub forward: Axis,
    /// Length of the caller's unit in metres.
    pub metres_per_unit: f64,
    /// The caller's winding of front faces.
    pub winding: Winding,
}

impl Default for CoordinateSystem {
    /// The internal coordinate system.
    fn default() -> Self {
        Self {
            right: Axis::PositiveX,
            up: Axis::PositiveY,
            forward: Axis::NegativeZ,
            metres_per_unit: 1.0,
            winding: Winding::CounterClockwise,
        }
    }
}

impl CoordinateSystem {
    /// Refuses an invalid coordinate system; `name` names it in error messages ("target coordinate system").
    ///
    /// # Errors
    /// [`ErrorKind::InvalidArgument`]: two of the axes are along one coordinate, or the unit is not a positive
    /// number between 1e-9 and 1e9 metres.
    pub fn check(&self, name: &str) -> Result<()> {
        let fail = |message: String| Err(Error::new(ErrorKind::InvalidArgument, message));
        let axes = [("right", self.right), ("up", self.up), ("forward", self.forward)];
        for (i, j) in [(0, 1), (0, 2), (1, 2)] {
            let ((direction, axis), (other_direction, other)) = (axes[i], axes[j]);
            if axis.parts().0 == other.parts().0 {
                return fail(format!(
                    "{name}: {direction} is {} and {other_direction} is {}, the axes must be perpendicular to each other",
                    axis.name(),
                    other.name()
                ));
            }
        }
        if !(1e-9..=1e9).contains(&self.metres_per_unit) {
            return fail(format!(
                "{name}: the unit is {} metres, it must be between 1e-9 and 1e9",
                self.metres_per_unit
            ));
        }
        Ok(())
    }

    /// A position in the caller's coordinate system, converted to the internal one. Exact where the unit is the metre
    /// (or a power of two of it): a permutation of the coordinates and their signs.
    #[inline]
    pub fn position_to_internal(&self, p: DVec3) -> DVec3 {
        let take = |axis: Axis| {
            let (k, sign) = axis.parts();
            sign * p[k]
        };
        DVec3::new(take(self.right), take(self.up), -take(self.forward)) * self.metres_per_unit
    }

    /// An internal position in the caller's coordinate system: the inverse of
    /// [`position_to_internal`](Self::position_to_internal), up to the rounding of one division where the unit is not a
    /// power of two metres.
    #[inline]
    pub fn position_from_internal(&self, p: DVec3) -> DVec3 {
        let p = p / self.metres_per_unit;
        let mut own = DVec3::ZERO;
        for (axis, value) in [(self.right, p.x), (self.up, p.y), (self.forward, -p.z)] {
            let (k, sign) = axis.parts();
            own[k] = sign * value;
        }
        own
    }

    /// A triangle converted to the internal winding, and back: turned over where the caller's winding is clockwise. The
    /// first corner stays first.
    #[inline]
    pub fn triangle(&self, [a, b, c]: [u32; 3]) -> [u32; 3] {
        match self.winding {
            Winding::CounterClockwise => [a, b, c],
            Winding::Clockwise => [a, c, b],
        }
    }
}
