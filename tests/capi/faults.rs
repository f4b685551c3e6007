//! Panics on purpose, in all the kinds of threads that a session has.

use std::process::Command;
use std::ptr::null_mut;

use bespoke::capi::control::*;
use bespoke::capi::results::*;
use bespoke::capi::running::*;
use bespoke::capi::session::*;
use bespoke::capi::status::BespokeStatus::{self, Internal, Ok};
use bespoke::capi::view::{BespokeBuffer, BespokeComponent};
use bespoke::session::Fault;

use testing::caller::{Caller, points, triangles};

const FAULTS: [Fault; 5] = [Fault::Prepare, Fault::Iteration, Fault::Worker, Fault::Field, Fault::Verify];

/// A session that panics at `fault`, and what its run says.
fn broken(fault: Fault) -> (Caller, BespokeStatus) {
    let (caller, _sample) = Caller::with_sample();
    // SAFETY: the session is alive.
    let status = unsafe {
        caller.accepted(call(caller.session, |session| {
            session.inject_fault(fault);
            Result::Ok(())
        }));
        bespoke_session_run(caller.session)
    };
    (caller, status)
}

#[test]
fn a_panic_anywhere_ends_its_session_only() {
    let (other, sample) = Caller::with_sample();
    for fault in FAULTS {
        let (caller, status) = broken(fault);
        let place = "src/session/fault.rs:";
        caller.refused(status, Internal, &["defect", &format!("a fault on purpose: {fault:?}"), place]);
        let nowhere = BespokeBuffer { data: null_mut(), capacity: 0, stride: 0, component: 1 };
        // SAFETY: the sessions are alive and the pointers good.
        unsafe {
            let mut counts = BespokeIntersections::default();
            let mut report: BespokeReport = std::mem::zeroed();
            report.struct_size = size_of::<BespokeReport>() as u32;
            for status in [
                caller.set_garment(&points(&sample.garment.0), &triangles(&sample.garment.1)),
                bespoke_session_prepare(caller.session),
                bespoke_session_step(caller.session, 1, 0, null_mut()),
                bespoke_session_run(caller.session),
                bespoke_session_verify(caller.session, BespokeComponent::F32 as u32, &mut counts),
                bespoke_session_read_garment_vertices(caller.session, &nowhere, null_mut()),
                bespoke_session_read_report(caller.session, &mut report),
                bespoke_session_reset(caller.session),
            ] {
                caller.refused(status, Internal, &["destroyed"]);
            }
            // What needs no turn still works.
            let mut control = null_mut();
            assert_eq!(bespoke_session_create_control(caller.session, &mut control), Ok);
            let mut progress: BespokeProgress = std::mem::zeroed();
            progress.struct_size = size_of::<BespokeProgress>() as u32;
            assert_eq!(bespoke_control_read_progress(control, &mut progress), Ok);
            drop(caller);
            assert_eq!(bespoke_control_cancel(control), Ok);
            bespoke_control_destroy(control);
            other.accepted(bespoke_session_reset(other.session));
            other.accepted(bespoke_session_run(other.session));
        }
    }
}

/// What the test below looks at from outside: the program's standard error.
#[test]
#[ignore = "run by another test, in a process of its own"]
fn panics_of_the_library_and_one_of_the_host() {
    for fault in FAULTS {
        assert_eq!(broken(fault).1, Internal);
    }
    let host = std::thread::spawn(|| panic!("a panic of the host"));
    assert!(host.join().is_err());
}

#[test]
fn panics_say_nothing_on_the_hosts_standard_error() {
    let program = std::env::current_exe().expect("the test program has a path");
    let run = Command::new(program)
        .args(["--exact", "faults::panics_of_the_library_and_one_of_the_host", "--ignored", "--nocapture"])
        .output()
        .expect("the test program can be run");
    let said = String::from_utf8_lossy(&run.stderr);
    assert!(run.status.success(), "{said}");
    assert!(said.contains("a panic of the host"), "panics of others are none of ours: {said}");
    assert!(!said.contains("on purpose"), "{said}");
}
