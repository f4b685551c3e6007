//! What a session is given: meshes, skeletons, weights, spaces.

use crate::capi::session::{BespokeSession, call};
use crate::capi::sized::{self, Sized32};
use crate::capi::status::BespokeStatus;
use crate::capi::view::{self, BespokeView, invalid};
use crate::error::Result;
use crate::geometry::mesh::TriangleMesh;
use crate::input::buffer;
use crate::input::coordinate_system::{Axis, CoordinateSystem, Winding};
use crate::input::skeleton::Skeleton;
use crate::input::skin::SkinWeights;
use crate::session::Precision;

/// The mesh, and the precision of its positions.
///
/// # Safety
/// Each pointer is null or points to a view that tells the truth.
pub(super) unsafe fn mesh(
    positions: *const BespokeView,
    triangles: *const BespokeView,
    what: &str,
) -> Result<(TriangleMesh, Precision)> {
    let (points, corners) = (format!("{what} positions"), format!("{what} triangles"));
    // SAFETY: passed on from the caller.
    unsafe {
        let view = view::floats(positions, &points)?;
        let mesh = TriangleMesh {
            positions: buffer::read_positions(&view, &points)?,
            triangles: buffer::read_triangles(&view::indices(triangles, &corners)?, &corners)?,
        };
        Ok((mesh, view::precision_of(view.component)))
    }
}

/// # Safety
/// Each pointer is null or points to a view that tells the truth.
unsafe fn skeleton(joints: *const BespokeView, bones: *const BespokeView, what: &str) -> Result<Skeleton> {
    let (points, pairs) = (format!("{what} joints"), format!("{what} bones"));
    // SAFETY: passed on from the caller.
    unsafe {
        Ok(Skeleton {
            joints: buffer::read_positions(&view::floats(joints, &points)?, &points)?,
            bones: buffer::read_pairs(&view::indices(bones, &pairs)?, &pairs)?,
        })
    }
}

/// The garment as it was modelled, around the source skeleton.
///
/// `positions`: points, F32 or F64; the result is verified in this precision. `triangles`: three vertices each, U16
/// or U32. It may be open and in pieces. Ownership: copied during the call. State: SETUP; a second call replaces the
/// first. Errors: INVALID_ARGUMENT, INVALID_MESH (no vertices, no triangles, an index out of range, a coordinate that
/// is not finite), INVALID_STATE, BUSY, INTERNAL. Threads: any, one at a time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bespoke_session_set_garment(
    session: *mut BespokeSession,
    positions: *const BespokeView,
    triangles: *const BespokeView,
) -> BespokeStatus {
    // SAFETY: passed on from the caller.
    unsafe {
        call(session, |session| {
            let (mesh, precision) = mesh(positions, triangles, "garment")?;
            session.set_garment(mesh, precision)
        })
    }
}

/// The skeleton around which the garment was modelled, in the space of the garment.
///
/// `joints`: points, F32 or F64. `bones`: two joints each, U16 or U32; order and direction are free. Ownership: copied
/// during the call. State: SETUP. Errors: INVALID_ARGUMENT, INVALID_SKELETON, INVALID_STATE, BUSY, INTERNAL. Threads:
/// any, one at a time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bespoke_session_set_source_skeleton(
    session: *mut BespokeSession,
    joints: *const BespokeView,
    bones: *const BespokeView,
) -> BespokeStatus {
    // SAFETY: passed on from the caller.
    unsafe { call(session, |session| session.set_source_skeleton(skeleton(joints, bones, "source skeleton")?)) }
}

/// The body to dress. It may be open, non-manifold, in pieces, and may intersect itself.
///
/// `positions`: points, F32 or F64. `triangles`: three vertices each, U16 or U32. Ownership: copied during the call.
/// State: SETUP. Errors: INVALID_ARGUMENT, INVALID_MESH, INVALID_STATE, BUSY, INTERNAL. Threads: any, one at a time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bespoke_session_set_target_avatar(
    session: *mut BespokeSession,
    positions: *const BespokeView,
    triangles: *const BespokeView,
) -> BespokeStatus {
    // SAFETY: passed on from the caller.
    unsafe {
        call(session, |session| {
            let (mesh, _) = mesh(positions, triangles, "target avatar")?;
            session.set_target_avatar(mesh)
        })
    }
}

