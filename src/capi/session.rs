//! The session handle: one call at a time, in the process that made it; no panic gets out; and the message of the last
//! failure.

use std::ffi::c_char;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError, TryLockError};

use crate::capi::float_mode::DefaultMode;
use crate::capi::status::BespokeStatus;
use crate::capi::stay::stay;
use crate::capi::text;
use crate::control::Control;
use crate::error::{Error, ErrorKind, Result};
use crate::panics::{PanicLog, with_panic_log};
use crate::session::Session;

/// The fitting of one garment to one avatar. Opaque.
pub struct BespokeSession {
    /// Tried, never waited for: a second caller gets BUSY. A panic poisons it, and with it this session only.
    session: Mutex<Session>,
    /// Message of the last failure. Outside the session's lock, so that it can be read while a call runs.
    message: Mutex<String>,
    /// Reached without the session's lock.
    pub(super) control: Arc<Control>,
    panics: Arc<PanicLog>,
    /// A call has failed by a defect without a panic.
    is_defective: AtomicBool,
    /// The process that made it: its threads are there only.
    process: u32,
}

/// The message in a process that was forked, where no lock may be taken: a thread that only the parent has may hold it.
const INHERITED: &str =
    "the session was made in another process, from which this one was forked; only that one can use it";

impl BespokeSession {
    fn message(&self) -> MutexGuard<'_, String> {
        // The text is whole at any time: a poisoned lock only says that some other thread panicked.
        self.message.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// This is a process that was forked from the one that made the session.
    fn is_inherited(&self) -> bool {
        self.process != std::process::id()
    }
}

/// Runs `work` alone in the session behind `handle`. Its failure becomes a status and the session's message.
///
/// # Safety
/// `handle` is null or came from `bespoke_session_create` and was not destroyed.
pub unsafe fn call(handle: *const BespokeSession, work: impl FnOnce(&mut Session) -> Result<()>) -> BespokeStatus {
    // SAFETY: null or alive, as the caller vouches; it is only shared, its locks keep the parts apart.
    let Some(handle) = (unsafe { handle.as_ref() }) else {
        return BespokeStatus::InvalidArgument;
    };
    if handle.is_inherited() {
        return BespokeStatus::InvalidState;
    }
    let _mode = DefaultMode::enter();
    // The lock is taken inside, so that a panic poisons it.
    let refused = || {
        Some(Err(Error::new(
            ErrorKind::Internal,
            "an earlier call failed inside the library, so this session can only be destroyed",
        )))
    };
    let inside = || match handle.session.try_lock() {
        Ok(_) if handle.is_defective.load(Ordering::Relaxed) => refused(),
        Ok(mut session) => {
            let outcome = work(&mut session);
            let is_defect = outcome.as_ref().is_err_and(|error| error.kind == ErrorKind::Internal);
            handle.is_defective.store(is_defect, Ordering::Relaxed);
            Some(outcome)
        }
        Err(TryLockError::WouldBlock) => None,
        Err(TryLockError::Poisoned(_)) => refused(),
    };
    let outcome = with_panic_log(&handle.panics, || catch_unwind(AssertUnwindSafe(inside)));
    let error = match outcome {
        Ok(Some(Ok(()))) => return BespokeStatus::Ok,
        Ok(None) => return BespokeStatus::Busy,
        Ok(Some(Err(error))) => error,
        Err(_) => {
            let said = handle.panics.take().unwrap_or_else(|| "a panic without a text".to_string());
            Error::new(ErrorKind::Internal, format!("a defect of the library, please report it: {said}"))
        }
    };
    let status = error.kind.into();
    *handle.message() = error.message;
    status
}

