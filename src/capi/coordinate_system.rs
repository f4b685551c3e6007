//! Axes, unit and winding of the caller's coordinates.

use crate::capi::session::{BespokeSession, call};
use crate::capi::sized::{self, Sized32};
use crate::capi::status::BespokeStatus;
use crate::capi::view::invalid;
use crate::error::Result;
use crate::input::coordinate_system::{Axis, CoordinateSystem, Winding};

/// A direction along one axis of the caller's coordinates.
#[repr(u32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BespokeAxis {
    /// +x
    PositiveX = 1,
    /// -x
    NegativeX = 2,
    /// +y
    PositiveY = 3,
    /// -y
    NegativeY = 4,
    /// +z
    PositiveZ = 5,
    /// -z
    NegativeZ = 6,
}

/// The order of a front face's corners, seen from the front.
#[repr(u32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BespokeWinding {
    /// Counter-clockwise.
    CounterClockwise = 0,
    /// Clockwise.
    Clockwise = 1,
}

/// A coordinate system. Zero in a field means its default; handedness follows from the axes, which must be along three
/// different coordinates.
///
/// Right, up, forward and unit of some: Unreal +y, +z, +x, 0.01; Unity +x, +y, +z, 1; Godot and glTF as by default;
/// Maya as by default but 0.01; Blender +x, +z, +y, 1.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BespokeCoordinateSystem {
    /// sizeof(BespokeCoordinateSystem).
    pub struct_size: u32,
    /// The axis that points to the right, one of BespokeAxis. Default: +x.
    pub right: u32,
    /// The axis that points up, one of BespokeAxis. Default: +y.
    pub up: u32,
    /// The axis that points forward, away from the viewer, one of BespokeAxis. Default: -z.
    pub forward: u32,
    /// Length of the unit in metres [1e-9, 1e9]. Default: 1.
    pub metres_per_unit: f64,
    /// Of front faces, one of BespokeWinding. Default: counter-clockwise.
    pub winding: u32,
    /// 1: it is right as it is. What is given in it is not compared with the rest for unit, axes, facing and sides, and
    /// neither turned nor refused for them. Default 0.
    pub trusted: u32,
}

// SAFETY: repr(C) of u32 pairs and f64 without padding.
unsafe impl Sized32 for BespokeCoordinateSystem {}

impl BespokeCoordinateSystem {
    fn to_internal(self, name: &str) -> Result<CoordinateSystem> {
        let default = CoordinateSystem::default();
        let axis = |code: u32, default: Axis, direction: &str| match code {
            0 => Ok(default),
            1 => Ok(Axis::PositiveX),
            2 => Ok(Axis::NegativeX),
            3 => Ok(Axis::PositiveY),
            4 => Ok(Axis::NegativeY),
            5 => Ok(Axis::PositiveZ),
            6 => Ok(Axis::NegativeZ),
            _ => invalid(format!("{name}: {direction} is {code}; it must be one of BespokeAxis")),
        };
        if self.trusted > 1 {
            return invalid(format!("{name}: trusted is {}; it must be 0 or 1", self.trusted));
        }
        Ok(CoordinateSystem {
            right: axis(self.right, default.right, "right")?,
            up: axis(self.up, default.up, "up")?,
            forward: axis(self.forward, default.forward, "forward")?,
            metres_per_unit: if self.metres_per_unit == 0.0 { default.metres_per_unit } else { self.metres_per_unit },
            winding: match self.winding {
                0 => Winding::CounterClockwise,
                1 => Winding::Clockwise,
                other => return invalid(format!("{name}: winding is {other}; it must be one of BespokeWinding")),
            },
            trusted: self.trusted == 1,
        })
    }
}

/// Optional: the coordinate system of garment, source skeleton and source avatar; by default right-handed, in metres, y
/// up.
///
/// State: SETUP. Errors: INVALID_ARGUMENT (null, struct_size, two axes along one coordinate, a unit outside [1e-9, 1e9]
/// metres), INVALID_STATE, BUSY, INTERNAL. Threads: any, one at a time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bespoke_session_set_source_coordinate_system(
    session: *mut BespokeSession,
    coordinate_system: *const BespokeCoordinateSystem,
) -> BespokeStatus {
    let name = "source coordinate system";
    // SAFETY: passed on from the caller.
    unsafe {
        call(session, |session| {
            session.set_source_coordinate_system(sized::read(coordinate_system, name)?.to_internal(name)?)
        })
    }
}

/// Optional: the coordinate system of target avatar and target skeleton, and so of the vertices that are read.
///
/// State, errors, threads: as for bespoke_session_set_source_coordinate_system.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bespoke_session_set_target_coordinate_system(
    session: *mut BespokeSession,
    coordinate_system: *const BespokeCoordinateSystem,
) -> BespokeStatus {
    let name = "target coordinate system";
    // SAFETY: passed on from the caller.
    unsafe {
        call(session, |session| {
            session.set_target_coordinate_system(sized::read(coordinate_system, name)?.to_internal(name)?)
        })
    }
}