/// The skeleton of the body to dress, in its space and in the pose of the source skeleton. Joint i corresponds to
/// joint i of the source skeleton, and the same pairs of joints are bones.
///
/// `joints`, `bones`: as for the source skeleton. Ownership: copied during the call. State: SETUP. Errors:
/// INVALID_ARGUMENT, INVALID_SKELETON (another topology may be found only by bespoke_session_prepare), INVALID_STATE,
/// BUSY, INTERNAL. Threads: any, one at a time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bespoke_session_set_target_skeleton(
    session: *mut BespokeSession,
    joints: *const BespokeView,
    bones: *const BespokeView,
) -> BespokeStatus {
    // SAFETY: passed on from the caller.
    unsafe { call(session, |session| session.set_target_skeleton(skeleton(joints, bones, "target skeleton")?)) }
}

/// Optional: the body on which the garment was designed, in the space of the garment. With it, the fit aims at the
/// looseness of the design.
///
/// `positions`, `triangles`: as for the target avatar. Ownership: copied during the call. State: SETUP. Errors:
/// INVALID_ARGUMENT, INVALID_MESH, INVALID_STATE, BUSY, INTERNAL. Threads: any, one at a time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bespoke_session_set_source_avatar(
    session: *mut BespokeSession,
    positions: *const BespokeView,
    triangles: *const BespokeView,
) -> BespokeStatus {
    // SAFETY: passed on from the caller.
    unsafe { call(session, |session| session.set_source_avatar(mesh(positions, triangles, "source avatar")?.0)) }
}

const SKIN: &str = "target skin weights";

/// Optional: skin weights of the target avatar as a full matrix, one row a joint. Without them, the nearest bone
/// decides to which part of the body a vertex belongs.
///
/// `rows`: one element for each joint, F32 or F64, each of them `vertices` numbers; its stride leads from row to row.
/// Weights are finite and not negative; those of a vertex need not sum to 1. Ownership: copied during the call. State:
/// SETUP. Errors: INVALID_ARGUMENT, INVALID_WEIGHTS (a wrong size may be found only by bespoke_session_prepare),
/// INVALID_STATE, BUSY, INTERNAL. Threads: any, one at a time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bespoke_session_set_target_skin_weights(
    session: *mut BespokeSession,
    rows: *const BespokeView,
    vertices: usize,
) -> BespokeStatus {
    // SAFETY: passed on from the caller.
    unsafe {
        call(session, |session| {
            let view = view::floats(rows, SKIN)?;
            let weights = buffer::read_rows(&view, vertices, SKIN)?;
            session.set_target_skin(SkinWeights::from_dense(&weights, view.count, vertices, SKIN)?)
        })
    }
}

/// Optional: skin weights of the target avatar as engines keep them, a few joints with their weights for each vertex.
///
/// `joints`: one element for each vertex, U16 or U32, each of them `influences` joints (from 0). `weights`: the same
/// with F32 or F64. A joint with weight 0 is not looked at. `joint_count`: joints of the target skeleton. All else as
/// for bespoke_session_set_target_skin_weights, which this replaces.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bespoke_session_set_target_skin_influences(
    session: *mut BespokeSession,
    joints: *const BespokeView,
    weights: *const BespokeView,
    influences: usize,
    joint_count: usize,
) -> BespokeStatus {
    // SAFETY: passed on from the caller.
    unsafe {
        call(session, |session| {
            let (joint_view, weight_view) = (view::indices(joints, SKIN)?, view::floats(weights, SKIN)?);
            if joint_view.count != weight_view.count {
                return invalid(format!(
                    "{SKIN}: there are joints for {} vertices and weights for {}",
                    joint_view.count, weight_view.count
                ));
            }
            let joints = buffer::read_indices(&joint_view, influences, SKIN)?;
            let weights = buffer::read_rows(&weight_view, influences, SKIN)?;
            let vertices = joint_view.count;
            session.set_target_skin(SkinWeights::from_sparse(
                &joints,
                &weights,
                influences,
                joint_count,
                vertices,
                SKIN,
            )?)
        })
    }
}

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

