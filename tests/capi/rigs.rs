//! Rigs, their pairs and their map: bad arguments are refused with a message, and good ones are read as they are meant.

use std::ffi::{CStr, c_char};
use std::ptr::{null, null_mut};

use bespoke::capi::rigs::*;
use bespoke::capi::running::*;
use bespoke::capi::session::BespokeSession;
use bespoke::capi::status::BespokeStatus::{self, InvalidArgument, InvalidSkeleton, InvalidState, InvalidWeights, Ok};
use bespoke::capi::view::BespokeComponent;
use testing::caller::{Caller, bones, points, triangles, view};

fn joint(name: Option<&'static CStr>, parent: u32, place: [f64; 3]) -> BespokeJoint {
    let mut bind = [0.0; BESPOKE_TRANSFORM_SIZE];
    [bind[0], bind[5], bind[10], bind[15]] = [1.0; 4];
    bind[12..15].copy_from_slice(&place);
    BespokeJoint { name: name.map_or(null(), CStr::as_ptr), parent, reserved: 0, bind }
}

/// Hips and two legs.
fn source() -> Vec<BespokeJoint> {
    vec![
        joint(Some(c"Hips"), BESPOKE_NO_JOINT, [0.0, 1.0, 0.0]),
        joint(Some(c"LeftUpLeg"), 0, [0.1, 0.9, 0.0]),
        joint(Some(c"LeftLeg"), 1, [0.1, 0.5, 0.0]),
        joint(Some(c"RightUpLeg"), 0, [-0.1, 0.9, 0.0]),
        joint(Some(c"RightLeg"), 3, [-0.1, 0.5, 0.0]),
    ]
}

/// The same in other names and the opposite order: children stand before their parents.
fn target() -> Vec<BespokeJoint> {
    vec![
        joint(Some(c"rightLowerLeg"), 1, [-0.1, 0.5, 0.0]),
        joint(Some(c"rightUpperLeg"), 4, [-0.1, 0.9, 0.0]),
        joint(Some(c"leftLowerLeg"), 3, [0.1, 0.5, 0.0]),
        joint(Some(c"leftUpperLeg"), 4, [0.1, 0.9, 0.0]),
        joint(Some(c"hips"), BESPOKE_NO_JOINT, [0.0, 1.0, 0.0]),
    ]
}

type Set = unsafe extern "C" fn(*mut BespokeSession, *const BespokeJoint, usize) -> BespokeStatus;

fn set(caller: &Caller, set: Set, joints: &[BespokeJoint]) -> BespokeStatus {
    // SAFETY: the session is alive, there are as many joints as said, and their names end.
    unsafe { set(caller.session, joints.as_ptr(), joints.len()) }
}

fn set_pairs<T>(caller: &Caller, pairs: &[[T; 2]], component: BespokeComponent) -> BespokeStatus {
    // SAFETY: the session is alive and the view true.
    unsafe { bespoke_session_set_joint_pairs(caller.session, &view(pairs, component)) }
}

const UNWRITTEN: BespokeMappedJoint =
    BespokeMappedJoint { target: 77, reason: 77, confidence: 77.0, part: [77; BESPOKE_PART_NAME_SIZE] };

/// The status, the count and the first `capacity` joints.
fn read(caller: &Caller, capacity: usize) -> (BespokeStatus, usize, Vec<BespokeMappedJoint>) {
    let (mut joints, mut count) = (vec![UNWRITTEN; capacity], usize::MAX);
    // SAFETY: the session is alive and there is room for what is written.
    let status = unsafe { bespoke_session_read_joint_map(caller.session, joints.as_mut_ptr(), capacity, &mut count) };
    (status, count, joints)
}

fn part(joint: &BespokeMappedJoint) -> String {
    let bytes: Vec<u8> = joint.part.iter().map(|&c: &c_char| c as u8).collect();
    CStr::from_bytes_until_nul(&bytes).expect("it ends").to_str().expect("UTF-8").to_owned()
}

