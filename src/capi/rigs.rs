//! Rigs of characters, and the map between two of them.

use std::ffi::{CStr, c_char};

use glam::DMat4;

use crate::capi::inputs::skin_influences;
use crate::capi::list::List;
use crate::capi::session::{BespokeSession, call};
use crate::capi::status::BespokeStatus;
use crate::capi::text;
use crate::capi::view::{self, BespokeView, invalid};
use crate::error::Result;
use crate::input::buffer;
use crate::input::rig::{MAX_RIG_JOINTS, Rig, RigJoint};
use crate::rig::joint_map::{MappedJoint, Reason};
use crate::rig::part_name::name;

/// In place of a joint's number: no joint.
pub const BESPOKE_NO_JOINT: u32 = 0xFFFF_FFFF;

/// Numbers of a 4 x 4 transform.
pub const BESPOKE_TRANSFORM_SIZE: usize = 16;

/// A joint of a rig.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct BespokeJoint {
    /// Its name, UTF-8, as the tool has it; ends with a zero byte. Null: it has none.
    pub name: *const c_char,
    /// The joint that moves it, from 0, in any order; BESPOKE_NO_JOINT for a root.
    pub parent: u32,
    /// 0.
    pub reserved: u32,
    /// The bind transform: from the joint's own space to that in which the mesh is given, in the pose in which the mesh is
    /// given. 4 x 4 numbers, column after column, so that numbers 12 to 14 (from 0) are the joint's place: the memory of
    /// glTF, OpenGL, Unity and Unreal, and the inverse of an inverse bind matrix.
    pub bind: [f64; BESPOKE_TRANSFORM_SIZE],
}

/// Bytes of the part in BespokeMappedJoint, its zero byte included.
pub const BESPOKE_PART_NAME_SIZE: usize = 32;

/// Why a joint is mapped as it is.
#[repr(u32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BespokeJointReason {
    /// Nothing corresponds to it: a control, a prop, or above all that was recognised.
    Nothing = 0,
    /// The caller said so.
    Caller = 1,
    /// The names of both say that they are the same part of the body.
    Name = 2,
    /// At least for one of the two, its place among the others says so.
    Structure = 3,
    /// Of several joints in spine or neck, it has the same place in the order.
    Order = 4,
    /// Both have the same name, which stands for no part of the body.
    SameName = 5,
    /// It has no counterpart and goes with the joint above it.
    Ancestor = 6,
}

/// A joint of the source rig and what corresponds to it in the target rig.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BespokeMappedJoint {
    /// The target rig's joint; BESPOKE_NO_JOINT where there is none.
    pub target: u32,
    /// One of BespokeJointReason.
    pub reason: u32,
    /// From 0, a guess, to 1, sure.
    pub confidence: f64,
    /// The part of the body, such as "left upper arm"; ends with a zero byte. Empty where it is none.
    pub part: [c_char; BESPOKE_PART_NAME_SIZE],
}

impl From<&MappedJoint> for BespokeMappedJoint {
    fn from(joint: &MappedJoint) -> Self {
        let reason = match joint.reason {
            Reason::Nothing => BespokeJointReason::Nothing,
            Reason::Caller => BespokeJointReason::Caller,
            Reason::Name => BespokeJointReason::Name,
            Reason::Structure => BespokeJointReason::Structure,
            Reason::Order => BespokeJointReason::Order,
            Reason::SameName => BespokeJointReason::SameName,
            Reason::Ancestor => BespokeJointReason::Ancestor,
        };
        let mut part = [0; BESPOKE_PART_NAME_SIZE];
        let part_name = joint.part.map_or_else(String::new, name);
        let name = text::cut(&part_name, BESPOKE_PART_NAME_SIZE - 1);
        part.iter_mut().zip(name.bytes()).for_each(|(to, from)| *to = from as c_char);
        Self {
            target: joint.target.unwrap_or(BESPOKE_NO_JOINT),
            reason: reason as u32,
            confidence: joint.confidence,
            part,
        }
    }
}

