//! Morphs (blend shapes): those of the garment go over to the result, and to those of the avatar the garment has an answer.

use std::ffi::{CStr, c_char};

use glam::DVec3;

use crate::capi::session::{BespokeSession, call};
use crate::capi::status::BespokeStatus;
use crate::capi::view::{self, BespokeBuffer, BespokeView};
use crate::error::Result;
use crate::input::buffer;
use crate::session::Morph;

/// # Safety
/// `name` is null or ends with a zero byte; `offsets` is null or points to a valid view.
unsafe fn morph(name: *const c_char, offsets: *const BespokeView, what: &str) -> Result<Morph> {
    // SAFETY: not null, and the caller vouches for a zero byte at its end.
    let text = |name| unsafe { CStr::from_ptr(name) }.to_string_lossy().into_owned();
    let name = if name.is_null() { String::new() } else { text(name) };
    // SAFETY: passed on from the caller.
    let offsets = unsafe { buffer::read_positions(&view::floats(offsets, what)?, what)? };
    Ok(Morph { name, offsets })
}

/// # Safety
/// `points` is null or points to a buffer that tells the truth, `count` is null or points to a number.
unsafe fn write(offsets: &[DVec3], points: *const BespokeBuffer, count: *mut usize, what: &str) -> Result<()> {
    if !count.is_null() {
        // SAFETY: not null, and the caller vouches for a number.
        unsafe { count.write(offsets.len()) };
    }
    // SAFETY: passed on from the caller.
    let out = unsafe { view::points_out(points, what)? };
    if out.capacity == 0 && out.data.is_null() {
        return Ok(());
    }
    // SAFETY: passed on from the caller.
    unsafe { buffer::write_positions(&out, offsets, what) }
}

const GARMENT: &str = "garment morph";
const TARGET: &str = "target morph";

/// Optional: a morph of the garment as it was modelled, which goes over to the result: bespoke_session_read_garment_morph. Each
/// call adds one; they are numbered from 0.
///
/// `name`: UTF-8, for messages; null: none. `offsets`: one for each vertex of the garment, in its coordinate system, F32 or F64.
/// Ownership: copied during the call. State: SETUP. Errors: INVALID_ARGUMENT (a number that is not finite; another number of
/// offsets than the garment has vertices is found by bespoke_session_prepare), INVALID_STATE, BUSY, INTERNAL. Threads: any,
/// one at a time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bespoke_session_add_garment_morph(
    session: *mut BespokeSession,
    name: *const c_char,
    offsets: *const BespokeView,
) -> BespokeStatus {
    // SAFETY: passed on from the caller.
    unsafe { call(session, |session| session.add_garment_morph(morph(name, offsets, GARMENT)?)) }
}

/// Removes all morphs of the garment.
///
/// State: SETUP. Errors: INVALID_ARGUMENT, INVALID_STATE, BUSY, INTERNAL. Threads: any, one at a time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bespoke_session_clear_garment_morphs(session: *mut BespokeSession) -> BespokeStatus {
    // SAFETY: passed on from the caller.
    unsafe { call(session, |session| session.clear_garment_morphs()) }
}

/// Writes a morph of the garment as it is now: each offset turned, stretched and scaled as the surface around its vertex has
/// been, in the target's coordinate system. Where the garment moves rigidly, or all of it is scaled, that is exact.
///
/// `morph`: its number. `offsets`: where to, one for each vertex of the garment, F32 or F64. With null data and capacity 0
/// nothing is written. `*count`, unless null: vertices of the garment, also where they do not fit. State: PREPARED or later;
/// until DONE it is that of a preview. Errors: INVALID_ARGUMENT (no such morph, too small a capacity; nothing is written then),
/// INVALID_STATE, BUSY, INTERNAL. Threads: any, one at a time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bespoke_session_read_garment_morph(
    session: *const BespokeSession,
    morph: u32,
    offsets: *const BespokeBuffer,
    count: *mut usize,
) -> BespokeStatus {
    // SAFETY: passed on from the caller.
    unsafe { call(session, |session| write(&session.garment_morph(morph as usize)?, offsets, count, GARMENT)) }
}

