//! Calls for what goes along with a garment: normals of render vertices.

use std::ptr::{null, null_mut};

use bespoke::capi::normals::bespoke_session_read_garment_normals;
use bespoke::capi::session::BespokeSession;
use bespoke::capi::status::BespokeStatus;
use bespoke::capi::view::{BespokeBuffer, BespokeComponent};

use super::array::Array;
use super::caller::after;
use super::source::Source;

/// One call.
pub fn call(session: *mut BespokeSession, source: &mut Source) {
    read_normals(session, source);
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
