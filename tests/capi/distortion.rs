//! The distortion of each triangle, as a C program reads it.

use std::ptr::{null, null_mut};

use bespoke::capi::results::bespoke_session_read_distortion;
use bespoke::capi::running::*;
use bespoke::capi::status::BespokeStatus::{InvalidArgument, InvalidState};
use bespoke::capi::view::{BespokeBuffer, BespokeComponent};

use testing::caller::Caller;

fn buffer<T>(room: &mut [T], component: BespokeComponent) -> BespokeBuffer {
    BespokeBuffer { data: room.as_mut_ptr().cast(), capacity: room.len(), stride: 0, component: component as u32 }
}

#[test]
fn there_is_a_number_for_each_triangle_in_both_precisions() {
    let (caller, sample) = Caller::with_sample();
    let triangles = sample.garment.1.len();
    let (mut doubles, mut floats) = (vec![-1.0f64; triangles], vec![[-1.0f32, 7.0]; triangles]);
    let mut count = 0;
    // SAFETY: the session is alive and the buffers as large as said.
    unsafe {
        let nowhere = BespokeBuffer { data: null_mut(), capacity: 0, stride: 0, component: 1 };
        let status = bespoke_session_read_distortion(caller.session, &nowhere, &mut count);
        caller.refused(status, InvalidState, &["prepare"]);
        caller.accepted(bespoke_session_prepare(caller.session));
        caller.accepted(bespoke_session_read_distortion(caller.session, &nowhere, &mut count));
        assert_eq!(count, triangles);
        caller.accepted(bespoke_session_run(caller.session));
        let whole = buffer(&mut doubles, BespokeComponent::F64);
        caller.accepted(bespoke_session_read_distortion(caller.session, &whole, null_mut()));
        // One number of two, in a struct of the caller's.
        let strided = BespokeBuffer { stride: 8, ..buffer(&mut floats, BespokeComponent::F32) };
        caller.accepted(bespoke_session_read_distortion(caller.session, &strided, null_mut()));
    }
    assert!(doubles.iter().all(|&d| d >= 0.0 && d.is_finite()) && doubles.iter().any(|&d| d > 1e-9));
    for (double, float) in doubles.iter().zip(&floats) {
        assert_eq!(*float, [*double as f32, 7.0]);
    }
}

#[test]
fn buffers_that_cannot_be_are_refused() {
    let (caller, sample) = Caller::with_sample();
    let mut room = vec![7.0f32; sample.garment.1.len()];
    let good = buffer(&mut room, BespokeComponent::F32);
    let mut count = 0;
    // SAFETY: the session is alive, and what a buffer does not hold is refused.
    unsafe {
        caller.accepted(bespoke_session_prepare(caller.session));
        let mut read = |buffer: *const BespokeBuffer| {
            count = 0;
            let status = bespoke_session_read_distortion(caller.session, buffer, &mut count);
            assert_eq!(count, room.len());
            status
        };
        for (bad, word) in [
            (BespokeBuffer { component: 3, ..good }, "component is 3"),
            (BespokeBuffer { capacity: room.len() - 1, ..good }, "capacity"),
            (BespokeBuffer { stride: 3, ..good }, "stride is 3"),
            (BespokeBuffer { data: null_mut(), ..good }, "null"),
        ] {
            caller.refused(read(&bad), InvalidArgument, &["distortion", word]);
        }
        caller.refused(read(null()), InvalidArgument, &["distortion", "null"]);
    }
    assert!(room.iter().all(|&d| d == 7.0), "nothing is written by a call that is refused");
}
