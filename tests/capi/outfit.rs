//! Garments that are worn together, as a C program asks about them.

use std::ptr::{null, null_mut};

use bespoke::capi::control::bespoke_session_cancel;
use bespoke::capi::inputs::*;
use bespoke::capi::outfit::*;
use bespoke::capi::running::*;
use bespoke::capi::session::*;
use bespoke::capi::status::BespokeStatus::{Cancelled, InvalidArgument, InvalidMesh, InvalidState, Ok as Fine};

use testing::caller::{Caller, Mesh, points, triangles};

/// A tube along y, open at both ends.
fn tube(radius: f32, [low, high]: [f32; 2], rings: u32) -> Mesh {
    let sides = 24;
    let (mut positions, mut corners) = (Vec::new(), Vec::new());
    for r in 0..=rings {
        for s in 0..sides {
            let angle = std::f32::consts::TAU * s as f32 / sides as f32;
            let y = low + (high - low) * r as f32 / rings as f32;
            positions.push([radius * angle.cos(), y, radius * angle.sin()]);
        }
    }
    for r in 0..rings {
        for s in 0..sides {
            let at = |r: u32, s: u32| r * sides + s % sides;
            let [a, b, c, d] = [at(r, s), at(r + 1, s), at(r + 1, s + 1), at(r, s + 1)];
            corners.extend([[a, b, c], [a, c, d]]);
        }
    }
    (positions, corners)
}

/// A jacket, a shirt under it, and trousers, into which the shirt is tucked.
fn outfit() -> [Mesh; 3] {
    [tube(0.36, [-0.3, 0.6], 9), tube(0.3, [-0.2, 0.6], 8), tube(0.33, [-1.0, 0.0], 10)]
}

fn with_outfit(garments: &[Mesh]) -> Caller {
    let caller = Caller::new();
    for (p, t) in garments {
        // SAFETY: the session is alive and the views are valid.
        caller.accepted(unsafe { bespoke_session_add_outfit_garment(caller.session, &points(p), &triangles(t)) });
    }
    caller
}

/// The whole order.
fn order(caller: &Caller) -> Vec<u32> {
    let mut count = 0;
    // SAFETY: the session is alive, and there is room for what is written.
    unsafe {
        caller.accepted(bespoke_session_read_outfit_order(caller.session, null_mut(), 0, &mut count));
        let mut order = vec![u32::MAX; count];
        caller.accepted(bespoke_session_read_outfit_order(caller.session, order.as_mut_ptr(), count, null_mut()));
        order
    }
}

fn pairs(caller: &Caller) -> Vec<BespokeWornPair> {
    let unwritten = BespokeWornPair { inner: 77, outer: 77, confidence: 77.0, is_overruled: 77, reserved: 77 };
    let mut count = 0;
    // SAFETY: as above.
    unsafe {
        caller.accepted(bespoke_session_read_worn_pairs(caller.session, null_mut(), 0, &mut count));
        let mut pairs = vec![unwritten; count];
        caller.accepted(bespoke_session_read_worn_pairs(caller.session, pairs.as_mut_ptr(), count, null_mut()));
        pairs
    }
}

#[test]
fn an_outfit_is_worn_from_the_innermost_outwards() {
    let [jacket, shirt, trousers] = outfit();
    let caller = with_outfit(&[jacket, shirt, trousers]);
    let found = order(&caller);
    let place = |garment: u32| found.iter().position(|&g| g == garment).expect("each is in the order");
    assert_eq!(found.len(), 3);
    assert!(place(1) < place(0) && place(1) < place(2), "{found:?}");
    let pairs = pairs(&caller);
    assert!(pairs.windows(2).all(|two| two[0].confidence >= two[1].confidence));
    assert!(pairs.iter().any(|pair| (pair.inner, pair.outer) == (1, 0) && pair.confidence > 0.9));
    assert!(pairs.iter().all(|pair| pair.is_overruled == 0 && pair.reserved == 0));
    // The first that fit.
    let (mut first, mut count) = ([9u32; 1], 0);
    // SAFETY: the session is alive, and there is room for what is written.
    unsafe {
        caller.accepted(bespoke_session_read_outfit_order(caller.session, first.as_mut_ptr(), 1, &mut count));
        assert_eq!((first[0], count), (found[0], 3));
        caller.accepted(bespoke_session_clear_outfit(caller.session));
    }
    assert_eq!((order(&caller), self::pairs(&caller)), (Vec::new(), Vec::new()));
}

#[test]
fn the_nearer_to_the_source_avatar_is_the_inner_one_where_neither_encloses_the_other() {
    // Two straps beside each other, the second one farther off.
    let strap = |z: f32| -> Mesh {
        (vec![[-0.1, -0.4, z], [0.1, -0.4, z], [0.1, 0.4, z], [-0.1, 0.4, z]], vec![[0, 1, 2], [0, 2, 3]])
    };
    let caller = with_outfit(&[strap(0.34), strap(0.325)]);
    assert_eq!((order(&caller), pairs(&caller).len()), (vec![0, 1], 0), "nothing is known without the body");
    let (p, t) = tube(0.3, [-1.0, 1.0], 20);
    // SAFETY: the session is alive and the views are valid.
    caller.accepted(unsafe { bespoke_session_set_source_avatar(caller.session, &points(&p), &triangles(&t)) });
    assert_eq!(order(&caller), [1, 0]);
    let found = pairs(&caller);
    assert!(found.len() == 1 && found[0].confidence <= 0.5, "{found:?}");
}