/// How the corners of a front face follow each other for somebody who looks at its front.
#[repr(u32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BespokeWinding {
    /// Against the hands of a clock.
    CounterClockwise = 0,
    /// With the hands of a clock.
    Clockwise = 1,
}

/// A coordinate system. Zero in a field means its default; handedness follows from the axes, which must be along three
/// different coordinates.
///
/// Right, up, forward and unit of some: Unreal +y, +z, +x, 0.01; Unity +x, +y, +z, 1; Godot and glTF as by default; Maya as by
/// default but 0.01; Blender +x, +z, +y, 1.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BespokeCoordinateSystem {
    /// sizeof(BespokeCoordinateSystem).
    pub struct_size: u32,
    /// The axis to the right, one of BespokeAxis. Default: +x.
    pub right: u32,
    /// The axis upwards, one of BespokeAxis. Default: +y.
    pub up: u32,
    /// The axis forwards, into the picture, one of BespokeAxis. Default: -z.
    pub forward: u32,
    /// Length of the unit in metres [1e-9, 1e9]. Default: 1.
    pub metres_per_unit: f64,
    /// Of front faces, one of BespokeWinding. Default: counter-clockwise.
    pub winding: u32,
    /// 0.
    pub reserved: u32,
}

// SAFETY: repr(C) of u32 pairs and f64 without padding.
unsafe impl Sized32 for BespokeCoordinateSystem {}

impl BespokeCoordinateSystem {
    fn to_space(self, what: &str) -> Result<CoordinateSystem> {
        let default = CoordinateSystem::default();
        let axis = |code: u32, default: Axis, name: &str| match code {
            0 => Ok(default),
            1 => Ok(Axis::PositiveX),
            2 => Ok(Axis::NegativeX),
            3 => Ok(Axis::PositiveY),
            4 => Ok(Axis::NegativeY),
            5 => Ok(Axis::PositiveZ),
            6 => Ok(Axis::NegativeZ),
            _ => invalid(format!("{what}: {name} is {code}; it must be one of BespokeAxis")),
        };
        if self.reserved != 0 {
            return invalid(format!("{what}: reserved is {}; it must be 0", self.reserved));
        }
        Ok(CoordinateSystem {
            right: axis(self.right, default.right, "right")?,
            up: axis(self.up, default.up, "up")?,
            forward: axis(self.forward, default.forward, "forward")?,
            metres_per_unit: if self.metres_per_unit == 0.0 { default.metres_per_unit } else { self.metres_per_unit },
            winding: match self.winding {
                0 => Winding::CounterClockwise,
                1 => Winding::Clockwise,
                other => return invalid(format!("{what}: winding is {other}; it must be one of BespokeWinding")),
            },
        })
    }
}

/// Optional: the space of garment, source skeleton and source avatar, where it is not that of the target.
///
/// State: SETUP. Errors: INVALID_ARGUMENT (null, struct_size, two axes along one coordinate, an absurd unit),
/// INVALID_STATE, BUSY, INTERNAL. Threads: any, one at a time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bespoke_session_set_source_coordinate_system(
    session: *mut BespokeSession,
    space: *const BespokeCoordinateSystem,
) -> BespokeStatus {
    let what = "source space";
    // SAFETY: passed on from the caller.
    unsafe { call(session, |session| session.set_source_coordinate_system(sized::read(space, what)?.to_space(what)?)) }
}

/// Optional: the space of target avatar and target skeleton, and so of the vertices that are read.
///
/// State, errors, threads: as for bespoke_session_set_source_coordinate_system.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bespoke_session_set_target_coordinate_system(
    session: *mut BespokeSession,
    space: *const BespokeCoordinateSystem,
) -> BespokeStatus {
    let what = "target space";
    // SAFETY: passed on from the caller.
    unsafe { call(session, |session| session.set_target_coordinate_system(sized::read(space, what)?.to_space(what)?)) }
}