fn with_rigs() -> Caller {
    let caller = Caller::new();
    caller.accepted(set(&caller, bespoke_session_set_source_rig, &source()));
    caller.accepted(set(&caller, bespoke_session_set_target_rig, &target()));
    caller
}

#[test]
fn null_pointers_are_refused() {
    let joints = source();
    let (p, t) = (points(&[[0.0; 3]]), triangles(&[[0; 3]]));
    let nobody = null_mut();
    // SAFETY: null pointers are what is tested, all others are good.
    unsafe {
        for status in [
            bespoke_session_set_source_rig(nobody, joints.as_ptr(), 5),
            bespoke_session_set_target_rig(nobody, joints.as_ptr(), 5),
            bespoke_session_set_source_skin_influences(nobody, &t, &p, 3, 3),
            bespoke_session_set_garment_skin_influences(nobody, &t, &p, 3, 3),
            bespoke_session_set_joint_pairs(nobody, &bones(&[[0, 0]])),
            bespoke_session_read_joint_map(nobody, null_mut(), 0, null_mut()),
        ] {
            assert_eq!(status, InvalidArgument);
        }
        let caller = Caller::new();
        let session = caller.session;
        let words = ["source rig", "null", "5"];
        caller.refused(bespoke_session_set_source_rig(session, null(), 5), InvalidArgument, &words);
        caller.refused(
            bespoke_session_set_target_rig(session, null(), 0),
            InvalidSkeleton,
            &["target rig", "no joints"],
        );
        caller.refused(bespoke_session_set_joint_pairs(session, null()), InvalidArgument, &["joint pairs"]);
        let source_skin = bespoke_session_set_source_skin_influences(session, null(), &p, 3, 3);
        caller.refused(source_skin, InvalidArgument, &["source skin weights"]);
        let garment_skin = bespoke_session_set_garment_skin_influences(session, &t, null(), 3, 3);
        caller.refused(garment_skin, InvalidArgument, &["garment skin weights"]);
        let map = bespoke_session_read_joint_map(session, null_mut(), 3, null_mut());
        caller.refused(map, InvalidArgument, &["joint map", "null", "3"]);
    }
}

#[test]
fn bad_joints_are_named() {
    let caller = Caller::new();
    let refused = |change: fn(&mut BespokeJoint), status, words: &[&str]| {
        let mut joints = source();
        change(&mut joints[2]);
        caller.refused(set(&caller, bespoke_session_set_source_rig, &joints), status, words);
    };
    refused(|joint| joint.reserved = 9, InvalidArgument, &["source rig", "joint 2", "9", "reserved"]);
    refused(|joint| joint.parent = 5, InvalidSkeleton, &["joint 2 (\"LeftLeg\")", "parent 5", "5 joints"]);
    refused(|joint| joint.parent = 65_535, InvalidSkeleton, &["joint 2", "65535"]);
    refused(|joint| joint.parent = 2, InvalidSkeleton, &["joint 2", "its own ancestor"]);
    refused(|joint| joint.bind[7] = f64::NAN, InvalidSkeleton, &["joint 2", "number 7", "NaN"]);
    refused(|joint| joint.bind[13] = f64::INFINITY, InvalidSkeleton, &["joint 2", "number 13", "inf"]);
    refused(|joint| joint.bind[0] = 1e31, InvalidSkeleton, &["joint 2", "number 0"]);
    refused(|joint| joint.bind[15] = 0.0, InvalidSkeleton, &["joint 2", "last row", "column after column"]);
    // Row after row.
    refused(|joint| joint.bind.swap(3, 12), InvalidSkeleton, &["joint 2", "last row"]);
    refused(
        |joint| (joint.name, joint.parent) = (c"a\nb".as_ptr(), 77),
        InvalidSkeleton,
        &["joint 2 (\"a b\")", "parent 77"],
    );

    // A circle of three, far from the first joint.
    let mut joints = source();
    joints.push(joint(None, 6, [0.0; 3]));
    joints.push(joint(None, 7, [0.0; 3]));
    joints.push(joint(None, 5, [0.0; 3]));
    let status = set(&caller, bespoke_session_set_target_rig, &joints);
    caller.refused(status, InvalidSkeleton, &["target rig", "its own ancestor", "circle"]);

    let many = vec![joint(None, BESPOKE_NO_JOINT, [0.0; 3]); 65_536];
    let status = set(&caller, bespoke_session_set_target_rig, &many);
    caller.refused(status, InvalidArgument, &["target rig", "65536", "65535"]);

    // None of these has set anything.
    caller.refused(read(&caller, 0).0, InvalidState, &["source rig", "set_source_rig"]);
}

