//! Meshes, skeletons and skin weights of a session.

use crate::capi::session::{BespokeSession, call};
use crate::capi::status::BespokeStatus;
use crate::capi::view::{self, BespokeView, invalid};
use crate::error::Result;
use crate::geometry::mesh::TriangleMesh;
use crate::input::buffer;
use crate::input::skeleton::Skeleton;
use crate::input::skin::SkinWeights;
use crate::session::Precision;

/// The mesh, and the precision of its positions.
///
/// # Safety
/// Each pointer is null or points to a valid view.
pub(super) unsafe fn mesh(
    positions: *const BespokeView,
    triangles: *const BespokeView,
    name: &str,
) -> Result<(TriangleMesh, Precision)> {
    let (points, corners) = (format!("{name} positions"), format!("{name} triangles"));
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
/// Each pointer is null or points to a valid view.
unsafe fn skeleton(joints: *const BespokeView, bones: *const BespokeView, name: &str) -> Result<Skeleton> {
    let (points, pairs) = (format!("{name} joints"), format!("{name} bones"));
    // SAFETY: passed on from the caller.
    unsafe {
        Ok(Skeleton {
            joints: buffer::read_positions(&view::floats(joints, &points)?, &points)?,
            bones: buffer::read_pairs(&view::indices(bones, &pairs)?, &pairs)?,
        })
    }
}

/// The garment as it was modelled, enclosing the source skeleton.
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

/// The skeleton that the garment was modelled around, in the coordinate system of the garment.
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

/// The skeleton of the body to dress, in its coordinate system and in the pose of the source skeleton. Joint i
/// corresponds to joint i of the source skeleton, and the same pairs of joints are bones.
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

/// Optional: the body on which the garment was designed, in the coordinate system of the garment. With it, the fit aims
/// at the clearance of the design. Where the garment is refused (NOT_ENCLOSED, INFLATION_STALLED) and this body passes through
/// it, as a head through its hat, it is tried once more with the garment as a part of this body, unless the option strict is
/// set: see BESPOKE_DIAGNOSTIC_KIND_SOURCE_DRESSED. A floor, a dome or another figure in its mesh is left out, with a diagnostic
/// (BESPOKE_DIAGNOSTIC_KIND_FOREIGN_PART), unless the option strict is set.
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

/// A few joints with their weights for each vertex; `name` names them in error messages.
///
/// # Safety
/// Each pointer is null or points to a valid view.
pub(super) unsafe fn skin_influences(
    joints: *const BespokeView,
    weights: *const BespokeView,
    influences: usize,
    joint_count: usize,
    name: &str,
) -> Result<SkinWeights> {
    // SAFETY: passed on from the caller.
    let (joint_view, weight_view) = unsafe { (view::indices(joints, name)?, view::floats(weights, name)?) };
    if joint_view.count != weight_view.count {
        return invalid(format!(
            "{name}: there are joints for {} vertices and weights for {}",
            joint_view.count, weight_view.count
        ));
    }
    // SAFETY: passed on from the caller.
    let (joints, weights) = unsafe {
        (buffer::read_indices(&joint_view, influences, name)?, buffer::read_rows(&weight_view, influences, name)?)
    };
    SkinWeights::from_sparse(&joints, &weights, influences, joint_count, joint_view.count, name)
}

const SKIN: &str = "target skin weights";

/// Optional: skin weights of the target avatar as a full matrix, one row a joint. They only assign each vertex to one
/// joint: the one with its largest weight, the lowest of several. Without them, and for a vertex whose weights are all
/// 0, the nearest bone decides.
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
/// Only the joint with the largest weight of a vertex is used, so one influence with weight 1 for each vertex is
/// enough.
///
/// `joints`: one element for each vertex, U16 or U32, each of them `influences` joints (from 0). `weights`: the same
/// with F32 or F64. The weights of a joint that is listed twice are added; one with weight 0 is ignored. `joint_count`:
/// joints of the target skeleton. All else as for bespoke_session_set_target_skin_weights, which this replaces.
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
            session.set_target_skin(skin_influences(joints, weights, influences, joint_count, SKIN)?)
        })
    }
}
