//! An artist's controls of the fit: weights, pins, rigid groups, curves.

use crate::capi::session::{BespokeSession, call};
use crate::capi::status::BespokeStatus;
use crate::capi::view::{self, BespokeView, invalid};
use crate::error::{Error, ErrorKind};
use crate::input::buffer;
use crate::session::{Curve, Pin};

/// Optional: how strongly each garment vertex is drawn to the body, relative to the others. 1 everywhere by default;
/// 0: not at all.
///
/// `weights`: one number for each garment vertex, F32 or F64, finite and not negative. Ownership: copied during the
/// call. State: SETUP, and for bespoke_session_refit DONE. Errors: INVALID_ARGUMENT, INVALID_WEIGHTS (a wrong size may be
/// found only by bespoke_session_prepare or bespoke_session_refit), INVALID_STATE, BUSY, INTERNAL. Threads: any, one at a time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bespoke_session_set_vertex_fit_weights(
    session: *mut BespokeSession,
    weights: *const BespokeView,
) -> BespokeStatus {
    let name = "fit weights";
    // SAFETY: passed on from the caller.
    unsafe {
        call(session, |session| {
            session.set_vertex_fit_weights(buffer::read_scalars(&view::floats(weights, name)?, name)?)
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
    let name = "no-fit vertices";
    // SAFETY: passed on from the caller.
    unsafe {
        call(session, |session| {
            let Some(count) = session.garment_vertex_count() else {
                let message = format!("{name}: the garment is set first");
                return Err(Error::new(ErrorKind::InvalidState, message));
            };
            let mut weights = vec![1.0; count];
            for vertex in buffer::read_indices(&view::indices(vertices, name)?, 1, name)? {
                match weights.get_mut(vertex as usize) {
                    Some(weight) => *weight = 0.0,
                    None => return invalid(format!("{name}: lists vertex {vertex}, the garment has {count} vertices")),
                }
            }
            session.set_vertex_fit_weights(weights)
        })
    }
}

const PINS: &str = "pinned vertices";

/// Optional: garment vertices that are held at targets. Replaces earlier pins.
///
/// `vertices`: garment vertices, from 0, each once, U16 or U32; none: no pins. `targets`: null, or one point for each
/// of them in the target's coordinate system, F32 or F64. Without targets, a vertex keeps its position relative to the
/// nearest bone: its coordinate along the bone and its distance from it, so with equal skeletons it stays where it is.
/// A pin is a stiff spring (see BespokeOptions.pin_weight): one that cannot reach its target, because the body is in
/// the way, is reported as a diagnostic. Ownership: copied during the call. State: SETUP, and for bespoke_session_refit DONE.
/// Errors: INVALID_ARGUMENT (a vertex that the garment does not have is found by bespoke_session_prepare or
/// bespoke_session_refit), INVALID_STATE, BUSY, INTERNAL. Threads:
/// any, one at a time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bespoke_session_set_pinned_vertices(
    session: *mut BespokeSession,
    vertices: *const BespokeView,
    targets: *const BespokeView,
) -> BespokeStatus {
    // SAFETY: passed on from the caller.
    unsafe {
        call(session, |session| {
            let vertices = buffer::read_indices(&view::indices(vertices, PINS)?, 1, PINS)?;
            if targets.is_null() {
                let pins = vertices.into_iter().map(|vertex| Pin { vertex, target: None });
                return session.set_pins(pins.collect());
            }
            let name = "targets of pinned vertices";
            let targets = buffer::read_positions(&view::floats(targets, name)?, name)?;
            if targets.len() != vertices.len() {
                return invalid(format!("{PINS}: there are {} vertices and {} targets", vertices.len(), targets.len()));
            }
            let pins = vertices.into_iter().zip(targets).map(|(vertex, p)| Pin { vertex, target: Some(p) });
            session.set_pins(pins.collect())
        })
    }
}

const RIGID: &str = "rigid group";

/// Optional: garment vertices that stay one rigid body, such as a button, a buckle or an armour plate: it moves, turns
/// and keeps its shape. Its size scales with the skeletons. Each call adds a group; they are numbered from 0.
///
/// `vertices`: garment vertices, from 0, in any order, U16 or U32; at least one, none of another group. A group that
/// contact keeps from becoming rigid up to rounding is reported as a diagnostic. Ownership: copied during the call.
/// State: SETUP. Errors: INVALID_ARGUMENT (a vertex that the garment does not have is found by
/// bespoke_session_prepare), INVALID_STATE, BUSY, INTERNAL. Threads: any, one at a time.
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

/// Removes all rigid groups.
///
/// State: SETUP. Errors: INVALID_ARGUMENT, INVALID_STATE, BUSY, INTERNAL. Threads: any, one at a time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bespoke_session_clear_rigid_groups(session: *mut BespokeSession) -> BespokeStatus {
    // SAFETY: passed on from the caller.
    unsafe { call(session, |session| session.clear_rigid_groups()) }
}

const CURVE: &str = "curve";

/// Optional: a curve along edges of the garment, such as a neckline, a seam line or the rim of a lined sleeve, that keeps
/// its shape and its place along the bones. Each call adds one; they are numbered from 0. One that runs through the
/// vertices of a boundary curve, in their order either way around, takes its place: so a neckline can be held more, and a
/// cuff less.
///
/// `vertices`: garment vertices, from 0, in the order of the curve, each once, U16 or U32; of vertices in one place any
/// will do. `closed`: 1 where the last is joined to the first, else 0. `curve_weight`: factor on
/// BespokeOptions.curvature_weight and torsion_weight, up to 1e6: 1 as for a boundary curve, 0 for none.
/// `position_weight`: the same for BespokeOptions.position_weight. A closed curve keeps its place along the bone that
/// goes through it, or the mean of several; each vertex of an open one, and of one that is too small and too far from
/// the bones to be an opening, keeps its place along the bone nearest to it. On a piece that is held to another one, or
/// carried, it has no place of its own. Ownership: copied during the call. State: SETUP. Errors: INVALID_ARGUMENT (fewer
/// than two vertices, or three where it is closed, one listed twice, a weight out of range; found by
/// bespoke_session_prepare: a vertex that the garment does not have, two in a row that no edge joins, a place passed
/// twice, an earlier curve once more), INVALID_STATE, BUSY, INTERNAL. Threads: any, one at a time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bespoke_session_add_curve(
    session: *mut BespokeSession,
    vertices: *const BespokeView,
    closed: u32,
    curve_weight: f64,
    position_weight: f64,
) -> BespokeStatus {
    // SAFETY: passed on from the caller.
    unsafe {
        call(session, |session| {
            if closed > 1 {
                return invalid(format!("{CURVE}: closed is {closed}; it is 0 or 1"));
            }
            let vertices = buffer::read_indices(&view::indices(vertices, CURVE)?, 1, CURVE)?;
            session.add_curve(Curve { vertices, closed: closed == 1, curve_weight, position_weight })
        })
    }
}

/// Removes all curves that were added.
///
/// State: SETUP. Errors: INVALID_ARGUMENT, INVALID_STATE, BUSY, INTERNAL. Threads: any, one at a time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bespoke_session_clear_curves(session: *mut BespokeSession) -> BespokeStatus {
    // SAFETY: passed on from the caller.
    unsafe { call(session, |session| session.clear_curves()) }
}