/// # Safety
/// `joints` is null or points to `count` joints, whose names are null or end with a zero byte.
unsafe fn rig(joints: *const BespokeJoint, count: usize, name: &str) -> Result<Rig> {
    if joints.is_null() && count > 0 {
        return invalid(format!("{name}: the pointer is null but the count is {count}"));
    }
    if count > MAX_RIG_JOINTS {
        return invalid(format!("{name}: there are {count} joints, at most {MAX_RIG_JOINTS} can be used"));
    }
    let mut rig = Rig::default();
    for index in 0..count {
        // SAFETY: not null, and the caller vouches for `count` joints.
        let joint = unsafe { joints.add(index).read_unaligned() };
        if joint.reserved != 0 {
            return invalid(format!("{name}: joint {index} has {} in reserved, which must be 0", joint.reserved));
        }
        let text = if joint.name.is_null() {
            String::new()
        } else {
            // SAFETY: not null, and the caller vouches for a zero byte at its end.
            unsafe { CStr::from_ptr(joint.name) }.to_string_lossy().into_owned()
        };
        let parent = (joint.parent != BESPOKE_NO_JOINT).then_some(joint.parent);
        rig.joints.push(RigJoint { name: text, parent, bind: DMat4::from_cols_array(&joint.bind) });
    }
    Ok(rig)
}

/// In place of a source skeleton: the rig of the body on which the garment was designed, in the coordinate system of the
/// garment. With a rig on both sides no skeletons have to correspond: which joints do follows from their names, from their
/// places and from bespoke_session_set_joint_pairs, and can be read with bespoke_session_read_joint_map. A skeleton beside
/// a rig is read as a rig without names.
///
/// `joints`: `count` of them, at most 65535. Ownership: copied during the call. State: SETUP; the later one of skeleton and
/// rig counts. Errors: INVALID_ARGUMENT, INVALID_SKELETON (no joints, a parent that is no joint, parents in a circle, a
/// number that is not finite, a last row that is not 0, 0, 0, 1; that nothing corresponds is found by
/// bespoke_session_prepare), INVALID_STATE, BUSY, INTERNAL. Threads: any, one at a time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bespoke_session_set_source_rig(
    session: *mut BespokeSession,
    joints: *const BespokeJoint,
    count: usize,
) -> BespokeStatus {
    // SAFETY: passed on from the caller.
    unsafe { call(session, |session| session.set_source_rig(rig(joints, count, "source rig")?)) }
}

/// In place of a target skeleton: the rig of the body to dress, in its coordinate system and in the pose in which it is given.
/// The weights of bespoke_session_set_target_skin_weights and _influences are then on its joints. That source and target
/// stand in different poses, such as an A-pose and a T-pose, needs nothing.
///
/// `joints`: `count` of them, at most 65535. Ownership: copied during the call. State: SETUP; the later one of skeleton and
/// rig counts. Errors: as for bespoke_session_set_source_rig. Threads: any, one at a time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bespoke_session_set_target_rig(
    session: *mut BespokeSession,
    joints: *const BespokeJoint,
    count: usize,
) -> BespokeStatus {
    // SAFETY: passed on from the caller.
    unsafe { call(session, |session| session.set_target_rig(rig(joints, count, "target rig")?)) }
}

