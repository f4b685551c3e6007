//! Avatars and garments that several sessions share.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::ptr::null_mut;
use std::sync::Arc;

use crate::capi::session::{BespokeSession, call};
use crate::capi::status::BespokeStatus;
use crate::capi::view::invalid;
use crate::panics::with_panic_log;
use crate::session::{SharedAvatar, SharedGarment};

/// A body to dress, for many sessions. Opaque.
pub struct BespokeAvatar {
    avatar: SharedAvatar,
    /// The process that made it.
    process: u32,
}

/// A garment to fit, for many sessions. Opaque.
pub struct BespokeGarment {
    garment: SharedGarment,
    /// The process that made it.
    process: u32,
}

/// Frees a handle; in a process that was forked from the one that made it, nothing is done.
///
/// # Safety
/// `handle` is null or came from `Box::into_raw`, and nobody uses it any more.
unsafe fn destroy<T>(handle: *mut T, process: impl FnOnce(&T) -> u32) {
    // SAFETY: null or alive, as the caller vouches.
    if unsafe { handle.as_ref() }.is_some_and(|handle| process(handle) == std::process::id()) {
        // SAFETY: as the caller vouches.
        let free = || drop(unsafe { Box::from_raw(handle) });
        // Nothing can be said of a panic here.
        drop(with_panic_log(&Arc::default(), || catch_unwind(AssertUnwindSafe(free))));
    }
}

/// Makes an avatar that many sessions use: of all that was set of the target in `session`, which are mesh, skeleton or rig, skin
/// weights, parts, layers, morphs and coordinate system. What such sessions need of it alone, above all the distance field, is
/// computed by the first of them and taken by the others, at once in any threads.
///
/// A session with it gives the same bits as one in which all was set anew. With the option memory_limit each session counts what
/// it shares as if it were its own. `session` itself shares it only once bespoke_session_use_avatar says so.
///
/// `*avatar`: where the handle goes; null where it fails. Ownership: the caller destroys it with bespoke_avatar_destroy; nothing is copied.
/// State: any, with the target avatar set. Errors: INVALID_ARGUMENT, INVALID_STATE, BUSY, INTERNAL. Threads: any, one at a time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bespoke_avatar_create(
    session: *const BespokeSession,
    avatar: *mut *mut BespokeAvatar,
) -> BespokeStatus {
    let mut made = null_mut();
    // SAFETY: passed on from the caller.
    let status = unsafe {
        call(session, |session| {
            if avatar.is_null() {
                return invalid("there is no place for the avatar: it is null".into());
            }
            made =
                Box::into_raw(Box::new(BespokeAvatar { avatar: session.share_avatar()?, process: std::process::id() }));
            Ok(())
        })
    };
    if !avatar.is_null() {
        // SAFETY: not null, and the caller vouches for room for one pointer.
        unsafe { avatar.write(made) };
    }
    status
}

/// Dresses this avatar: it takes the place of all that was set of a target. What is set of the target afterwards holds for this
/// session alone, and another target avatar ends the sharing. A session keeps what it uses, also after bespoke_session_reset.
///
/// State: SETUP. Errors: INVALID_ARGUMENT, INVALID_STATE, BUSY, INTERNAL. Threads: any, one at a time; the avatar may be used by
/// other sessions meanwhile.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bespoke_session_use_avatar(
    session: *mut BespokeSession,
    avatar: *const BespokeAvatar,
) -> BespokeStatus {
    // SAFETY: passed on from the caller.
    unsafe {
        call(session, |session| match avatar.as_ref() {
            Some(avatar) => session.use_avatar(&avatar.avatar),
            None => invalid("the avatar is null".into()),
        })
    }
}

/// Frees an avatar. Sessions that use it go on, and what they share is freed with the last of them. A null avatar is fine.
///
/// Threads: any; no other call with this avatar may run or begin.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bespoke_avatar_destroy(avatar: *mut BespokeAvatar) {
    // SAFETY: passed on from the caller.
    unsafe { destroy(avatar, |avatar| avatar.process) }
}

/// Makes a garment that many sessions use, as bespoke_avatar_create does an avatar: of all that was set of the garment in
/// `session`, which are mesh, source skeleton or rig, source avatar and the skin weights of both, fit weights, pins, rigid groups, curves,
/// morphs, followers and the source coordinate system. It is checked and welded once, and the body that it was made for is looked at
/// once; most of the work depends on the avatar, too, so less is saved than with a shared avatar.
///
/// `*garment`: where the handle goes; null where it fails. Ownership: the caller destroys it with bespoke_garment_destroy; nothing
/// is copied. State: any, with the garment set. Errors: INVALID_ARGUMENT, INVALID_STATE, BUSY, INTERNAL. Threads: any, one at a time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bespoke_garment_create(
    session: *const BespokeSession,
    garment: *mut *mut BespokeGarment,
) -> BespokeStatus {
    let mut made = null_mut();
    // SAFETY: passed on from the caller.
    let status = unsafe {
        call(session, |session| {
            if garment.is_null() {
                return invalid("there is no place for the garment: it is null".into());
            }
            made = Box::into_raw(Box::new(BespokeGarment {
                garment: session.share_garment()?,
                process: std::process::id(),
            }));
            Ok(())
        })
    };
    if !garment.is_null() {
        // SAFETY: not null, and the caller vouches for room for one pointer.
        unsafe { garment.write(made) };
    }
    status
}

/// Fits this garment: it takes the place of all that was set of a garment and its source. What is set of them afterwards holds for
/// this session alone, and another garment ends the sharing. A session keeps what it uses, also after bespoke_session_reset.
///
/// State: SETUP. Errors: INVALID_ARGUMENT, INVALID_STATE, BUSY, INTERNAL. Threads: any, one at a time; the garment may be used by
/// other sessions meanwhile.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bespoke_session_use_garment(
    session: *mut BespokeSession,
    garment: *const BespokeGarment,
) -> BespokeStatus {
    // SAFETY: passed on from the caller.
    unsafe {
        call(session, |session| match garment.as_ref() {
            Some(garment) => session.use_garment(&garment.garment),
            None => invalid("the garment is null".into()),
        })
    }
}

/// Frees a garment. Sessions that use it go on, and what they share is freed with the last of them. A null garment is fine.
///
/// Threads: any; no other call with this garment may run or begin.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bespoke_garment_destroy(garment: *mut BespokeGarment) {
    // SAFETY: passed on from the caller.
    unsafe { destroy(garment, |garment| garment.process) }
}
