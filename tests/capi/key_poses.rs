//! Corrections of key poses, as a C program reads them.

use std::ptr::{null, null_mut};

use bespoke::capi::inputs::bespoke_session_set_target_skin_influences;
use bespoke::capi::key_poses::*;
use bespoke::capi::rigs::*;
use bespoke::capi::running::*;
use bespoke::capi::status::BespokeStatus::{InvalidArgument, InvalidState};
use bespoke::capi::view::{BespokeBuffer, BespokeComponent};

use testing::caller::{Caller, Sample, view};

/// The joints of the sample's skeleton as a chain.
fn rig(places: &[[f32; 3]]) -> Vec<BespokeJoint> {
    let names = [c"Hips", c"Spine", c"Head"];
    let joint = |(k, place): (usize, &[f32; 3])| {
        let mut bind = identity();
        bind[12..15].copy_from_slice(&place.map(f64::from));
        let parent = k.checked_sub(1).map_or(BESPOKE_NO_JOINT, |parent| parent as u32);
        BespokeJoint { name: names[k].as_ptr(), parent, reserved: 0, bind }
    };
    places.iter().enumerate().map(joint).collect()
}

fn identity() -> [f64; 16] {
    std::array::from_fn(|k| if k % 5 == 0 { 1.0 } else { 0.0 })
}

fn with_rigs() -> (Caller, Sample) {
    let (caller, sample) = Caller::with_sample();
    let joints = rig(&sample.source_joints);
    let target = rig(&sample.target_joints);
    let count = sample.avatar.0.len();
    let (influences, weights) = (vec![1u32; count], vec![1f32; count]);
    let (influences, weights) = (view(&influences, BespokeComponent::U32), view(&weights, BespokeComponent::F32));
    // SAFETY: the session is alive, and joints and views are as many as said.
    unsafe {
        caller.accepted(bespoke_session_set_source_rig(caller.session, joints.as_ptr(), joints.len()));
        caller.accepted(bespoke_session_set_target_rig(caller.session, target.as_ptr(), target.len()));
        caller.accepted(bespoke_session_set_target_skin_influences(
            caller.session,
            &influences,
            &weights,
            1,
            target.len(),
        ));
    }
    (caller, sample)
}

#[test]
fn a_correction_is_read_with_its_counts() {
    let (caller, sample) = with_rigs();
    let session = caller.session;
    let still = [identity(); 3].concat();
    let vertices = sample.garment.0.len();
    let mut room = vec![[7f32; 3]; vertices];
    let buffer = BespokeBuffer { data: room.as_mut_ptr().cast(), capacity: vertices, stride: 0, component: 1 };
    let nowhere = BespokeBuffer { data: null_mut(), capacity: 0, stride: 0, component: 1 };
    let unwritten = BespokePoseIntersections { garment_garment: 7, garment_avatar: 7, in_folds: 7 };
    let (mut before, mut after, mut count) = (unwritten, unwritten, 0);
    // SAFETY: the session is alive, and there is room for what is written.
    unsafe {
        caller.accepted(bespoke_session_add_key_pose(session, c"still".as_ptr(), still.as_ptr(), 3));
        let solved = bespoke_session_solve_pose_corrections(session, 4);
        caller.refused(solved, InvalidState, &["result"]);
        caller.accepted(bespoke_session_run(session));
        let read = bespoke_session_read_pose_correction(session, 0, &nowhere, null_mut(), null_mut(), null_mut());
        caller.refused(read, InvalidState, &["key pose 0 (\"still\")", "solve_pose_corrections"]);
        caller.refused(bespoke_session_solve_pose_corrections(session, 0), InvalidArgument, &["influences"]);
        caller.accepted(bespoke_session_solve_pose_corrections(session, 4));
        let read = bespoke_session_read_pose_correction;
        caller.accepted(read(session, 0, &nowhere, &mut count, &mut before, null_mut()));
        assert_eq!((count, before), (vertices, BespokePoseIntersections::default()));
        caller.accepted(read(session, 0, &buffer, null_mut(), null_mut(), &mut after));
        assert_eq!(after, BespokePoseIntersections::default());
        let short = BespokeBuffer { capacity: vertices - 1, ..buffer };
        caller.refused(read(session, 0, &short, null_mut(), null_mut(), null_mut()), InvalidArgument, &["correction"]);
        let read = read(session, 1, &nowhere, null_mut(), null_mut(), null_mut());
        caller.refused(read, InvalidArgument, &["key pose 1"]);
        caller.accepted(bespoke_session_clear_key_poses(session));
    }
    assert!(room.iter().flatten().all(|&x| x == 0.0), "nothing has to give way");
}

#[test]
fn poses_that_are_none_are_refused() {
    let (caller, _sample) = with_rigs();
    let session = caller.session;
    let still = [identity(); 3].concat();
    // SAFETY: the session is null or alive, and the numbers are as many as said.
    unsafe {
        let add = |numbers: &[f64], joints| bespoke_session_add_key_pose(session, null(), numbers.as_ptr(), joints);
        caller.refused(bespoke_session_add_key_pose(session, null(), null(), 3), InvalidArgument, &["null"]);
        caller.refused(add(&still, 2), InvalidArgument, &["2 joints", "has 3"]);
        let mut other = still.clone();
        other[20] = f64::NAN;
        caller.refused(add(&other, 3), InvalidArgument, &["joint 1", "finite"]);
        let mut other = still.clone();
        other[3] = 0.5;
        caller.refused(add(&other, 3), InvalidArgument, &["joint 0", "last row"]);
        let mut other = still.clone();
        other[32..43].fill(0.0);
        caller.refused(add(&other, 3), InvalidArgument, &["joint 2", "inverse"]);
        assert_eq!(bespoke_session_clear_key_poses(null_mut()), InvalidArgument);
        assert_eq!(bespoke_session_solve_pose_corrections(null_mut(), 4), InvalidArgument);
        caller.accepted(bespoke_session_prepare(session));
        caller.refused(add(&still, 3), InvalidState, &["key pose", "reset"]);
        caller.refused(bespoke_session_clear_key_poses(session), InvalidState, &["reset"]);
        let without = Caller::new();
        let added = bespoke_session_add_key_pose(without.session, null(), still.as_ptr(), 3);
        without.refused(added, InvalidState, &["target rig"]);
    }
}
