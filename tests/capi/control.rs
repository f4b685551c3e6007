//! Cancel and progress.

use std::ptr::null_mut;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;

use bespoke::capi::control::*;
use bespoke::capi::running::*;
use bespoke::capi::session::*;
use bespoke::capi::status::BespokeStatus::{Cancelled, InvalidArgument, InvalidState, Ok};
use bespoke::control::{Control, MAX_TERMS, Progress, Stage};

use testing::caller::Caller;

fn no_progress() -> BespokeProgress {
    // SAFETY: all fields are numbers, for which zero is a value.
    let zero: BespokeProgress = unsafe { std::mem::zeroed() };
    BespokeProgress { struct_size: size_of::<BespokeProgress>() as u32, ..zero }
}

#[test]
fn a_request_to_stop_stays_until_reset() {
    let (caller, _sample) = Caller::with_sample();
    let mut stage = 99;
    // SAFETY: the session is alive and the pointers good.
    unsafe {
        let session = caller.session;
        caller.accepted(bespoke_session_prepare(session));
        assert_eq!(bespoke_session_cancel(session), Ok);
        assert_eq!(bespoke_session_step(session, 0, 0, &mut stage), Cancelled);
        assert_eq!(stage, BespokeStage::Cancelled as u32);
        assert_eq!(bespoke_session_step(session, 0, 0, &mut stage), InvalidState);
        caller.accepted(bespoke_session_reset(session));
        caller.accepted(bespoke_session_run(session));
    }
}

#[test]
fn a_control_cancels_and_outlives_its_session() {
    let (caller, _sample) = Caller::with_sample();
    let mut control = null_mut();
    let mut progress = no_progress();
    // SAFETY: session and control are alive and the pointers good.
    unsafe {
        assert_eq!(bespoke_session_create_control(caller.session, &mut control), Ok);
        assert_eq!(bespoke_control_cancel(control), Ok);
        assert_eq!(bespoke_session_run(caller.session), Cancelled);
        caller.accepted(bespoke_session_reset(caller.session));
        caller.accepted(bespoke_session_run(caller.session));
        drop(caller);
        assert_eq!(bespoke_control_read_progress(control, &mut progress), Ok);
        assert_eq!(progress.stage, BespokeStage::Done as u32);
        assert_eq!(bespoke_control_cancel(control), Ok);
        bespoke_control_destroy(control);
    }
}

#[test]
fn progress_follows_the_session() {
    let (caller, _sample) = Caller::with_sample();
    let mut progress = no_progress();
    // SAFETY: the session is alive and the pointers good.
    unsafe {
        let read = |progress: &mut BespokeProgress| bespoke_session_read_progress(caller.session, progress);
        assert_eq!(read(&mut progress), Ok);
        assert_eq!(progress.stage, BespokeStage::Setup as u32);
        caller.accepted(bespoke_session_prepare(caller.session));
        assert_eq!(read(&mut progress), Ok);
        assert_eq!(progress.stage, BespokeStage::Prepared as u32);
        caller.accepted(bespoke_session_run(caller.session));
        assert_eq!(read(&mut progress), Ok);
        assert_eq!(progress.stage, BespokeStage::Done as u32);
        progress.struct_size = 3;
        assert_eq!(read(&mut progress), InvalidArgument);
    }
}

/// All numbers of a record are the same, so that a reader sees at once when it got two halves.
fn record(k: u32) -> Progress {
    let value = f64::from(k);
    Progress {
        stage: Stage::from_code(u64::from(k % 8)).expect("there are eight stages"),
        t: value,
        iteration: k,
        energy: value,
        gradient_norm: value,
        min_distance: value,
        active_contacts: u64::from(k),
        seconds: [value; 4],
        energy_count: k,
        energies: [value; MAX_TERMS],
    }
}

#[test]
fn readers_never_see_half_a_record() {
    let control = Arc::new(Control::new());
    control.publish(&record(0));
    let is_over = Arc::new(AtomicBool::new(false));
    let readers: Vec<_> = (0..3)
        .map(|_| {
            let (control, is_over) = (control.clone(), is_over.clone());
            thread::spawn(move || {
                let mut last = 0;
                while !is_over.load(Ordering::Relaxed) {
                    let seen = control.progress();
                    assert_eq!(seen, record(seen.iteration));
                    assert!(seen.iteration >= last, "time does not go back");
                    last = seen.iteration;
                }
                last
            })
        })
        .collect();
    for k in 1..200_000 {
        control.publish(&record(k));
    }
    is_over.store(true, Ordering::Relaxed);
    for reader in readers {
        reader.join().expect("the reader saw whole records only");
    }
    assert_eq!(control.progress(), record(199_999));
}
