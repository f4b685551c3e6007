//! Progress and cancellation, from any thread at any time.

use std::mem::size_of;
use std::sync::Arc;

use crate::capi::running::BespokeStage;
use crate::capi::session::BespokeSession;
use crate::capi::sized::{self, Sized32};
use crate::capi::status::BespokeStatus;
use crate::control::{Control, MAX_TERMS, Progress};

/// Length of the list of energy terms in BespokeProgress.
pub const BESPOKE_MAX_TERMS: usize = 12;

const _: () = assert!(BESPOKE_MAX_TERMS == MAX_TERMS);

/// Progress of a session, a snapshot. Lengths are in the normalised space, in which the longest side of the skeleton's
/// bounding box is 2.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BespokeProgress {
    /// sizeof(BespokeProgress).
    pub struct_size: u32,
    /// One of BespokeStage.
    pub stage: u32,
    /// Iterations of this stage so far.
    pub iteration: u32,
    /// How many of `energies` are in use.
    pub energy_count: u32,
    /// Inflation: 0 is the avatar shrunk onto the source skeleton, 1 the target avatar.
    pub t: f64,
    /// The objective: the sum of `energies`.
    pub energy: f64,
    /// Euclidean norm of the objective's gradient.
    pub gradient_norm: f64,
    /// Smallest distance of a contact pair; infinite where no pair is near.
    pub min_distance: f64,
    /// Contact pairs closer than dhat.
    pub active_contacts: u64,
    /// Seconds in prepare so far.
    pub prepare_seconds: f64,
    /// Seconds in inflate so far.
    pub inflate_seconds: f64,
    /// Seconds in fit so far.
    pub fit_seconds: f64,
    /// Seconds in the verifier so far.
    pub verify_seconds: f64,
    /// Each term with its weight, in the order of bespoke_session_read_energy.
    pub energies: [f64; BESPOKE_MAX_TERMS],
}

// SAFETY: repr(C) of four u32, then 64-bit numbers, without padding.
unsafe impl Sized32 for BespokeProgress {}

impl From<Progress> for BespokeProgress {
    fn from(progress: Progress) -> Self {
        let [prepare_seconds, inflate_seconds, fit_seconds, verify_seconds] = progress.seconds;
        Self {
            struct_size: size_of::<Self>() as u32,
            stage: BespokeStage::from(progress.stage) as u32,
            iteration: progress.iteration,
            energy_count: progress.energy_count,
            t: progress.t,
            energy: progress.energy,
            gradient_norm: progress.gradient_norm,
            min_distance: progress.min_distance,
            active_contacts: progress.active_contacts,
            prepare_seconds,
            inflate_seconds,
            fit_seconds,
            verify_seconds,
            energies: progress.energies,
        }
    }
}

/// # Safety
/// `progress` is null or points to as many bytes as its first field says.
unsafe fn read_progress(control: &Control, progress: *mut BespokeProgress) -> BespokeStatus {
    // SAFETY: passed on from the caller.
    match unsafe { sized::write(control.progress().into(), progress, "progress") } {
        Ok(()) => BespokeStatus::Ok,
        Err(error) => error.kind.into(),
    }
}

/// Cancels a session. The call that runs, if it is prepare, step, run or verify, returns CANCELLED within 100 ms,
/// whatever it is doing; otherwise the next one does. The request stays until bespoke_session_reset.
///
/// What can be read afterwards is the last complete iteration. Work that cannot be interrupted ends later in a thread
/// of the library; bespoke_session_reset and bespoke_session_destroy wait for it.
///
/// State: any. Errors: INVALID_ARGUMENT (null). Threads: any, at any time, also while another call runs; a signal handler may
/// call it.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bespoke_session_cancel(session: *const BespokeSession) -> BespokeStatus {
    // SAFETY: null or alive, as the caller vouches.
    match unsafe { session.as_ref() } {
        None => BespokeStatus::InvalidArgument,
        Some(session) => {
            session.control.cancel();
            BespokeStatus::Ok
        }
    }
}

/// Fills a struct with the progress of a session as of its last iteration. The caller sets `struct_size` first.
///
/// State: any. Errors: INVALID_ARGUMENT (null or struct_size); the session's message does not change. Threads: any, at any
/// time, also while another call runs.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bespoke_session_read_progress(
    session: *const BespokeSession,
    progress: *mut BespokeProgress,
) -> BespokeStatus {
    // SAFETY: null or alive, as the caller vouches; `progress` is passed on.
    unsafe {
        session.as_ref().map_or(BespokeStatus::InvalidArgument, |session| read_progress(&session.control, progress))
    }
}

/// Cancellation and progress of one session; a handle of its own that may outlive the session. Opaque.
pub struct BespokeControl {
    control: Arc<Control>,
}

/// Makes a control of a session and stores its handle in `*control`; stores null where it fails.
///
/// Ownership: the caller destroys it with bespoke_control_destroy, before or after the session. State: any. Errors:
/// INVALID_ARGUMENT (null). Threads: any, at any time, also while another call runs.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bespoke_session_create_control(
    session: *const BespokeSession,
    control: *mut *mut BespokeControl,
) -> BespokeStatus {
    if control.is_null() {
        return BespokeStatus::InvalidArgument;
    }
    // SAFETY: null or alive, as the caller vouches.
    let made = unsafe { session.as_ref() }
        .map(|session| Box::into_raw(Box::new(BespokeControl { control: session.control.clone() })));
    // SAFETY: not null, and the caller vouches for room for one pointer.
    unsafe { control.write(made.unwrap_or(std::ptr::null_mut())) };
    if made.is_some() { BespokeStatus::Ok } else { BespokeStatus::InvalidArgument }
}

/// The same as bespoke_session_cancel. Without effect once the session is destroyed.
///
/// Errors: INVALID_ARGUMENT (null). Threads: any, at any time; a signal handler may call it.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bespoke_control_cancel(control: *const BespokeControl) -> BespokeStatus {
    // SAFETY: null or alive, as the caller vouches.
    match unsafe { control.as_ref() } {
        None => BespokeStatus::InvalidArgument,
        Some(control) => {
            control.control.cancel();
            BespokeStatus::Ok
        }
    }
}

/// The same as bespoke_session_read_progress. Once the session is destroyed, the last progress stays.
///
/// Errors: INVALID_ARGUMENT (null or struct_size). Threads: any, at any time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bespoke_control_read_progress(
    control: *const BespokeControl,
    progress: *mut BespokeProgress,
) -> BespokeStatus {
    // SAFETY: null or alive, as the caller vouches; `progress` is passed on.
    unsafe {
        control.as_ref().map_or(BespokeStatus::InvalidArgument, |control| read_progress(&control.control, progress))
    }
}

/// Frees a control. The session runs on, and a request to cancel stays. A null control is fine.
///
/// Threads: any; no other call with this control may run or begin.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bespoke_control_destroy(control: *mut BespokeControl) {
    if !control.is_null() {
        // SAFETY: it came from `Box::into_raw`, and the caller vouches that nobody uses it any more.
        drop(unsafe { Box::from_raw(control) });
    }
}