#[test]
fn names_may_be_anything() {
    let caller = Caller::new();
    let mut joints = source();
    joints[2].name = c"\xff\xfe\x80 \xc3".as_ptr();
    joints[3].name = null();
    joints[4].name = c"".as_ptr();
    // Scale and mirroring are no matter.
    joints[1].bind[0] = -100.0;
    joints[2].bind[5] = 0.0;
    caller.accepted(set(&caller, bespoke_session_set_source_rig, &joints));
    caller.accepted(set(&caller, bespoke_session_set_target_rig, &target()));
    let (status, count, map) = read(&caller, 5);
    caller.accepted(status);
    assert_eq!((count, map[0].target, map[1].target), (5, 4, 3));
    joints[2].parent = 9;
    let status = set(&caller, bespoke_session_set_source_rig, &joints);
    caller.refused(status, InvalidSkeleton, &["joint 2 (\"", "parent 9"]);
}

#[test]
fn the_map_is_read_as_far_as_there_is_room_and_pairs_win() {
    let caller = with_rigs();
    assert_eq!(read(&caller, 0), (Ok, 5, vec![]));
    let (status, count, map) = read(&caller, 7);
    caller.accepted(status);
    assert_eq!(count, 5);
    assert_eq!(map[5..], [UNWRITTEN; 2]);
    assert_eq!(map[..5].iter().map(|joint| joint.target).collect::<Vec<_>>(), [4, 3, 2, 1, 0]);
    for joint in &map[..5] {
        assert_eq!(joint.reason, BespokeJointReason::Name as u32);
        assert!(joint.confidence > 0.0 && joint.confidence <= 1.0);
    }
    let parts: Vec<String> = map[..3].iter().map(part).collect();
    assert_eq!(parts, ["hips", "left upper leg", "left lower leg"]);
    assert_eq!(read(&caller, 2).2, map[..2]);

    let check = |status| {
        caller.accepted(status);
        let map = read(&caller, 5).2;
        let caller_said = BespokeJointReason::Caller as u32;
        assert_eq!((map[1].target, map[1].reason, map[1].confidence), (1, caller_said, 1.0));
        assert_eq!((map[3].target, map[3].reason), (BESPOKE_NO_JOINT, caller_said));
    };
    check(set_pairs(&caller, &[[1u16, 1], [3, 65_535]], BespokeComponent::U16));
    check(set_pairs(&caller, &[[1u32, 1], [3, BESPOKE_NO_JOINT]], BespokeComponent::U32));
    // No pairs take them back.
    caller.accepted(set_pairs::<u32>(&caller, &[], BespokeComponent::U32));
    assert_eq!(read(&caller, 5).2, map[..5]);
}

#[test]
fn bad_pairs_are_named() {
    let caller = with_rigs();
    let refused = |pairs: &[[u32; 2]], words: &[&str]| {
        caller.accepted(set_pairs(&caller, pairs, BespokeComponent::U32));
        let (status, count, _) = read(&caller, 5);
        caller.refused(status, InvalidArgument, words);
        assert_eq!(count, usize::MAX, "nothing is written");
    };
    refused(&[[0, 0], [5, 1]], &["pair 1", "joint 5 of the source rig", "5 joints"]);
    // In 32 bits, 65535 is a joint.
    refused(&[[0, 65_535]], &["pair 0", "joint 65535 of the target rig"]);
    refused(&[[0, 0], [0, 1]], &["joint 0 (\"Hips\") of the source rig", "pair 0", "pair 1"]);
    refused(&[[0, 2], [1, 2]], &["joint 2 (\"leftLowerLeg\") of the target rig", "pair 0", "pair 1"]);
    let status = set_pairs(&caller, &[[0f32, 0.0]], BespokeComponent::F32);
    caller.refused(status, InvalidArgument, &["joint pairs"]);
}

