//! Calls for garments that are worn together.

use std::ptr::null;

use bespoke::capi::outfit::*;
use bespoke::capi::session::BespokeSession;
use bespoke::capi::status::BespokeStatus;

use super::array::Array;
use super::caller::after;
use super::source::Source;

/// One call.
pub fn call(session: *mut BespokeSession, source: &mut Source) {
    match source.below(6) {
        0 | 1 => {
            let [points, triangles] = mesh(source);
            // SAFETY: the session is null or alive, the views are true.
            unsafe {
                let status = bespoke_session_add_outfit_garment(session, &points.view(), &triangles.view());
                after(session, "add_outfit_garment", status);
            }
        }
        // SAFETY: the session is null or alive.
        2 if source.one_in(4) => drop(unsafe { after(session, "clear_outfit", bespoke_session_clear_outfit(session)) }),
        2 | 3 => read_order(session, source),
        4 => read_pairs(session, source),
        _ => find_intersections(session, source),
    }
}

fn mesh(source: &mut Source) -> [Array; 2] {
    let count = source.between(3, 12);
    let points: Vec<f64> =
        (0..3 * count).map(|_| if source.one_in(64) { source.number() } else { source.signed() }).collect();
    let corners = 3 * source.between(1, 6);
    let most = if source.one_in(16) { count + 1 } else { count };
    let triangles: Vec<u32> = (0..corners).map(|_| source.below(most) as u32).collect();
    [Array::floats(&points, 3, 0, source.one_in(2)), Array::indices(&triangles, 3, 0, source.one_in(2))]
}

fn read_order(session: *mut BespokeSession, source: &mut Source) {
    let mut order = vec![u32::MAX; source.below(4)];
    let mut count = usize::MAX;
    // SAFETY: the session is null or alive, and there is room for what is written.
    let status = unsafe {
        let read = bespoke_session_read_outfit_order(session, order.as_mut_ptr(), order.len(), &mut count);
        after(session, "read_outfit_order", read)
    };
    if status == BespokeStatus::Ok {
        let written = order.len().min(count);
        assert!(order[..written].iter().all(|&garment| (garment as usize) < count));
    }
}

fn read_pairs(session: *mut BespokeSession, source: &mut Source) {
    let unwritten = BespokeWornPair { inner: 7, outer: 7, confidence: f64::NAN, is_overruled: 7, reserved: 7 };
    let mut pairs = vec![unwritten; source.below(4)];
    let mut count = usize::MAX;
    // SAFETY: as above.
    let status = unsafe {
        let read = bespoke_session_read_worn_pairs(session, pairs.as_mut_ptr(), pairs.len(), &mut count);
        after(session, "read_worn_pairs", read)
    };
    if status == BespokeStatus::Ok {
        let written = pairs.len().min(count);
        assert!(pairs[..written].iter().all(|pair| (0.0..=1.0).contains(&pair.confidence) && pair.is_overruled < 2));
    }
}

fn find_intersections(session: *mut BespokeSession, source: &mut Source) {
    let ([points, triangles], [others, corners]) = (mesh(source), mesh(source));
    let views = [others.view(), corners.view()];
    let given = if source.one_in(2) { views.each_ref().map(std::ptr::from_ref) } else { [null(), null()] };
    let mut pairs = vec![u32::MAX; 2 * source.below(8)];
    let mut count = usize::MAX;
    // SAFETY: as above, and the views are null or true.
    let status = unsafe {
        let status = bespoke_session_find_intersections(
            session,
            &points.view(),
            &triangles.view(),
            given[0],
            given[1],
            pairs.as_mut_ptr(),
            pairs.len() / 2,
            &mut count,
        );
        after(session, "find_intersections", status)
    };
    if status == BespokeStatus::Ok {
        assert!(pairs[..2 * count.min(pairs.len() / 2)].iter().all(|&t| t < 6));
    }
}
