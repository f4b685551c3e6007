//! Corrections of key poses: blend shapes driven by joints that keep the garment out of the body.

use std::ffi::{CStr, c_char};

use glam::{DAffine3, DMat4, DVec3, DVec4};

use crate::capi::rigs::BESPOKE_TRANSFORM_SIZE;
use crate::capi::session::{BespokeSession, call};
use crate::capi::status::BespokeStatus;
use crate::capi::view::{self, BespokeBuffer, invalid};
use crate::error::Result;
use crate::input::buffer;
use crate::session::{KeyPose, PoseCounts};

const CORRECTION: &str = "pose correction";

/// How far the last row of a transform may be from 0, 0, 0, 1.
const LAST_ROW: f64 = 1e-6;

/// # Safety
/// `transforms` points to so many times BESPOKE_TRANSFORM_SIZE numbers.
unsafe fn motions(transforms: *const f64, joints: usize) -> Result<Vec<DAffine3>> {
    let motion = |joint: usize| {
        // SAFETY: the caller vouches for these numbers.
        let number = |k: usize| unsafe { transforms.add(joint * BESPOKE_TRANSFORM_SIZE + k).read_unaligned() };
        let matrix = DMat4::from_cols_array(&std::array::from_fn(number));
        if !matrix.is_finite() || matrix.row(3).distance(DVec4::W) > LAST_ROW {
            return invalid(format!(
                "key pose: the transform of joint {joint} is not finite, or its last row is not 0, 0, 0, 1: a transform is 16 \
                 numbers, column after column"
            ));
        }
        Ok(DAffine3::from_mat4(matrix))
    };
    (0..joints).map(motion).collect()
}

/// Optional: a pose of the target rig in which the garment is to keep out of the body, such as a bent arm or a crouch. Each call
/// adds one; they are numbered from 0.
///
/// `name`: UTF-8, for messages; null: none. `transforms`: for each joint of the target rig how it moves what it moves from the bind
/// pose to this pose, in the coordinate system of the target: BESPOKE_TRANSFORM_SIZE numbers each, column after column, to be
/// multiplied from the left. In an engine's words: the joint's posed global transform times its inverse bind matrix.
/// `joint_count`: as many as the target rig has. Ownership: copied during the call. State: SETUP or DONE, with a target rig;
/// in DONE the result stays. Errors: INVALID_ARGUMENT (null, another number of joints, a number that is not finite, a transform
/// without inverse), INVALID_STATE, BUSY, INTERNAL. Threads: any, one at a time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bespoke_session_add_key_pose(
    session: *mut BespokeSession,
    name: *const c_char,
    transforms: *const f64,
    joint_count: usize,
) -> BespokeStatus {
    // SAFETY: passed on from the caller, who vouches for the numbers and for a zero byte at the end of the name.
    unsafe {
        call(session, |session| {
            if transforms.is_null() {
                return invalid("key pose: the pointer to its transforms is null".into());
            }
            let joints = session.target_rig_size()?;
            if joint_count != joints {
                return invalid(format!(
                    "key pose: there are transforms of {joint_count} joints, the target rig has {joints}"
                ));
            }
            let name = if name.is_null() { String::new() } else { CStr::from_ptr(name).to_string_lossy().into_owned() };
            session.add_key_pose(KeyPose { name, motions: motions(transforms, joint_count)? })
        })
    }
}

/// Removes all key poses.
///
/// State: SETUP or DONE. Errors: INVALID_ARGUMENT, INVALID_STATE, BUSY, INTERNAL. Threads: any, one at a time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bespoke_session_clear_key_poses(session: *mut BespokeSession) -> BespokeStatus {
    // SAFETY: passed on from the caller.
    unsafe { call(session, |session| session.clear_key_poses()) }
}

/// Finds the correction of each key pose: offsets of the garment's vertices in the bind pose, a blend shape to be added before the
/// skin weights move them, at full weight in that pose and at none in the bind pose. From the result on, body and garment go to the
/// pose by their skin weights, with no triangle through another on the way, and the garment gives way where it has to. Where the
/// posed body passes through itself, as at the fold of a bent hip, nothing can lie between, and that part of it is left out. The
/// result stays as it is. Corrections that are there already are not sought again. It takes about as long as the fit for each
/// pose in which something passes through something. Meanwhile the progress is in the stage REPOSE.
///
/// `influences`: joints a vertex, as the host will read them with bespoke_session_read_garment_skin_influences. State: DONE, with
/// a target rig and skin weights of the target avatar set; but not where the result is in the pose of the design (POSE_BLOCKED).
/// Errors: INVALID_ARGUMENT (no influences), INVALID_STATE, INVALID_WEIGHTS, CANCELLED (the state stays DONE, and what was found is
/// kept), MEMORY_LIMIT, BUSY, INTERNAL. Threads: any, one at a time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bespoke_session_solve_pose_corrections(
    session: *mut BespokeSession,
    influences: usize,
) -> BespokeStatus {
    // SAFETY: passed on from the caller.
    unsafe { call(session, |session| session.solve_pose_corrections(influences)) }
}

/// Pairs of triangles that pass through each other in a key pose and not in the result's own, counted by the exact verifier.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct BespokePoseIntersections {
    /// Of the garment with itself.
    pub garment_garment: u64,
    /// Of the garment with the avatar or its layers, where these do not pass through themselves.
    pub garment_avatar: u64,
    /// Of the garment with the avatar or its layers where these do, so that nothing can lie between.
    pub in_folds: u64,
}

impl From<PoseCounts> for BespokePoseIntersections {
    fn from(counts: PoseCounts) -> Self {
        Self { garment_garment: counts.garment, garment_avatar: counts.body, in_folds: counts.folds }
    }
}

/// Writes the correction of a key pose: offsets from the result, in the coordinate system of the target. They are 0 where the
/// weights alone do, and all of them where nothing passes through anything, or where none was found that is better.
///
/// `pose`: its number. `offsets`: where to, one for each vertex of the garment, F32 or F64. With null data and capacity 0 nothing
/// is written. `*count`, unless null: vertices of the garment, also where they do not fit. `before`, `after`, unless null: what
/// passes through what in that pose by the weights alone, and with the offsets. State: DONE, after
/// bespoke_session_solve_pose_corrections. Errors: INVALID_ARGUMENT (no such pose, too small a capacity; nothing is written
/// then), INVALID_STATE, BUSY, INTERNAL. Threads: any, one at a time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn bespoke_session_read_pose_correction(
    session: *const BespokeSession,
    pose: u32,
    offsets: *const BespokeBuffer,
    count: *mut usize,
    before: *mut BespokePoseIntersections,
    after: *mut BespokePoseIntersections,
) -> BespokeStatus {
    // SAFETY: passed on from the caller, who vouches for room for one number and for the counts.
    unsafe {
        call(session, |session| {
            let correction = session.pose_correction(pose as usize)?;
            if !count.is_null() {
                count.write(correction.offsets.len());
            }
            let out = view::points_out(offsets, CORRECTION)?;
            if out.capacity > 0 || !out.data.is_null() {
                buffer::write_positions(&out, &correction.offsets as &[DVec3], CORRECTION)?;
            }
            for (to, counts) in [(before, correction.before), (after, correction.after)] {
                if !to.is_null() {
                    to.write_unaligned(counts.into());
                }
            }
            Ok(())
        })
    }
}