#[test]
fn skeleton_and_rig_take_each_others_place() {
    let (caller, sample) = Caller::with_sample();
    // Two skeletons are rigs without names.
    let (status, count, _) = read(&caller, 0);
    assert_eq!((status, count), (Ok, sample.source_joints.len()));
    caller.accepted(set(&caller, bespoke_session_set_source_rig, &source()));
    assert_eq!(read(&caller, 0).1, 5);
    caller.accepted(caller.set_source_skeleton(&points(&sample.source_joints), &bones(&sample.bones)));
    assert_eq!(read(&caller, 0).1, sample.source_joints.len());

    // A rig beside a skeleton: the same joints, of which nothing is recognised, paired by the caller.
    let rig: Vec<BespokeJoint> = (0u32..)
        .zip(&sample.target_joints)
        .map(|(k, place)| joint(None, if k == 0 { BESPOKE_NO_JOINT } else { k - 1 }, place.map(f64::from)))
        .collect();
    caller.accepted(set(&caller, bespoke_session_set_target_rig, &rig));
    let pairs: Vec<[u16; 2]> = (0..rig.len() as u16).map(|k| [k, k]).collect();
    caller.accepted(set_pairs(&caller, &pairs, BespokeComponent::U16));
    // SAFETY: the session is alive.
    caller.accepted(unsafe { bespoke_session_run(caller.session) });
    let late = set(&caller, bespoke_session_set_target_rig, &rig);
    caller.refused(late, InvalidState, &["target rig", "reset"]);
    caller.refused(set_pairs(&caller, &pairs, BespokeComponent::U16), InvalidState, &["joint pairs", "reset"]);
    // The map can still be read.
    assert_eq!(read(&caller, 0), (Ok, rig.len(), vec![]));
}

#[test]
fn nothing_that_corresponds_is_found_by_prepare() {
    let (caller, _) = Caller::with_sample();
    let prop = [joint(Some(c"sword"), BESPOKE_NO_JOINT, [0.0; 3]), joint(Some(c"camera"), 0, [0.0, 1.0, 0.0])];
    caller.accepted(set(&caller, bespoke_session_set_target_rig, &prop));
    // SAFETY: the session is alive.
    let status = unsafe { bespoke_session_prepare(caller.session) };
    caller.refused(status, InvalidSkeleton, &["rigs", "correspond", "pairs"]);
}

#[test]
fn weights_are_on_the_joints_of_their_rig() {
    let (caller, sample) = Caller::with_sample();
    caller.accepted(set(&caller, bespoke_session_set_source_rig, &source()));
    let vertices = sample.garment.0.len();
    let (joints, weights) = (vec![[0u32, 4]; vertices], vec![[0.5f32, 0.5]; vertices]);
    let (joints, weights) = (view(&joints, BespokeComponent::U32), view(&weights, BespokeComponent::F32));
    // SAFETY: the session is alive and the views true.
    let set =
        |count| unsafe { bespoke_session_set_garment_skin_influences(caller.session, &joints, &weights, 2, count) };
    caller.refused(set(4), InvalidWeights, &["garment skin weights", "joint 4"]);
    caller.accepted(set(6));
    caller.refused(read(&caller, 0).0, InvalidWeights, &["garment skin weights", "source rig", "6 joints", "5 joints"]);
    caller.accepted(set(5));
    assert_eq!(read(&caller, 0).0, Ok);
}
