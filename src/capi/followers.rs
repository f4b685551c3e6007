//! Meshes that follow the garment without being solved.

use crate::capi::inputs::mesh;
use crate::capi::rig_results::write_influences;
use crate::capi::session::{BespokeSession, call};
use crate::capi::status::BespokeStatus;
use crate::capi::view::{self, BespokeBuffer, BespokeView, invalid};
use crate::input::buffer;

const VERTICES: &str = "follower vertices";

/// Optional: a mesh that follows the garment without being solved, such as a level of detail, a trim, a badge or a collision
/// proxy. It is bound to the nearest points of the garment as it was modelled and carried to the result. Each call adds one;
/// they are numbered from 0. Where one passes through the avatar or the garment in the result, and did not in the design, the
/// diagnostic FOLLOWER_INTERSECTS says so.
///
/// `positions`: points in the coordinate system of the garment, F32 or F64. `triangles`: three vertices each, U16 or U32.
/// Ownership: copied during the call. State: SETUP. Errors: INVALID_ARGUMENT, INVALID_MESH, INVALID_STATE, BUSY, INTERNAL.
/// Threads: any, one at a time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bespoke_session_add_follower(
    session: *mut BespokeSession,
    positions: *const BespokeView,
    triangles: *const BespokeView,
) -> BespokeStatus {
    // SAFETY: passed on from the caller.
    unsafe {
        call(session, |session| {
            let (mesh, precision) = mesh(positions, triangles, "follower")?;
            session.add_follower(mesh, precision)
        })
    }
}

/// Removes all followers.
///
/// State: SETUP. Errors: INVALID_ARGUMENT, INVALID_STATE, BUSY, INTERNAL. Threads: any, one at a time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bespoke_session_clear_followers(session: *mut BespokeSession) -> BespokeStatus {
    // SAFETY: passed on from the caller.
    unsafe { call(session, |session| session.clear_followers()) }
}

/// Writes the vertices of a follower where the result takes them, in the order in which they were set, in the target's coordinate
/// system.
///
/// `follower`: its number. `points`: where to, F32 or F64. With null data and capacity 0 nothing is written. `*count`, unless
/// null: its vertices, also where they do not fit. State: DONE. Errors: INVALID_ARGUMENT (no such follower, too small a
/// capacity; nothing is written then), INVALID_STATE, BUSY, INTERNAL. Threads: any, one at a time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bespoke_session_read_follower_vertices(
    session: *const BespokeSession,
    follower: u32,
    points: *const BespokeBuffer,
    count: *mut usize,
) -> BespokeStatus {
    // SAFETY: passed on from the caller, who vouches for room for one number.
    unsafe {
        call(session, |session| {
            let positions = session.follower_positions(follower as usize)?;
            if !count.is_null() {
                count.write(positions.len());
            }
            let out = view::points_out(points, VERTICES)?;
            if out.capacity == 0 && out.data.is_null() {
                return Ok(());
            }
            buffer::write_positions(&out, &positions, VERTICES)
        })
    }
}

/// Writes skin weights of a follower, on the same joints as those of bespoke_session_read_garment_skin_influences: those of the
/// garment where the follower is bound to it.
///
/// `follower`: its number. `influences`, `joints`, `weights`, `joint_count`: as there. `vertices`: those that there is room for,
/// at least the follower's. State: DONE, with skin weights of the target avatar set. Errors: INVALID_ARGUMENT (no such follower,
/// null, no influences, too little room), INVALID_STATE, INVALID_WEIGHTS, CANCELLED, BUSY, INTERNAL. Threads: any, one at a time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bespoke_session_read_follower_skin_influences(
    session: *const BespokeSession,
    follower: u32,
    influences: usize,
    joints: *mut u32,
    weights: *mut f32,
    vertices: usize,
    joint_count: *mut usize,
) -> BespokeStatus {
    // SAFETY: passed on from the caller, who vouches for room for `vertices` times `influences` numbers of each kind, and
    // for one more number.
    unsafe {
        call(session, |session| {
            if joints.is_null() || weights.is_null() {
                return invalid("follower skin: a pointer is null".into());
            }
            let skin = session.follower_skin(follower as usize, influences)?;
            if vertices < skin.vertex_count() {
                return invalid(format!(
                    "follower skin: there is room for {vertices} vertices, the follower has {}",
                    skin.vertex_count()
                ));
            }
            if !joint_count.is_null() {
                joint_count.write(skin.joint_count());
            }
            write_influences(&skin, influences, joints, weights);
            Ok(())
        })
    }
}
