//! Pins, rigid groups and curves, as a C program sets them.

use std::ptr::null;

use bespoke::capi::fit::*;
use bespoke::capi::results::bespoke_session_read_garment_vertices;
use bespoke::capi::running::{bespoke_session_prepare, bespoke_session_run};
use bespoke::capi::session::bespoke_session_reset;
use bespoke::capi::status::BespokeStatus::{self, InvalidArgument};
use bespoke::capi::view::{BespokeBuffer, BespokeComponent};

use testing::caller::{Caller, points, view};

fn pin(caller: &Caller, vertices: &[u16], places: &[[f32; 3]]) -> BespokeStatus {
    let (vertices, places) = (view(vertices, BespokeComponent::U16), points(places));
    // SAFETY: the views are valid.
    unsafe { bespoke_session_set_pinned_vertices(caller.session, &vertices, &places) }
}

fn rigid(caller: &Caller, vertices: &[u32]) -> BespokeStatus {
    // SAFETY: the view is valid.
    unsafe { bespoke_session_add_rigid_group(caller.session, &view(vertices, BespokeComponent::U32)) }
}

fn prepare(caller: &Caller) -> BespokeStatus {
    // SAFETY: the session is alive.
    unsafe { bespoke_session_prepare(caller.session) }
}

fn result(caller: &Caller, count: usize) -> Vec<[f32; 3]> {
    let mut x = vec![[0.0; 3]; count];
    let buffer = BespokeBuffer {
        data: x.as_mut_ptr().cast(),
        capacity: count,
        stride: 0,
        component: BespokeComponent::F32 as u32,
    };
    // SAFETY: the session is alive and the buffer is valid.
    unsafe {
        caller.accepted(bespoke_session_run(caller.session));
        caller.accepted(bespoke_session_read_garment_vertices(caller.session, &buffer, std::ptr::null_mut()));
    }
    x
}

fn distance(a: [f32; 3], b: [f32; 3]) -> f32 {
    a.iter().zip(b).map(|(x, y)| (x - y) * (x - y)).sum::<f32>().sqrt()
}

#[test]
fn pins_and_groups_do_what_they_say() {
    let (caller, sample) = Caller::with_sample();
    let place = [0.4, -0.4, 0.1];
    caller.accepted(pin(&caller, &[0], &[place]));
    let group = [40, 41, 56, 57, 58];
    caller.accepted(rigid(&caller, &group));
    let x = result(&caller, sample.garment.0.len());
    assert!(distance(x[0], place) < 0.005, "{:?}", x[0]);
    // The target skeleton is 1.1 times as large, and a rigid group with it.
    for [v, w] in [[40, 58], [41, 56], [57, 40]] {
        let [now, was] = [&x, &sample.garment.0].map(|p| distance(p[v], p[w]));
        assert!((now / was - 1.1).abs() < 1e-5, "vertices {v} and {w}: {now}, designed {was}");
    }
    // Without places the pins go with their bones; without vertices there are none.
    // SAFETY: the session is alive and the views are valid.
    unsafe {
        caller.accepted(bespoke_session_reset(caller.session));
        caller.accepted(bespoke_session_clear_rigid_groups(caller.session));
        let vertices = view(&[0u32], BespokeComponent::U32);
        caller.accepted(bespoke_session_set_pinned_vertices(caller.session, &vertices, null()));
    }
    let x = result(&caller, sample.garment.0.len());
    let [px, py, pz] = sample.garment.0[0];
    // In the normalised space the skeletons are of one size.
    assert!(distance(x[0], [1.1 * px, 1.1 * py, 1.1 * pz]) < 0.005, "{:?}", x[0]);
}