#[test]
fn the_outfit_takes_no_part_in_the_run_and_is_read_in_any_state() {
    let (caller, sample) = Caller::with_sample();
    let (p, t) = (points(&sample.garment.0), triangles(&sample.garment.1));
    // SAFETY: the session is alive and the views are valid.
    unsafe {
        let session = caller.session;
        caller.accepted(bespoke_session_add_outfit_garment(session, &p, &t));
        caller.accepted(bespoke_session_prepare(session));
        caller.refused(bespoke_session_add_outfit_garment(session, &p, &t), InvalidState, &["outfit", "reset"]);
        caller.refused(bespoke_session_clear_outfit(session), InvalidState, &["outfit", "reset"]);
        assert_eq!(order(&caller), [0]);
        caller.accepted(bespoke_session_run(session));
        assert_eq!(order(&caller), [0]);
        caller.accepted(bespoke_session_reset(session));
        caller.accepted(bespoke_session_add_outfit_garment(session, &p, &t));
        assert_eq!(order(&caller).len(), 2);
        caller.accepted(bespoke_session_cancel(session));
        let read = bespoke_session_read_outfit_order(session, null_mut(), 0, null_mut());
        assert!(read == Fine || read == Cancelled, "what is known needs no work");
        let find = bespoke_session_find_intersections(session, &p, &t, null(), null(), null_mut(), 0, null_mut());
        assert_eq!([read, find].iter().filter(|&&status| status == Cancelled).count(), 1, "a request is answered once");
    }
}

#[test]
fn intersecting_pairs_are_those_of_the_verifier() {
    let caller = Caller::new();
    let session = caller.session;
    let [jacket, shirt, _] = outfit();
    let across: Mesh = (vec![[-1.0, 0.11, -1.0], [3.0, 0.12, -1.0], [-1.0, 0.13, 3.0]], vec![[0, 1, 2]]);
    let find = |a: &Mesh, b: Option<&Mesh>| {
        let views = [points(&a.0), triangles(&a.1)];
        let others = b.map(|b| [points(&b.0), triangles(&b.1)]);
        let others = others.as_ref().map_or([null(), null()], |b| b.each_ref().map(std::ptr::from_ref));
        let mut count = usize::MAX;
        // SAFETY: the session is alive, the views are null or valid, and there is room for what is written.
        unsafe {
            let find = |pairs: *mut u32, capacity, count| {
                let [positions, triangles] = &views;
                let [q, u] = others;
                bespoke_session_find_intersections(session, positions, triangles, q, u, pairs, capacity, count)
            };
            caller.accepted(find(null_mut(), 0, &mut count));
            let mut pairs = vec![[u32::MAX; 2]; count];
            caller.accepted(find(pairs.as_mut_ptr().cast(), count, null_mut()));
            pairs
        }
    };
    assert_eq!(find(&jacket, Some(&shirt)), [[0; 2]; 0]);
    let cut = find(&jacket, Some(&across));
    assert!(cut.len() >= 24 && cut.iter().all(|&[s, t]| s < jacket.1.len() as u32 && t == 0), "a ring is cut");
    assert!(cut.windows(2).all(|two| two[0] < two[1]));
    let turned = find(&across, Some(&jacket));
    assert_eq!(turned.iter().map(|&[s, t]| [t, s]).collect::<Vec<_>>(), cut);
    assert_eq!(find(&shirt, None), [[0; 2]; 0]);
    let mut both = shirt.clone();
    let first = both.0.len() as u32;
    both.0.extend(&across.0);
    both.1.extend(across.1.iter().map(|t| t.map(|v| v + first)));
    assert_eq!(find(&both, None).len(), find(&shirt, Some(&across)).len());
}

#[test]
fn what_cannot_be_used_is_refused() {
    let caller = Caller::new();
    let session = caller.session;
    let [(p, t), ..] = outfit();
    let (points, corners) = (points(&p), triangles(&t));
    let mut broken = t.clone();
    broken[3][1] = 5000;
    // SAFETY: the session is alive, the views are null or valid.
    unsafe {
        assert_eq!(bespoke_session_add_outfit_garment(null_mut(), &points, &corners), InvalidArgument);
        assert_eq!(bespoke_session_clear_outfit(null_mut()), InvalidArgument);
        let added = bespoke_session_add_outfit_garment(session, null(), &corners);
        caller.refused(added, InvalidArgument, &["outfit garment 0 positions", "null"]);
        let added = bespoke_session_add_outfit_garment(session, &points, &triangles(&broken));
        caller.refused(added, InvalidMesh, &["outfit garment 0: triangle 3", "5000"]);
        let read = bespoke_session_read_outfit_order(session, null_mut(), 3, null_mut());
        caller.refused(read, InvalidArgument, &["outfit order", "null"]);
        let read = bespoke_session_read_worn_pairs(session, null_mut(), 3, null_mut());
        caller.refused(read, InvalidArgument, &["worn pairs", "null"]);
        let find = |q, u, pairs, capacity| {
            bespoke_session_find_intersections(session, &points, &corners, q, u, pairs, capacity, null_mut())
        };
        caller.refused(find(null(), null(), null_mut(), 2), InvalidArgument, &["intersections", "null"]);
        caller.refused(find(&points, null(), null_mut(), 0), InvalidArgument, &["second mesh triangles", "null"]);
        let other = triangles(&broken);
        caller.refused(find(&points, &other, null_mut(), 0), InvalidMesh, &["second mesh: triangle 3", "5000"]);
    }
}
