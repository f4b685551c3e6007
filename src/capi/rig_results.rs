//! What makes a result move: skin weights on the target rig, and the joints that the garment brings along.

use glam::{DAffine3, DMat4};

use crate::capi::list::List;
use crate::capi::rigs::{BESPOKE_NO_JOINT, BESPOKE_TRANSFORM_SIZE};
use crate::capi::session::{BespokeSession, call};
use crate::capi::status::BespokeStatus;
use crate::capi::view::invalid;
use crate::input::skin::SkinWeights;
use crate::rig::weights::own_joints::AddedJoint;

/// Writes so many joints and weights for each vertex of `skin`, the largest weight first.
///
/// # Safety
/// There is room for them.
pub(super) unsafe fn write_influences(skin: &SkinWeights, influences: usize, joints: *mut u32, weights: *mut f32) {
    for vertex in 0..skin.vertex_count() {
        let mut row = skin.weights(vertex).to_vec();
        row.sort_by(|a, b| b.1.total_cmp(&a.1));
        for k in 0..influences {
            let (joint, weight) = row.get(k).copied().unwrap_or((0, 0.0));
            // SAFETY: the caller vouches for `influences` numbers a vertex.
            unsafe {
                joints.add(vertex * influences + k).write_unaligned(joint);
                weights.add(vertex * influences + k).write_unaligned(weight as f32);
            }
        }
    }
}

/// Writes skin weights of the result on the joints of the target rig, or on those of the target skeleton where no rig was
/// set: those of the body beneath, where the garment lies along it, and smoothly on from there where it does not. Vertices
/// of a rigid group have the same. With weights of the garment on its own joints (bespoke_session_set_garment_skin_influences),
/// such as those of a skirt or a cape, these joints come along: see bespoke_session_read_added_joints.
///
/// `influences`: joints a vertex, such as 4 or 8. `joints`, `weights`: `vertices` times `influences` of each, vertex after
/// vertex, the largest weight first; weights are not negative and sum to 1 for each vertex, and what a vertex does not need
/// is joint 0 with weight 0. `vertices`: those that there is room for, at least the garment's. `*joint_count`, unless null:
/// joints of the target rig and added joints together. State: DONE, with skin weights of the target avatar set. Errors:
/// INVALID_ARGUMENT (null, no influences, too little room), INVALID_STATE, INVALID_WEIGHTS (the avatar's weights are all
/// 0), CANCELLED, BUSY, INTERNAL. Threads: any, one at a time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bespoke_session_read_garment_skin_influences(
    session: *const BespokeSession,
    influences: usize,
    joints: *mut u32,
    weights: *mut f32,
    vertices: usize,
    joint_count: *mut usize,
) -> BespokeStatus {
    // SAFETY: passed on from the caller, who vouches for room for `vertices` times `influences` numbers of each kind, and
    // for one more number.
    unsafe {
        call(session, |session| {
            if joints.is_null() || weights.is_null() {
                return invalid("garment skin: a pointer is null".into());
            }
            let skin = session.garment_skin(influences)?;
            let count = skin.vertex_count();
            if vertices < count {
                return invalid(format!(
                    "garment skin: there is room for {vertices} vertices, the garment has {count}"
                ));
            }
            if !joint_count.is_null() {
                joint_count.write(skin.joint_count());
            }
            write_influences(&skin, influences, joints, weights);
            Ok(())
        })
    }
}

/// A joint of the garment's own, which follows on those of the target rig.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BespokeAddedJoint {
    /// The joint of the source rig that it is.
    pub source: u32,
    /// The joint that moves it: one of the target rig, or an added one, which are numbered on from there; BESPOKE_NO_JOINT
    /// for a root.
    pub parent: u32,
    /// Its bind transform in the coordinate system of the target, as in BespokeJoint.
    pub bind: [f64; BESPOKE_TRANSFORM_SIZE],
}

impl From<&AddedJoint> for BespokeAddedJoint {
    fn from(joint: &AddedJoint) -> Self {
        Self {
            source: joint.source,
            parent: joint.parent.unwrap_or(BESPOKE_NO_JOINT),
            bind: DMat4::from(joint.bind).to_cols_array(),
        }
    }
}

/// Writes the garment's own joints: those of the source rig that move the garment, are no part of a body and have no
/// counterpart in the target rig, with what is between them and the first joint above that has one. They are placed where the
/// result has taken what they move.
///
/// `joints`: room for `capacity` of them, in the order of their numbers: the first is the number of joints of the target rig.
/// The first that fit are written. May be null where `capacity` is 0. `*count`, unless null: how many there are. State: DONE,
/// with skin weights of the target avatar set. Errors: INVALID_ARGUMENT (null with a capacity), INVALID_STATE,
/// INVALID_WEIGHTS, CANCELLED, BUSY, INTERNAL. Threads: any, one at a time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bespoke_session_read_added_joints(
    session: *const BespokeSession,
    joints: *mut BespokeAddedJoint,
    capacity: usize,
    count: *mut usize,
) -> BespokeStatus {
    // SAFETY: passed on from the caller, who vouches for room for `capacity` joints and for one number.
    unsafe {
        call(session, |session| {
            let list = List::new(joints, capacity, count, "added joints")?;
            let added = session.added_joints()?;
            list.write(added.iter().map(BespokeAddedJoint::from));
            Ok(())
        })
    }
}

/// Writes how each joint of the target rig moves from its bind pose to the pose that the result is in: 4 x 4 numbers each,
/// column after column, to be multiplied from the left. They are all the identity, but where the diagnostic POSE_BLOCKED says
/// that the result is in the pose of the design: there, garment and avatar that are read are in that pose.
///
/// `transforms`: room for `capacity` times BESPOKE_TRANSFORM_SIZE numbers; the first that fit are written. May be null where
/// `capacity` is 0. `*count`, unless null: joints of the target rig. State: DONE, with a target rig. Errors: INVALID_ARGUMENT
/// (null with a capacity), INVALID_STATE, BUSY, INTERNAL. Threads: any, one at a time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bespoke_session_read_pose_transforms(
    session: *const BespokeSession,
    transforms: *mut f64,
    capacity: usize,
    count: *mut usize,
) -> BespokeStatus {
    // SAFETY: passed on from the caller, who vouches for room for `capacity` transforms and for one number.
    unsafe {
        call(session, |session| {
            let list =
                List::new(transforms.cast::<[f64; BESPOKE_TRANSFORM_SIZE]>(), capacity, count, "pose transforms")?;
            let joints = session.target_joint_count()?;
            let motions = session.pose_transforms();
            let motion = |joint: usize| motions.map_or(DAffine3::IDENTITY, |motions| motions[joint]);
            list.write((0..joints).map(|joint| DMat4::from(motion(joint)).to_cols_array()));
            Ok(())
        })
    }
}
