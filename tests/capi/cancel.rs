//! A request to stop at any moment.

use std::ptr::null_mut;
use std::thread;
use std::time::{Duration, Instant};

use bespoke::capi::control::*;
use bespoke::capi::results::*;
use bespoke::capi::running::*;
use bespoke::capi::session::*;
use bespoke::capi::status::BespokeStatus::{self, Cancelled, InvalidState, Ok};
use bespoke::capi::view::{BespokeBuffer, BespokeComponent};

use testing::Random;
use testing::caller::Caller;

/// A control's address, to hand to another thread.
struct Shared(*mut BespokeControl);
// SAFETY: the functions that are called with it say that any thread may.
unsafe impl Send for Shared {}

impl Shared {
    fn cancel(&self) -> BespokeStatus {
        // SAFETY: the control is alive.
        unsafe { bespoke_control_cancel(self.0) }
    }
}

/// The garment's vertices as they can be read now.
fn vertices(caller: &Caller) -> Result<Vec<[u32; 3]>, BespokeStatus> {
    let mut count = 0;
    let nowhere = BespokeBuffer { data: null_mut(), capacity: 0, stride: 0, component: BespokeComponent::F32 as u32 };
    // SAFETY: the session is alive, the buffer as large as said.
    unsafe {
        match bespoke_session_read_garment_vertices(caller.session, &nowhere, &mut count) {
            Ok => {}
            other => return Err(other),
        }
        let mut bits = vec![[0u32; 3]; count];
        let out = BespokeBuffer { data: bits.as_mut_ptr().cast(), capacity: count, ..nowhere };
        caller.accepted(bespoke_session_read_garment_vertices(caller.session, &out, null_mut()));
        assert!(bits.iter().flatten().all(|&b| f32::from_bits(b).is_finite()));
        Result::Ok(bits)
    }
}

fn stage(caller: &Caller) -> u32 {
    // SAFETY: all fields are numbers, for which zero is a value; the session is alive.
    unsafe {
        let mut progress: BespokeProgress = std::mem::zeroed();
        progress.struct_size = size_of::<BespokeProgress>() as u32;
        assert_eq!(bespoke_session_read_progress(caller.session, &mut progress), Ok);
        progress.stage
    }
}

/// Machines that run tests are busy: the bound is far above what is promised, and far below a run that is not stopped.
const PROMPT: Duration = Duration::from_secs(1);

#[test]
fn a_run_stops_at_any_moment_and_can_be_read_and_begun_again() {
    let (caller, _sample) = Caller::with_sample();
    let clock = Instant::now();
    // SAFETY: the session is alive.
    caller.accepted(unsafe { bespoke_session_run(caller.session) });
    let whole = clock.elapsed();
    let expected = vertices(&caller).expect("a session that is done can be read");
    let mut random = Random::new(11);
    let mut stopped = 0;
    for round in 0..60 {
        // SAFETY: the session is alive, and so is the control, until the thread has ended.
        unsafe {
            caller.accepted(bespoke_session_reset(caller.session));
            let mut control = null_mut();
            assert_eq!(bespoke_session_create_control(caller.session, &mut control), Ok);
            let shared = Shared(control);
            let wait = whole.mul_f64(random.unit());
            let other = thread::spawn(move || {
                thread::sleep(wait);
                let asked = Instant::now();
                assert_eq!(shared.cancel(), Ok);
                asked
            });
            let status = bespoke_session_run(caller.session);
            let returned = Instant::now();
            let asked = other.join().expect("the other thread only cancels");
            bespoke_control_destroy(control);
            if status == Ok {
                assert_eq!(vertices(&caller).as_ref(), Result::Ok(&expected), "round {round}");
                continue;
            }
            stopped += 1;
            caller.refused(status, Cancelled, &["cancelled"]);
            let took = returned.saturating_duration_since(asked);
            assert!(took < PROMPT, "round {round}: it took {took:?} to stop after {wait:?}");
            match stage(&caller) {
                // Prepare was stopped: there is nothing to read yet, the inputs are there, the request stays.
                s if s == BespokeStage::Setup as u32 => {
                    assert_eq!(vertices(&caller), Err(InvalidState));
                    assert_eq!(bespoke_session_prepare(caller.session), Cancelled);
                }
                s => {
                    assert_eq!(s, BespokeStage::Cancelled as u32);
                    assert_eq!(vertices(&caller).expect("the last iterate can be read").len(), expected.len());
                    let mut counts = BespokeIntersections::default();
                    let component = BespokeComponent::F64 as u32;
                    caller.accepted(bespoke_session_verify(caller.session, component, &mut counts));
                    assert_eq!(counts.garment_garment, 0, "no iterate intersects itself");
                }
            }
            if round % 8 == 0 {
                caller.accepted(bespoke_session_reset(caller.session));
                caller.accepted(bespoke_session_run(caller.session));
                assert_eq!(vertices(&caller).as_ref(), Result::Ok(&expected), "after a cancel and a reset");
            }
        }
    }
    assert!(stopped > 20, "only {stopped} of 60 requests came in time");
}

/// Ending a session right after it was stopped waits for what goes on in its threads.
#[test]
fn a_session_can_be_destroyed_right_after_it_was_stopped() {
    for k in 0..12 {
        let (caller, _sample) = Caller::with_sample();
        let mut control = null_mut();
        // SAFETY: the session is alive, the control until the thread has ended.
        unsafe {
            assert_eq!(bespoke_session_create_control(caller.session, &mut control), Ok);
            let shared = Shared(control);
            let other = thread::spawn(move || {
                thread::sleep(Duration::from_millis(4 * k));
                shared.cancel()
            });
            let status = bespoke_session_run(caller.session);
            assert!(matches!(status, Ok | Cancelled), "{status:?}");
            drop(caller);
            assert_eq!(other.join().expect("the other thread only cancels"), Ok);
            bespoke_control_destroy(control);
        }
    }
}

#[test]
fn a_request_before_prepare_stops_it_and_one_on_a_result_stops_the_next_verify_only() {
    let (caller, _sample) = Caller::with_sample();
    let mut counts = BespokeIntersections::default();
    // SAFETY: the session is alive and the pointers good.
    unsafe {
        let session = caller.session;
        assert_eq!(bespoke_session_cancel(session), Ok);
        assert_eq!(bespoke_session_prepare(session), Cancelled);
        assert_eq!(stage(&caller), BespokeStage::Setup as u32);
        caller.accepted(bespoke_session_reset(session));
        caller.accepted(bespoke_session_run(session));
        assert_eq!(bespoke_session_cancel(session), Ok);
        assert_eq!(bespoke_session_verify(session, BespokeComponent::F32 as u32, &mut counts), Cancelled);
        assert_eq!(stage(&caller), BespokeStage::Done as u32);
        caller.accepted(bespoke_session_verify(session, BespokeComponent::F32 as u32, &mut counts));
        assert_eq!(counts, BespokeIntersections::default());
    }
}
