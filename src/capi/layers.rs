//! Garments that the avatar wears already.

use crate::capi::inputs::mesh;
use crate::capi::session::{BespokeSession, call};
use crate::capi::status::BespokeStatus;
use crate::capi::view::BespokeView;

/// Optional: a garment that the avatar wears already, such as one that was read from another session. It joins the avatar as
/// an obstacle that keeps its shape: the garment of this session fits over avatar and layers, and is verified against both.
/// Each call adds one layer; they are numbered from 0, and stay until bespoke_session_clear_layers, also when another avatar
/// is set and after bespoke_session_reset.
///
/// `positions`: points, F32 or F64, in the coordinate system of the target avatar; used exactly as they are.
/// `triangles`: three vertices each, U16 or U32. Skin weights are those of the avatar beneath, where it has any. What
/// is read or counted as the avatar does not include its layers. Ownership: copied during the call. State: SETUP.
/// Errors: INVALID_ARGUMENT, INVALID_MESH (no vertices, no triangles, an index out of range, a coordinate that is not
/// finite), INVALID_STATE, BUSY, INTERNAL. Threads: any, one at a time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bespoke_session_add_layer(
    session: *mut BespokeSession,
    positions: *const BespokeView,
    triangles: *const BespokeView,
) -> BespokeStatus {
    // SAFETY: passed on from the caller.
    unsafe {
        call(session, |session| {
            let name = format!("layer {}", session.layer_count());
            session.add_layer(mesh(positions, triangles, &name)?.0)
        })
    }
}

/// Takes all layers off the avatar.
///
/// State: SETUP. Errors: INVALID_ARGUMENT (null), INVALID_STATE, BUSY, INTERNAL. Threads: any, one at a time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bespoke_session_clear_layers(session: *mut BespokeSession) -> BespokeStatus {
    // SAFETY: passed on from the caller.
    unsafe { call(session, |session| session.clear_layers()) }
}