/// Optional: a morph of the target avatar, such as a heavier body, to which the garment is to have an answer:
/// bespoke_session_solve_target_morphs. Each call adds one; they are numbered from 0.
///
/// `name`: UTF-8, for messages; null: none. `offsets`: one for each vertex of the target avatar, in its coordinate system, F32 or
/// F64. All else as for bespoke_session_add_garment_morph.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bespoke_session_add_target_morph(
    session: *mut BespokeSession,
    name: *const c_char,
    offsets: *const BespokeView,
) -> BespokeStatus {
    // SAFETY: passed on from the caller.
    unsafe { call(session, |session| session.add_target_morph(morph(name, offsets, TARGET)?)) }
}

/// Removes all morphs of the target avatar.
///
/// State: SETUP. Errors: INVALID_ARGUMENT, INVALID_STATE, BUSY, INTERNAL. Threads: any, one at a time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bespoke_session_clear_target_morphs(session: *mut BespokeSession) -> BespokeStatus {
    // SAFETY: passed on from the caller.
    unsafe { call(session, |session| session.clear_target_morphs()) }
}

/// How much of a target morph the avatar is to have from the next bespoke_session_refit on: the body changes its shape, takes the
/// garment along, with no triangle through another on the way, and the garment is fitted to it. Morphs add up, and layers go along
/// with the body beneath them. At first, and after bespoke_session_reset, all weights are 0: the avatar as it was set.
///
/// `morph`: its number. `weight`: any finite number; 0.5 is half of the morph. State: DONE, or FIT after bespoke_session_refit. Errors:
/// INVALID_ARGUMENT (no such morph, not finite), INVALID_STATE, BUSY, INTERNAL. Threads: any, one at a time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bespoke_session_set_target_morph_weight(
    session: *mut BespokeSession,
    morph: u32,
    weight: f64,
) -> BespokeStatus {
    // SAFETY: passed on from the caller.
    unsafe { call(session, |session| session.set_target_morph_weight(morph as usize, weight)) }
}

/// Finds what the garment answers to each morph of the target avatar with: from the result on, the body goes to the morph at
/// weight 1 and takes the garment along, with no triangle through another on the way, and the garment is fitted there, which
/// takes about as long as the fit. The result stays as it is. Layers go along with the body beneath them. A morph without an
/// answer is told by the diagnostic MORPH_NOT_SOLVED, and one whose answer intersects halfway by MORPH_INTERSECTS. Answers that
/// are there already are not sought again. Meanwhile the progress is in the stages REPOSE, with the weight as t, and FIT.
///
/// State: DONE, but not where the result is in the pose of the design (POSE_BLOCKED). Errors: INVALID_ARGUMENT (also a morph that is far larger than the body), INVALID_STATE,
/// CANCELLED (the state stays DONE, and what was found is kept), MEMORY_LIMIT, BUSY, INTERNAL. Threads: any, one at a time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bespoke_session_solve_target_morphs(session: *mut BespokeSession) -> BespokeStatus {
    // SAFETY: passed on from the caller.
    unsafe { call(session, |session| session.solve_target_morphs()) }
}

/// Writes the garment's answer to a morph of the target avatar: a morph of the garment, as offsets from the result. With both at
/// weight 1 the garment is verified as the result is, in the precision in which it was set.
///
/// `morph`: the number of the avatar's morph. `offsets`, `count`: as for bespoke_session_read_garment_morph. State: DONE, after
/// bespoke_session_solve_target_morphs. Errors: INVALID_ARGUMENT (no such morph, too small a capacity; nothing is written then),
/// INVALID_STATE (also where the garment has no answer), BUSY, INTERNAL. Threads: any, one at a time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bespoke_session_read_target_morph(
    session: *const BespokeSession,
    morph: u32,
    offsets: *const BespokeBuffer,
    count: *mut usize,
) -> BespokeStatus {
    // SAFETY: passed on from the caller.
    unsafe { call(session, |session| write(&session.target_morph(morph as usize)?, offsets, count, TARGET)) }
}
