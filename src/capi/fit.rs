//! What an artist asks of the fit: weights, pins, rigid groups.

use crate::capi::session::{BespokeSession, call};
use crate::capi::status::BespokeStatus;
use crate::capi::view::{self, BespokeView, invalid};
use crate::error::{Error, ErrorKind};
use crate::input::buffer;
use crate::session::Pin;

/// Optional: how strongly each garment vertex is drawn to the body, relative to the others. 1 everywhere by default;
/// 0: not at all.
///
/// `weights`: one number for each garment vertex, F32 or F64, finite and not negative. Ownership: copied during the
/// call. State: SETUP. Errors: INVALID_ARGUMENT, INVALID_WEIGHTS (a wrong size may be found only by
/// bespoke_session_prepare), INVALID_STATE, BUSY, INTERNAL. Threads: any, one at a time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bespoke_session_set_vertex_fit_weights(
    session: *mut BespokeSession,
    weights: *const BespokeView,
) -> BespokeStatus {
    let what = "fit weights";
    // SAFETY: passed on from the caller.
    unsafe {
        call(session, |session| {
            session.set_vertex_fit_weights(buffer::read_scalars(&view::floats(weights, what)?, what)?)
        })
    }
}

/// Optional: the garment vertices that are not drawn to the body. The same as bespoke_session_set_vertex_fit_weights, which
/// this replaces, with 0 for these vertices and 1 for all others: triangles with all three corners listed do not fit.
///
/// `vertices`: garment vertices, from 0, in any order, U16 or U32. Ownership: copied during the call. State: SETUP, with
/// the garment set. Errors: INVALID_ARGUMENT (a vertex out of range as well), INVALID_STATE, BUSY, INTERNAL. Threads:
/// any, one at a time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bespoke_session_set_no_fit_vertices(
    session: *mut BespokeSession,
    vertices: *const BespokeView,
) -> BespokeStatus {
    let what = "no-fit vertices";
    // SAFETY: passed on from the caller.
    unsafe {
        call(session, |session| {
            let Some(count) = session.garment_vertex_count() else {
                let message = format!("{what}: the garment is set first");
                return Err(Error::new(ErrorKind::InvalidState, message));
            };
            let mut weights = vec![1.0; count];
            for vertex in buffer::read_indices(&view::indices(vertices, what)?, 1, what)? {
                match weights.get_mut(vertex as usize) {
                    Some(weight) => *weight = 0.0,
                    None => return invalid(format!("{what}: lists vertex {vertex}, the garment has {count} vertices")),
                }
            }
            session.set_vertex_fit_weights(weights)
        })
    }
}

const PINS: &str = "pinned vertices";

/// Optional: garment vertices that are held in their places. Replaces those before.
///
/// `vertices`: garment vertices, from 0, each once, U16 or U32; none: no pins. `places`: null, or one point for each of them
/// in the target's space, F32 or F64. Without places, a vertex is held where it was designed, carried along with the bone
/// beside it: its coordinate along the bone and its distance from it stay, so on the same skeleton it stays where it is. A pin
/// is a stiff spring (see BespokeOptions.pin_weight): what the body stands in the way of is not reached, and told as a
/// diagnostic. Ownership: copied during the call. State: SETUP. Errors: INVALID_ARGUMENT (a vertex that the garment does not
/// have is found by bespoke_session_prepare), INVALID_STATE, BUSY, INTERNAL. Threads: any, one at a time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bespoke_session_set_pinned_vertices(
    session: *mut BespokeSession,
    vertices: *const BespokeView,
    places: *const BespokeView,
) -> BespokeStatus {
    // SAFETY: passed on from the caller.
    unsafe {
        call(session, |session| {
            let vertices = buffer::read_indices(&view::indices(vertices, PINS)?, 1, PINS)?;
            if places.is_null() {
                let pins = vertices.into_iter().map(|vertex| Pin { vertex, place: None });
                return session.set_pins(pins.collect());
            }
            let what = "places of pinned vertices";
            let places = buffer::read_positions(&view::floats(places, what)?, what)?;
            if places.len() != vertices.len() {
                return invalid(format!("{PINS}: there are {} vertices and {} places", vertices.len(), places.len()));
            }
            let pins = vertices.into_iter().zip(places).map(|(vertex, p)| Pin { vertex, place: Some(p) });
            session.set_pins(pins.collect())
        })
    }
}

const RIGID: &str = "rigid group";

/// Optional: garment vertices that are to stay one rigid body, such as a button, a buckle or an armour plate: it turns and
/// moves, and keeps its shape. Its size goes with that of the skeletons. One more group with each call, counted from 0.
///
/// `vertices`: garment vertices, from 0, in any order, U16 or U32; at least one, none of another group. Where contact does not
/// let a group become rigid to rounding, that is told as a diagnostic. Ownership: copied during the call. State: SETUP.
/// Errors: INVALID_ARGUMENT (a vertex that the garment does not have is found by bespoke_session_prepare), INVALID_STATE,
/// BUSY, INTERNAL. Threads: any, one at a time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bespoke_session_add_rigid_group(
    session: *mut BespokeSession,
    vertices: *const BespokeView,
) -> BespokeStatus {
    // SAFETY: passed on from the caller.
    unsafe {
        call(session, |session| {
            session.add_rigid_group(buffer::read_indices(&view::indices(vertices, RIGID)?, 1, RIGID)?)
        })
    }
}

/// Forgets all rigid groups.
///
/// State: SETUP. Errors: INVALID_ARGUMENT, INVALID_STATE, BUSY, INTERNAL. Threads: any, one at a time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bespoke_session_clear_rigid_groups(session: *mut BespokeSession) -> BespokeStatus {
    // SAFETY: passed on from the caller.
    unsafe { call(session, |session| session.clear_rigid_groups()) }
}
