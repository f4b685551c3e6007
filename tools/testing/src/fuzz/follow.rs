//! Calls for what goes along with a garment: normals of render vertices, morphs, meshes that follow, and what is worn with it.

use std::ptr::{null, null_mut};

use bespoke::capi::followers::*;
use bespoke::capi::morphs::*;
use bespoke::capi::normals::bespoke_session_read_garment_normals;
use bespoke::capi::session::BespokeSession;
use bespoke::capi::status::BespokeStatus;
use bespoke::capi::view::{BespokeBuffer, BespokeComponent};

use super::array::Array;
use super::caller::after;
use super::outfit;
use super::source::Source;

/// One call.
pub fn call(session: *mut BespokeSession, source: &mut Source) {
    match source.below(10) {
        0 => read_normals(session, source),
        1 | 2 => add_morph(session, source),
        3 => add_follower(session, source),
        4 => clear(session, source),
        // SAFETY: the session is null or alive.
        5 => unsafe {
            after(session, "solve_target_morphs", bespoke_session_solve_target_morphs(session));
            after(session, "set_morph_weight", bespoke_session_set_target_morph_weight(session, 0, 0.5));
        },
        6 | 7 => outfit::call(session, source),
        _ => read_points(session, source),
    }
}

fn add_morph(session: *mut BespokeSession, source: &mut Source) {
    // The sample has between 9 and 36 vertices.
    let count = source.between(8, 36);
    let size = if source.one_in(2) { 0.05 } else { 1.0 };
    let offsets: Vec<f64> = numbers(source, count, 3).iter().map(|x| size * x).collect();
    let offsets = Array::floats(&offsets, 3, 0, source.one_in(2));
    let view = offsets.view();
    let pointer = if source.one_in(16) { null() } else { &raw const view };
    let name = [null(), c"wide".as_ptr(), c"\xff\xfe".as_ptr()][source.below(3)];
    let add = if source.one_in(2) { bespoke_session_add_garment_morph } else { bespoke_session_add_target_morph };
    // SAFETY: the session is null or alive, the view null or true, and the name null or ends.
    unsafe { after(session, "add_morph", add(session, name, pointer)) };
}

fn add_follower(session: *mut BespokeSession, source: &mut Source) {
    let count = source.between(3, 12);
    let points = Array::floats(&numbers(source, count, 3), 3, 0, source.one_in(2));
    let corners = 3 * source.between(1, 6);
    let most = if source.one_in(16) { count + 1 } else { count };
    let triangles: Vec<u32> = (0..corners).map(|_| source.below(most) as u32).collect();
    let triangles = Array::indices(&triangles, 3, 0, source.one_in(2));
    // SAFETY: the session is null or alive, the views are true.
    unsafe {
        after(session, "add_follower", bespoke_session_add_follower(session, &points.view(), &triangles.view()));
    }
}

fn clear(session: *mut BespokeSession, source: &mut Source) {
    let clear = [
        bespoke_session_clear_garment_morphs as unsafe extern "C" fn(*mut BespokeSession) -> BespokeStatus,
        bespoke_session_clear_target_morphs,
        bespoke_session_clear_followers,
    ][source.below(3)];
    // SAFETY: the session is null or alive.
    unsafe { after(session, "clear", clear(session)) };
}

type ReadPoints = unsafe extern "C" fn(*const BespokeSession, u32, *const BespokeBuffer, *mut usize) -> BespokeStatus;

fn read_points(session: *mut BespokeSession, source: &mut Source) {
    let read = [
        bespoke_session_read_garment_morph as ReadPoints,
        bespoke_session_read_target_morph,
        bespoke_session_read_follower_vertices,
    ][source.below(3)];
    let index = if source.one_in(8) { source.u32() } else { source.below(3) as u32 };
    let mut room = vec![7.0; 3 * source.below(48)];
    let (out, mut count) = (buffer(&mut room, 3), usize::MAX);
    // SAFETY: the session is null or alive, and there is room for what is written.
    let status = unsafe { after(session, "read_points", read(session, index, &out, &mut count)) };
    assert!(room.iter().all(|x| x.is_finite()));
    assert!(status == BespokeStatus::Ok || room.iter().all(|&x| x == 7.0), "a refused call writes nothing");
    let (vertices, influences) = (source.below(40), source.below(5));
    let (mut joints, mut weights) = (vec![7; vertices * influences], vec![7.0f32; vertices * influences]);
    let (to_joints, to_weights) = (joints.as_mut_ptr(), weights.as_mut_ptr());
    // SAFETY: as above.
    unsafe {
        let read = bespoke_session_read_follower_skin_influences;
        let status = read(session, index, influences, to_joints, to_weights, vertices, null_mut());
        after(session, "read_follower_skin_influences", status);
    }
    assert!(weights.iter().all(|w| w.is_finite()));
}

fn buffer(room: &mut [f64], width: usize) -> BespokeBuffer {
    let capacity = room.len() / width;
    BespokeBuffer { data: room.as_mut_ptr().cast(), capacity, stride: 0, component: BespokeComponent::F64 as u32 }
}

/// As many numbers as `count` elements of `width` take.
fn numbers(source: &mut Source, count: usize, width: usize) -> Vec<f64> {
    (0..count * width).map(|_| if source.one_in(64) { source.number() } else { source.signed() }).collect()
}

fn read_normals(session: *mut BespokeSession, source: &mut Source) {
    // That of the sample is a tube.
    let (rings, sides) = (source.between(2, 5), source.between(3, 6));
    let count = (rings + 1) * sides;
    let triangles: Vec<u32> = (0..6 * rings * sides).map(|_| source.below(count) as u32).collect();
    let triangles = Array::indices(&triangles, 3, 0, source.one_in(2));
    let normals = Array::floats(&numbers(source, count, 3), 3, 0, source.one_in(2));
    let tangents = Array::floats(&numbers(source, count, 4), 4, 0, source.one_in(2));
    let views = [triangles.view(), normals.view(), tangents.view()];
    let given = views.each_ref().map(|view| if source.one_in(2) { null() } else { std::ptr::from_ref(view) });
    let room = source.below(64);
    let (mut to_normals, mut to_tangents) = (vec![7.0; 3 * room], vec![7.0; 4 * room]);
    let outs = [buffer(&mut to_normals, 3), buffer(&mut to_tangents, 4)];
    let second = if source.one_in(2) { null() } else { std::ptr::from_ref(&outs[1]) };
    let mut written = usize::MAX;
    let to_count = if source.one_in(8) { null_mut() } else { &raw mut written };
    let [corners, designed, along] = given;
    // SAFETY: the session is null or alive, the views are null or true, and there is room for what is written.
    let status = unsafe {
        let status =
            bespoke_session_read_garment_normals(session, corners, designed, along, &outs[0], second, to_count);
        after(session, "read_garment_normals", status)
    };
    if status == BespokeStatus::Ok {
        assert!(to_normals.iter().chain(&to_tangents).all(|x| x.is_finite()));
    } else {
        assert!(to_normals.iter().chain(&to_tangents).all(|&x| x == 7.0), "a refused call writes nothing");
    }
}
