//! Two threads in one session, and panics.

use std::sync::mpsc;
use std::thread;

use bespoke::capi::control::*;
use bespoke::capi::layers::bespoke_session_clear_layers;
use bespoke::capi::results::*;
use bespoke::capi::running::*;
use bespoke::capi::session::*;
use bespoke::capi::status::BespokeStatus;

use testing::caller::{Caller, points, triangles};

use BespokeStatus::{Busy, Internal, Ok};

/// A session's address, to hand to another thread.
#[derive(Clone, Copy)]
struct Shared(*mut BespokeSession);
// SAFETY: the functions that are called with it say that any thread may.
unsafe impl Send for Shared {}

impl Shared {
    fn session(self) -> *mut BespokeSession {
        self.0
    }
}

#[test]
fn a_second_thread_gets_busy_and_changes_nothing() {
    let (caller, sample) = Caller::with_sample();
    // SAFETY: the session is alive.
    caller.refused(
        unsafe { bespoke_session_step(caller.session, 0, 0, std::ptr::null_mut()) },
        BespokeStatus::InvalidState,
        &["prepare"],
    );
    let before = caller.message();
    let shared = Shared(caller.session);
    let (entered, is_inside) = mpsc::channel();
    let (leave, may_leave) = mpsc::channel::<()>();
    let first = thread::spawn(move || {
        // SAFETY: the session is alive.
        unsafe {
            call(shared.session(), |_| {
                entered.send(()).expect("the test waits");
                may_leave.recv().expect("the test lets go");
                Result::Ok(())
            })
        }
    });
    is_inside.recv().expect("the first call begins");
    // SAFETY: the session is alive and the pointers good.
    unsafe {
        let session = caller.session;
        let mut energy = std::mem::zeroed();
        for status in [
            caller.set_garment(&points(&sample.garment.0), &triangles(&sample.garment.1)),
            bespoke_session_prepare(session),
            bespoke_session_step(session, 0, 0, std::ptr::null_mut()),
            bespoke_session_run(session),
            bespoke_session_clear_layers(session),
            bespoke_session_reset(session),
            bespoke_session_read_energy(session, 0, &mut energy),
            bespoke_session_read_distortion(session, std::ptr::null(), std::ptr::null_mut()),
            bespoke_session_destroy(session),
        ] {
            assert_eq!(status, Busy);
        }
        assert_eq!(caller.message(), before, "the message belongs to the calls that were let in");
        let mut progress: BespokeProgress = std::mem::zeroed();
        progress.struct_size = size_of::<BespokeProgress>() as u32;
        assert_eq!(bespoke_session_read_progress(session, &mut progress), Ok, "progress needs no turn");
    }
    leave.send(()).expect("the first call waits");
    assert_eq!(first.join().expect("the first call ends"), Ok);
    // SAFETY: the session is alive.
    caller.accepted(unsafe { bespoke_session_prepare(caller.session) });
}

#[test]
fn a_panic_stays_inside_and_ends_this_session_only() {
    let (broken, sample) = Caller::with_sample();
    let (other, _) = Caller::with_sample();
    // SAFETY: the session is alive.
    let status = unsafe { call(broken.session, |_| panic!("made by the test, number {}", 7)) };
    broken.refused(status, Internal, &["made by the test, number 7"]);
    // SAFETY: the sessions are alive.
    unsafe {
        for status in [
            broken.set_garment(&points(&sample.garment.0), &triangles(&sample.garment.1)),
            bespoke_session_prepare(broken.session),
            bespoke_session_run(broken.session),
            bespoke_session_reset(broken.session),
        ] {
            broken.refused(status, Internal, &["destroyed"]);
        }
        other.accepted(bespoke_session_run(other.session));
    }
}

#[test]
fn sessions_move_between_threads() {
    let (caller, _sample) = Caller::with_sample();
    let shared = Shared(caller.session);
    // SAFETY: the session is alive.
    let prepared = thread::spawn(move || unsafe { bespoke_session_prepare(shared.session()) });
    assert_eq!(prepared.join().expect("no panic gets out"), Ok);
    // SAFETY: the session is alive.
    let ran = thread::spawn(move || unsafe { bespoke_session_run(shared.session()) });
    assert_eq!(ran.join().expect("no panic gets out"), Ok, "{}", caller.message());
}
