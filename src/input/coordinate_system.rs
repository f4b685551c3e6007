//! Conversion between the caller's coordinate systems and the internal one.
//!
//! The internal one is right-handed, in metres: x to the right, y up, z backwards (towards a viewer who looks forward),
//! front faces counter-clockwise. It is also the default, so the default conversion is the identity.

use glam::{DAffine3, DVec3};

use crate::error::{Error, ErrorKind, Result};
use crate::maths;

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

    /// The axis along coordinate `k` (0, 1 or 2), in the direction of `sign`.
    fn along(k: usize, sign: f64) -> Self {
        let both = match k {
            0 => [Axis::PositiveX, Axis::NegativeX],
            1 => [Axis::PositiveY, Axis::NegativeY],
            _ => [Axis::PositiveZ, Axis::NegativeZ],
        };
        both[usize::from(sign < 0.0)]
    }

    /// "+x", "-x" and so on.
    pub fn name(self) -> &'static str {
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
    /// It is right as it is: unit, axes, facing and sides of what is given in it are not compared with the rest, and nothing
    /// is turned or refused for them.
    pub trusted: bool,
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
            trusted: false,
        }
    }
}

impl CoordinateSystem {
    /// This system as it has to be told where what is given in it is to be turned by `turn` as well, which is meant
    /// internally.
    pub fn turned(&self, turn: AxisTurn) -> Self {
        // The rows of the map from the caller's coordinates to the internal ones.
        let back = self.forward.parts();
        let own = [self.right.parts(), self.up.parts(), (back.0, -back.1)];
        let [right, up, back] = turn.rows.map(|(k, sign)| (own[k].0, own[k].1 * sign));
        let axis = |(k, sign): (usize, f64)| Axis::along(k, sign);
        Self { right: axis(right), up: axis(up), forward: axis((back.0, -back.1)), ..*self }
    }

    /// An internal turn as it is in the caller's coordinates.
    pub fn turn_from_internal(&self, turn: AxisTurn) -> AxisTurn {
        let image = |k: usize| {
            let unit = DVec3::AXES[k];
            let forth = turn.apply(self.position_to_internal(unit));
            self.position_from_internal(forth)
        };
        AxisTurn::from_columns([0, 1, 2].map(image))
    }

    /// An internal turn by some degrees about coordinate `k` (0, 1 or 2) as it is in the caller's coordinates: about which axis,
    /// and by how many degrees, not negative.
    pub fn turn_about_from_internal(&self, k: usize, degrees: f64) -> (Axis, f64) {
        let image = |k: usize| self.position_from_internal(DVec3::AXES[k]);
        // A mirror turns the sense of a turn about.
        let sense = image(0).cross(image(1)).dot(image(2)).signum() * degrees.signum();
        let along = image(k) * sense;
        let own = (0..3).max_by(|&a, &b| along[a].abs().total_cmp(&along[b].abs())).unwrap_or(k);
        (Axis::along(own, along[own]), degrees.abs())
    }

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

    /// The map of [`Self::position_to_internal`], for transforms.
    pub fn affine_to_internal(&self) -> DAffine3 {
        let origin = self.position_to_internal(DVec3::ZERO);
        let axis = |v: DVec3| self.position_to_internal(v) - origin;
        DAffine3::from_cols(axis(DVec3::X), axis(DVec3::Y), axis(DVec3::Z), origin)
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

/// A turn that maps the axes onto each other, as between two conventions for axes: one of 24 rotations, or with a mirror
/// one of 48.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AxisTurn {
    /// For each coordinate of the image, the coordinate that it is and its sign.
    rows: [(usize, f64); 3],
}

impl AxisTurn {
    /// No turn.
    pub const IDENTITY: Self = Self { rows: [(0, 1.0), (1, 1.0), (2, 1.0)] };

    /// All 24 rotations, the smaller first.
    pub fn rotations() -> Vec<Self> {
        let mut all: Vec<Self> = Self::all().into_iter().filter(|turn| turn.determinant() > 0.0).collect();
        all.sort_by(|a, b| a.degrees().total_cmp(&b.degrees()));
        all
    }

    /// The mirrors along one coordinate.
    pub fn mirrors() -> [Self; 3] {
        [0, 1, 2].map(|axis| {
            let mut mirror = Self::IDENTITY;
            mirror.rows[axis].1 = -1.0;
            mirror
        })
    }

    fn all() -> Vec<Self> {
        let mut all = Vec::new();
        for [i, j, k] in [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]] {
            for signs in 0..8 {
                let sign = |bit: u32| if signs >> bit & 1 == 0 { 1.0 } else { -1.0 };
                all.push(Self { rows: [(i, sign(0)), (j, sign(1)), (k, sign(2))] });
            }
        }
        all
    }

    fn from_columns(columns: [DVec3; 3]) -> Self {
        let row = |r: usize| {
            let entries = columns.map(|column| column[r]);
            let k = (0..3).max_by(|&a, &b| entries[a].abs().total_cmp(&entries[b].abs())).unwrap_or(0);
            (k, entries[k].signum())
        };
        Self { rows: [0, 1, 2].map(row) }
    }

    /// The image of a point.
    #[inline]
    pub fn apply(&self, p: DVec3) -> DVec3 {
        let [x, y, z] = self.rows.map(|(k, sign)| sign * p[k]);
        DVec3::new(x, y, z)
    }

    /// `self` after `first`.
    pub fn after(&self, first: Self) -> Self {
        Self { rows: self.rows.map(|(k, sign)| (first.rows[k].0, sign * first.rows[k].1)) }
    }

    fn columns(&self) -> [DVec3; 3] {
        DVec3::AXES.map(|unit| self.apply(unit))
    }

    /// 1 for a rotation, -1 with a mirror.
    pub fn determinant(&self) -> f64 {
        let [x, y, z] = self.columns();
        x.cross(y).dot(z)
    }

    /// The angle of a rotation, from 0 to 180 degrees.
    pub fn degrees(&self) -> f64 {
        let trace: f64 = self.rows.iter().enumerate().filter(|(r, row)| *r == row.0).map(|(_, row)| row.1).sum();
        maths::acos((0.5 * (trace - 1.0)).clamp(-1.0, 1.0)).to_degrees().round()
    }

    /// The axis of a rotation, in whole numbers; its sense is that of the right hand in right-handed coordinates.
    pub fn axis(&self) -> [i32; 3] {
        let [x, y, z] = self.columns();
        let twisted = DVec3::new(y.z - z.y, z.x - x.z, x.y - y.x);
        let axis = if twisted.length() > 0.5 {
            twisted
        } else {
            // A half turn, or none: what stays. Each of the columns of 1 + R is along the axis.
            let stays = [x + DVec3::X, y + DVec3::Y, z + DVec3::Z];
            stays.into_iter().max_by(|a, b| a.length_squared().total_cmp(&b.length_squared())).unwrap_or(DVec3::Y)
        };
        let unit = axis / axis.abs().max_element().max(1e-9);
        unit.to_array().map(|x| x.round() as i32)
    }
}
