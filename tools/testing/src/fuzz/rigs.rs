//! Calls with rigs: joints of any names, parents and transforms, pairs of them, weights on them, and the map.

use std::ffi::{CStr, c_char};
use std::ptr::{null, null_mut};

use bespoke::capi::rigs::*;
use bespoke::capi::session::BespokeSession;
use bespoke::capi::status::BespokeStatus;

use super::array::Array;
use super::caller::after;
use super::key_poses;
use super::source::Source;

const NAMES: [&CStr; 12] = [
    c"",
    c"Hips",
    c"Spine",
    c"Spine1",
    c"Head",
    c"LeftUpLeg",
    c"LeftLeg",
    c"RightUpLeg",
    c"mixamorig:LeftArm",
    c"root|ik_foot.L",
    c"\xff\xfe\x80",
    c"\n%s%n",
];

/// One call.
pub fn call(session: *mut BespokeSession, source: &mut Source) {
    match source.below(8) {
        0..4 => set_joints(session, source),
        4 => set_pairs(session, source),
        5 => set_weights(session, source),
        6 => key_poses::call(session, source),
        _ => read_map(session, source),
    }
}

fn set_joints(session: *mut BespokeSession, source: &mut Source) {
    let count = source.below(24);
    let is_wild = source.one_in(4);
    let mut joints: Vec<BespokeJoint> = (0..count).map(|index| joint(index, source, is_wild)).collect();
    if source.one_in(32) {
        joints.iter_mut().for_each(|joint| joint.reserved = 1);
    }
    let set = if source.one_in(2) { bespoke_session_set_source_rig } else { bespoke_session_set_target_rig };
    let first = if source.one_in(32) { null() } else { joints.as_ptr() };
    // SAFETY: the session is null or alive, there are as many joints as said or the pointer is null, and names end.
    unsafe { after(session, "set_rig", set(session, first, count)) };
}

fn joint(index: usize, source: &mut Source, is_wild: bool) -> BespokeJoint {
    let name = match source.below(NAMES.len() + 1) {
        0 => null::<c_char>(),
        k => NAMES[k - 1].as_ptr(),
    };
    let parent = match source.byte() {
        _ if index == 0 => BESPOKE_NO_JOINT,
        0..16 => BESPOKE_NO_JOINT,
        16..32 if is_wild => source.u32(),
        byte if is_wild => u32::from(byte) % 24,
        byte => u32::from(byte) % index as u32,
    };
    let scale: f64 = [1.0, 1.0, 100.0, 0.0, -1.0, 1e-12][source.below(6)];
    let mut bind = [0.0; BESPOKE_TRANSFORM_SIZE];
    [bind[0], bind[5], bind[10], bind[15]] = [scale, scale, scale.abs(), 1.0];
    bind[12..15].fill_with(|| source.signed());
    if is_wild && source.one_in(8) {
        bind[source.below(BESPOKE_TRANSFORM_SIZE)] = source.number();
    }
    BespokeJoint { name, parent, reserved: 0, bind }
}

fn set_pairs(session: *mut BespokeSession, source: &mut Source) {
    let count = source.below(6);
    let joint = |_| if source.one_in(8) { u32::from(u16::MAX) } else { u32::from(source.byte() % 24) };
    let joints: Vec<u32> = (0..2 * count).map(joint).collect();
    let pairs = Array::indices(&joints, 2, 0, source.one_in(2));
    let view = pairs.view();
    let view = if source.one_in(16) { null() } else { &view };
    // SAFETY: the session is null or alive, the view null or true.
    unsafe { after(session, "set_joint_pairs", bespoke_session_set_joint_pairs(session, view)) };
}

fn set_weights(session: *mut BespokeSession, source: &mut Source) {
    let vertices = if source.one_in(2) { 16 } else { source.between(0, 40) };
    let weights: Vec<f64> = (0..2 * vertices).map(|_| if source.one_in(32) { source.number() } else { 0.5 }).collect();
    let joints: Vec<u32> = (0..2 * vertices).map(|_| u32::from(source.byte() % 4)).collect();
    let (joints, weights) = (Array::indices(&joints, 2, 0, true), Array::floats(&weights, 2, 0, source.one_in(2)));
    let set = if source.one_in(2) {
        bespoke_session_set_source_skin_influences
    } else {
        bespoke_session_set_garment_skin_influences
    };
    let joint_count = source.between(2, 24);
    // SAFETY: the session is null or alive, the views tell the truth.
    unsafe { after(session, "set_skin", set(session, &joints.view(), &weights.view(), 2, joint_count)) };
}

fn read_map(session: *mut BespokeSession, source: &mut Source) {
    let empty =
        BespokeMappedJoint { target: 7, reason: u32::MAX, confidence: f64::NAN, part: [1; BESPOKE_PART_NAME_SIZE] };
    let mut joints = vec![empty; source.below(32)];
    let mut count = usize::MAX;
    // SAFETY: the session is null or alive; there is room for what is written.
    let status = unsafe {
        let status = bespoke_session_read_joint_map(session, joints.as_mut_ptr(), joints.len(), &mut count);
        after(session, "read_joint_map", status)
    };
    assert_eq!(count == usize::MAX, status != BespokeStatus::Ok);
    if status != BespokeStatus::Ok {
        return;
    }
    // SAFETY: as above; nothing is written.
    let again = unsafe { bespoke_session_read_joint_map(session, null_mut(), 0, null_mut()) };
    assert_eq!(again, BespokeStatus::Ok);
    for (k, joint) in joints.iter().enumerate() {
        assert_eq!(joint.reason != u32::MAX, k < count, "what there is is written, and no more");
        if k < count {
            assert!(joint.reason <= BespokeJointReason::Ancestor as u32);
            assert!((0.0..=1.0).contains(&joint.confidence) && joint.part.contains(&0));
        }
    }
}