#[test]
fn bad_pins_and_groups_are_refused() {
    let (caller, sample) = Caller::with_sample();
    let count = sample.garment.0.len() as u16;
    caller.refused(pin(&caller, &[1, 2], &[[0.0; 3]]), InvalidArgument, &["2 vertices", "1 targets"]);
    caller.refused(pin(&caller, &[1, 1], &[[0.0; 3]; 2]), InvalidArgument, &["vertex 1", "twice"]);
    caller.refused(pin(&caller, &[1], &[[f32::NAN; 3]]), InvalidArgument, &["pinned"]);
    caller.accepted(pin(&caller, &[count], &[[0.0; 3]]));
    caller.refused(prepare(&caller), InvalidArgument, &["pinned", &format!("vertex {count}")]);
    caller.accepted(pin(&caller, &[], &[]));
    caller.refused(rigid(&caller, &[]), InvalidArgument, &["rigid group 0"]);
    caller.accepted(rigid(&caller, &[3, 4]));
    caller.refused(rigid(&caller, &[5, 4]), InvalidArgument, &["rigid group 1", "vertex 4", "rigid group 0"]);
    caller.accepted(rigid(&caller, &[u32::from(count)]));
    caller.refused(prepare(&caller), InvalidArgument, &["rigid group 1", &format!("vertex {count}")]);
    // SAFETY: the session is alive.
    unsafe {
        caller.refused(
            bespoke_session_set_pinned_vertices(caller.session, null(), null()),
            InvalidArgument,
            &["pinned"],
        );
        caller.refused(bespoke_session_add_rigid_group(caller.session, null()), InvalidArgument, &["rigid group"]);
        caller.accepted(bespoke_session_clear_rigid_groups(caller.session));
    }
    caller.accepted(prepare(&caller));
    caller.refused(pin(&caller, &[0], &[[0.0; 3]]), BespokeStatus::InvalidState, &["reset"]);
    caller.refused(rigid(&caller, &[0]), BespokeStatus::InvalidState, &["reset"]);
}

#[test]
fn curves_are_added_cleared_and_refused() {
    let (caller, sample) = Caller::with_sample();
    let add = |vertices: &[u32], closed: u32, weights: [f64; 2]| {
        let view = view(vertices, BespokeComponent::U32);
        // SAFETY: the view is valid.
        unsafe { bespoke_session_add_curve(caller.session, &view, closed, weights[0], weights[1]) }
    };
    let ring: Vec<u32> = (0..16).collect();
    caller.refused(add(&ring, 2, [1.0; 2]), InvalidArgument, &["closed is 2"]);
    caller.refused(add(&ring[..2], 1, [1.0; 2]), InvalidArgument, &["curve 0", "closed"]);
    caller.refused(add(&ring[..1], 0, [1.0; 2]), InvalidArgument, &["curve 0", "open"]);
    caller.refused(add(&[4, 5, 4], 0, [1.0; 2]), InvalidArgument, &["vertex 4", "twice"]);
    for bad in [-1.0, f64::NAN, f64::INFINITY] {
        caller.refused(add(&ring, 1, [bad, 1.0]), InvalidArgument, &["curve 0", "curve weight"]);
        caller.refused(add(&ring, 1, [1.0, bad]), InvalidArgument, &["curve 0", "position weight"]);
    }
    caller.accepted(add(&[3, 5], 0, [1.0; 2]));
    caller.refused(prepare(&caller), InvalidArgument, &["curve 0", "vertices 3 and 5"]);
    // SAFETY: the session is alive.
    let clear = || unsafe { bespoke_session_clear_curves(caller.session) };
    caller.accepted(clear());
    caller.accepted(add(&[0, 60_000], 0, [1.0; 2]));
    caller.refused(prepare(&caller), InvalidArgument, &["curve 0", "vertex 60000"]);
    caller.accepted(clear());
    // The same boundary twice, once the other way around.
    caller.accepted(add(&ring, 1, [2.0, 0.5]));
    caller.accepted(add(&ring.iter().rev().copied().collect::<Vec<_>>(), 1, [1.0; 2]));
    caller.refused(prepare(&caller), InvalidArgument, &["curve 1", "curve 0"]);
    caller.accepted(clear());
    let plain = result(&caller, sample.garment.0.len());
    caller.refused(clear(), BespokeStatus::InvalidState, &["reset"]);
    // SAFETY: the session is alive.
    unsafe { caller.accepted(bespoke_session_reset(caller.session)) };
    caller.accepted(add(&ring, 1, [1.0; 2]));
    assert_eq!(result(&caller, sample.garment.0.len()), plain);
    // SAFETY: the session is alive.
    unsafe { caller.accepted(bespoke_session_reset(caller.session)) };
    caller.accepted(clear());
    caller.accepted(add(&ring, 1, [0.0; 2]));
    assert_ne!(result(&caller, sample.garment.0.len()), plain);
}