/// Optional: skin weights of the source avatar on the source rig. They tell which of its joints move nothing, and where the
/// top of the head is in a rig that has no joint there.
///
/// `joints`, `weights`, `influences`, `joint_count`: as for bespoke_session_set_target_skin_influences. Ownership: copied
/// during the call. State: SETUP. Errors: INVALID_ARGUMENT, INVALID_WEIGHTS (a wrong size may be found only by
/// bespoke_session_prepare), INVALID_STATE, BUSY, INTERNAL. Threads: any, one at a time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bespoke_session_set_source_skin_influences(
    session: *mut BespokeSession,
    joints: *const BespokeView,
    weights: *const BespokeView,
    influences: usize,
    joint_count: usize,
) -> BespokeStatus {
    const NAME: &str = "source skin weights";
    // SAFETY: passed on from the caller.
    unsafe {
        call(session, |session| {
            session.set_source_skin(skin_influences(joints, weights, influences, joint_count, NAME)?)
        })
    }
}

/// Optional: skin weights of the garment as it was modelled, on the source rig.
///
/// `joints`, `weights`, `influences`, `joint_count`: as for bespoke_session_set_target_skin_influences, one element for each
/// vertex of the garment. Ownership: copied during the call. State: SETUP. Errors: INVALID_ARGUMENT, INVALID_WEIGHTS (a
/// wrong size may be found only by bespoke_session_prepare), INVALID_STATE, BUSY, INTERNAL. Threads: any, one at a time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bespoke_session_set_garment_skin_influences(
    session: *mut BespokeSession,
    joints: *const BespokeView,
    weights: *const BespokeView,
    influences: usize,
    joint_count: usize,
) -> BespokeStatus {
    const NAME: &str = "garment skin weights";
    // SAFETY: passed on from the caller.
    unsafe {
        call(session, |session| {
            session.set_garment_skin(skin_influences(joints, weights, influences, joint_count, NAME)?)
        })
    }
}

/// Optional: joints of the two rigs that correspond. They win over names and places. Replaces earlier pairs.
///
/// `pairs`: a joint of the source rig and one of the target rig each, U16 or U32; BESPOKE_NO_JOINT (65535 in U16) as the
/// second: nothing corresponds to it. Each joint is in one pair at most. Ownership: copied during the call. State: SETUP.
/// Errors: INVALID_ARGUMENT (a joint that a rig does not have, or one in two pairs, is found by bespoke_session_prepare and
/// bespoke_session_read_joint_map), INVALID_STATE, BUSY, INTERNAL. Threads: any, one at a time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bespoke_session_set_joint_pairs(
    session: *mut BespokeSession,
    pairs: *const BespokeView,
) -> BespokeStatus {
    const NAME: &str = "joint pairs";
    // SAFETY: passed on from the caller.
    unsafe {
        call(session, |session| {
            let view = view::indices(pairs, NAME)?;
            let none = view::largest_index(view.component);
            let read = buffer::read_pairs(&view, NAME)?;
            session.set_joint_pairs(read.into_iter().map(|[a, b]| (a, (b != none).then_some(b))).collect())
        })
    }
}

/// Writes which joint of the target rig corresponds to each joint of the source rig, why, and how sure that is: for an editor
/// to show, and for a caller to mend with bespoke_session_set_joint_pairs.
///
/// `joints`: room for `capacity` of them, one for each joint of the source rig in its order; the first that fit are written.
/// May be null where `capacity` is 0. `*count`, unless null: how many there are. State: any, with rig or skeleton set on
/// both sides; the map is that of what is set. Errors: INVALID_ARGUMENT (null with a capacity, a pair that suits no
/// joints), INVALID_WEIGHTS (weights that do not suit their rig), INVALID_STATE (a rig is missing), BUSY, INTERNAL.
/// Threads: any, one at a time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bespoke_session_read_joint_map(
    session: *const BespokeSession,
    joints: *mut BespokeMappedJoint,
    capacity: usize,
    count: *mut usize,
) -> BespokeStatus {
    // SAFETY: passed on from the caller, who vouches for room for `capacity` joints and for one number.
    unsafe {
        call(session, |session| {
            let list = List::new(joints, capacity, count, "joint map")?;
            let map = session.joint_map()?;
            list.write(map.joints.iter().map(BespokeMappedJoint::from));
            Ok(())
        })
    }
}
