//! Calls for corrections of key poses.

use std::ptr::{null, null_mut};

use bespoke::capi::key_poses::*;
use bespoke::capi::rigs::BESPOKE_TRANSFORM_SIZE;
use bespoke::capi::session::BespokeSession;
use bespoke::capi::status::BespokeStatus;
use bespoke::capi::view::{BespokeBuffer, BespokeComponent};

use super::caller::after;
use super::source::Source;

/// One call.
pub fn call(session: *mut BespokeSession, source: &mut Source) {
    match source.below(6) {
        0..3 => add(session, source),
        3 if source.one_in(4) => {
            // SAFETY: the session is null or alive.
            unsafe { after(session, "clear_key_poses", bespoke_session_clear_key_poses(session)) };
        }
        3 | 4 => {
            let influences = source.below(5);
            // SAFETY: as above.
            unsafe {
                let status = bespoke_session_solve_pose_corrections(session, influences);
                after(session, "solve_pose_corrections", status);
            }
        }
        _ => read(session, source),
    }
}

/// Turns, shifts and worse of as many joints as the rigs of programs have.
fn add(session: *mut BespokeSession, source: &mut Source) {
    let joints = source.below(24);
    let mut numbers = vec![0.0; joints * BESPOKE_TRANSFORM_SIZE + 1];
    for transform in numbers.chunks_exact_mut(BESPOKE_TRANSFORM_SIZE) {
        let turn = source.signed();
        let (sine, cosine) = turn.sin_cos();
        [transform[0], transform[1], transform[4], transform[5]] = [cosine, sine, -sine, cosine];
        [transform[10], transform[15]] = [1.0, 1.0];
        transform[12..15].fill_with(|| 0.1 * source.signed());
        if source.one_in(64) {
            transform[source.below(BESPOKE_TRANSFORM_SIZE)] = source.number();
        }
    }
    let first = if source.one_in(32) { null() } else { numbers.as_ptr() };
    let name = [null(), c"crouch".as_ptr(), c"\xff\xfe".as_ptr()][source.below(3)];
    // SAFETY: the session is null or alive, there are as many numbers as said or the pointer is null, and the name ends.
    unsafe { after(session, "add_key_pose", bespoke_session_add_key_pose(session, name, first, joints)) };
}

fn read(session: *mut BespokeSession, source: &mut Source) {
    let pose = if source.one_in(8) { source.u32() } else { source.below(3) as u32 };
    let mut room = vec![7.0f64; 3 * source.below(48)];
    let component = BespokeComponent::F64 as u32;
    let out = BespokeBuffer { data: room.as_mut_ptr().cast(), capacity: room.len() / 3, stride: 0, component };
    let (mut before, mut count) = (BespokePoseIntersections::default(), usize::MAX);
    // SAFETY: the session is null or alive, and there is room for what is written.
    let status = unsafe {
        let read = bespoke_session_read_pose_correction(session, pose, &out, &mut count, &mut before, null_mut());
        after(session, "read_pose_correction", read)
    };
    assert!(room.iter().all(|x| x.is_finite()));
    assert!(status == BespokeStatus::Ok || room.iter().all(|&x| x == 7.0), "a refused call writes nothing");
}