/// Makes an empty session and stores its handle in `*session`; stores null where it fails.
///
/// `*session`: where the handle goes. It has no threads and takes little memory before bespoke_session_prepare. Ownership: the
/// caller destroys it with bespoke_session_destroy. Errors: INVALID_ARGUMENT (null), INTERNAL. Threads: any, at any time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bespoke_session_create(session: *mut *mut BespokeSession) -> BespokeStatus {
    if session.is_null() {
        return BespokeStatus::InvalidArgument;
    }
    stay();
    let make = || {
        let session = Session::new();
        let (control, panics) = (session.control(), session.panics());
        let (session, message) = (Mutex::new(session), Mutex::default());
        Box::into_raw(Box::new(BespokeSession {
            session,
            message,
            control,
            panics,
            is_defective: AtomicBool::new(false),
            process: std::process::id(),
        }))
    };
    let made = with_panic_log(&Arc::default(), || catch_unwind(make));
    // SAFETY: not null, and the caller vouches for room for one pointer.
    unsafe { session.write(*made.as_ref().unwrap_or(&std::ptr::null_mut())) };
    if made.is_ok() { BespokeStatus::Ok } else { BespokeStatus::Internal }
}

/// Ends a session and frees all it holds. A null session is fine. Controls made from it stay usable. When it returns,
/// no thread of the session is left; after a call that was cancelled, that may take a moment.
///
/// State: any. Errors: BUSY where another thread is inside a call with it, INVALID_STATE in a forked process; it is not
/// destroyed then. INTERNAL where it ended by a panic. Threads: any, and no other call with this session may begin from here
/// on.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bespoke_session_destroy(session: *mut BespokeSession) -> BespokeStatus {
    // SAFETY: null or alive, as the caller vouches.
    match unsafe { session.as_ref() } {
        None => return BespokeStatus::Ok,
        // Its threads, which would be waited for, are the parent's.
        Some(handle) if handle.is_inherited() => return BespokeStatus::InvalidState,
        Some(handle) => {
            if let Err(TryLockError::WouldBlock) = handle.session.try_lock() {
                return BespokeStatus::Busy;
            }
        }
    }
    // SAFETY: it came from `Box::into_raw`, and the caller vouches that no other call uses it from now on.
    let free = || drop(unsafe { Box::from_raw(session) });
    let freed = with_panic_log(&Arc::default(), || catch_unwind(AssertUnwindSafe(free)));
    if freed.is_ok() { BespokeStatus::Ok } else { BespokeStatus::Internal }
}

/// Takes a session back to SETUP: inputs, coordinate systems and options stay, results and a request to cancel are
/// dropped. Like bespoke_session_destroy, it waits for work that a cancelled call has left.
///
/// State: any. Errors: INVALID_ARGUMENT, BUSY, INTERNAL. Threads: any, one at a time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bespoke_session_reset(session: *mut BespokeSession) -> BespokeStatus {
    // SAFETY: passed on from the caller.
    unsafe {
        call(session, |session| {
            session.reset();
            Ok(())
        })
    }
}

/// Copies the message of the last call with this session that failed (UTF-8, empty where none did).
///
/// `buffer`: room for `capacity` bytes. A longer message is cut at a character; a zero byte always ends it. May be null
/// where `capacity` is 0. `*needed`, unless null: the size of the whole message with its zero byte. State: any, a
/// failed session included. Errors: INVALID_ARGUMENT (null session, or a null buffer with a capacity). Threads: any, at
/// any time, also while another call runs.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bespoke_session_last_message(
    session: *const BespokeSession,
    buffer: *mut c_char,
    capacity: usize,
    needed: *mut usize,
) -> BespokeStatus {
    // SAFETY: null or alive, as the caller vouches.
    let Some(handle) = (unsafe { session.as_ref() }) else {
        return BespokeStatus::InvalidArgument;
    };
    if buffer.is_null() && capacity > 0 {
        return BespokeStatus::InvalidArgument;
    }
    let held = (!handle.is_inherited()).then(|| handle.message());
    let message = held.as_ref().map_or(INHERITED, |message| message.as_str());
    if !needed.is_null() {
        // SAFETY: not null, and the caller vouches for room for one number.
        unsafe { needed.write(message.len() + 1) };
    }
    if capacity > 0 {
        let length = text::cut(message, capacity - 1).len();
        // SAFETY: `length < capacity`, and the caller vouches for `capacity` bytes.
        unsafe {
            std::ptr::copy_nonoverlapping(message.as_ptr().cast::<c_char>(), buffer, length);
            buffer.add(length).write(0);
        }
    }
    BespokeStatus::Ok
}
