//! Calls in the wrong order.

use std::ptr::null_mut;

use bespoke::capi::fit::*;
use bespoke::capi::inputs::*;
use bespoke::capi::results::*;
use bespoke::capi::running::*;
use bespoke::capi::session::*;
use bespoke::capi::status::BespokeStatus::{InvalidState, Ok};
use bespoke::capi::view::{BespokeBuffer, BespokeComponent};

use testing::caller::{Caller, Sample, bones, points, triangles};

#[test]
fn missing_inputs_are_named() {
    let (caller, sample) = (Caller::new(), Sample::new());
    // SAFETY: the session is alive.
    let prepare = || unsafe { bespoke_session_prepare(caller.session) };
    caller.refused(prepare(), InvalidState, &["garment"]);
    caller.accepted(caller.set_garment(&points(&sample.garment.0), &triangles(&sample.garment.1)));
    caller.refused(prepare(), InvalidState, &["source skeleton"]);
    caller.accepted(caller.set_source_skeleton(&points(&sample.source_joints), &bones(&sample.bones)));
    caller.refused(prepare(), InvalidState, &["avatar"]);
    caller.accepted(caller.set_avatar(&points(&sample.avatar.0), &triangles(&sample.avatar.1)));
    caller.refused(prepare(), InvalidState, &["target skeleton"]);
    caller.accepted(caller.set_target_skeleton(&points(&sample.target_joints), &bones(&sample.bones)));
    caller.accepted(prepare());
}

#[test]
fn nothing_runs_or_is_read_before_prepare() {
    let (caller, _sample) = Caller::with_sample();
    let nowhere = BespokeBuffer { data: null_mut(), capacity: 0, stride: 0, component: 1 };
    let mut counts = BespokeIntersections::default();
    let mut stage = 99;
    // SAFETY: the session is alive and the pointers are good.
    unsafe {
        let session = caller.session;
        caller.refused(bespoke_session_step(session, 1, 0, &mut stage), InvalidState, &["prepare"]);
        assert_eq!(stage, BespokeStage::Setup as u32);
        for status in [
            bespoke_session_read_garment_vertices(session, &nowhere, null_mut()),
            bespoke_session_read_avatar_vertices(session, &nowhere, null_mut()),
            bespoke_session_verify(session, BespokeComponent::F32 as u32, &mut counts),
        ] {
            caller.refused(status, InvalidState, &["prepare"]);
        }
    }
}

#[test]
fn inputs_are_fixed_from_prepare_to_reset() {
    let (caller, sample) = Caller::with_sample();
    let (p, t) = (points(&sample.garment.0), triangles(&sample.garment.1));
    let (j, b) = (points(&sample.source_joints), bones(&sample.bones));
    // SAFETY: the session is alive and the views are valid.
    unsafe {
        let session = caller.session;
        caller.accepted(bespoke_session_prepare(session));
        let options = testing::caller::no_options();
        for status in [
            caller.set_garment(&p, &t),
            caller.set_avatar(&p, &t),
            bespoke_session_set_source_avatar(session, &p, &t),
            caller.set_source_skeleton(&j, &b),
            caller.set_target_skeleton(&j, &b),
            bespoke_session_set_no_fit_vertices(session, &testing::caller::view(&[0u32], BespokeComponent::U32)),
            bespoke_session_set_pinned_vertices(
                session,
                &testing::caller::view(&[0u32], BespokeComponent::U32),
                std::ptr::null(),
            ),
            bespoke_session_clear_rigid_groups(session),
            bespoke_session_add_curve(session, &testing::caller::view(&[0u32, 1], BespokeComponent::U32), 0, 1.0, 1.0),
            bespoke_session_clear_curves(session),
            bespoke::capi::options::bespoke_session_set_options(session, &options),
            bespoke_session_prepare(session),
        ] {
            caller.refused(status, InvalidState, &["reset"]);
        }
        caller.accepted(bespoke_session_reset(session));
        caller.accepted(caller.set_garment(&p, &t));
        caller.accepted(bespoke_session_prepare(session));
    }
}

#[test]
fn a_session_that_is_done_waits_for_reset() {
    let (caller, _sample) = Caller::with_sample();
    let mut stage = 99;
    // SAFETY: the session is alive.
    unsafe {
        caller.accepted(bespoke_session_run(caller.session));
        let status = bespoke_session_step(caller.session, 1, 0, &mut stage);
        caller.refused(status, InvalidState, &["reset"]);
        assert_eq!(stage, BespokeStage::Done as u32);
        assert_eq!(bespoke_session_reset(caller.session), Ok);
        caller.accepted(bespoke_session_run(caller.session));
    }
}
