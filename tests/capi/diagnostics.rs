//! Diagnostics that a caller reads about its inputs, element by element.

use std::ffi::CStr;
use std::mem::size_of;
use std::ptr::null_mut;

use bespoke::capi::diagnostics::*;
use bespoke::capi::inputs::bespoke_session_set_target_skin_influences;
use bespoke::capi::options::bespoke_session_set_options;
use bespoke::capi::running::*;
use bespoke::capi::session::bespoke_session_reset;
use bespoke::capi::status::BespokeStatus::{InflationStalled, InvalidArgument, SelfIntersection};
use bespoke::capi::view::BespokeComponent;

use testing::caller::{Caller, Mesh, bones, no_options, points, triangles, tube, view};

pub fn read(caller: &Caller, room: usize) -> (Vec<BespokeDiagnostic>, usize) {
    let mut list = vec![0u64; room * size_of::<BespokeDiagnostic>() / 8];
    // The words are little-endian: the size of the first is in the lower half.
    list.iter_mut().take(1).for_each(|first| *first = size_of::<BespokeDiagnostic>() as u64);
    let mut count = usize::MAX;
    // SAFETY: the session is alive, and there is room for as many as said.
    caller.accepted(unsafe {
        bespoke_session_read_diagnostics(caller.session, list.as_mut_ptr().cast(), room, &mut count)
    });
    let written = room.min(count);
    // SAFETY: as many were written; the words are aligned as the struct is.
    (unsafe { std::slice::from_raw_parts(list.as_ptr().cast::<BespokeDiagnostic>(), written) }.to_vec(), count)
}

fn message(diagnostic: &BespokeDiagnostic) -> &str {
    // SAFETY: a zero byte ends the message.
    unsafe { CStr::from_ptr(diagnostic.message.as_ptr()) }.to_str().expect("UTF-8")
}

/// The sample with each triangle's corners as vertices of its own, one triangle twice, a vertex that nothing uses, and a
/// blade through two walls.
fn caller() -> (Caller, [u32; 4]) {
    let (caller, sample) = Caller::with_sample();
    let (whole, faces) = &sample.garment;
    let mut positions: Vec<[f32; 3]> = faces.iter().flatten().map(|&v| whole[v as usize]).collect();
    let mut corners: Vec<[u32; 3]> = (0..faces.len() as u32).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect();
    let double = corners.len() as u32;
    corners.push(corners[7]);
    let blade = corners.len() as u32;
    let at = positions.len() as u32;
    let [a, b, c] = faces[20].map(|v| whole[v as usize]);
    let middle: [f32; 3] = std::array::from_fn(|k| (a[k] + b[k] + c[k]) / 3.0);
    let near = |f: f32, g: f32| [f * middle[0] + g, f * middle[1] - g, middle[2] + g];
    positions.extend([near(0.98, 0.001), near(1.02, 0.002), near(1.02, -0.002)]);
    corners.push([at, at + 1, at + 2]);
    let unused = positions.len() as u32;
    positions.push([9.0, 9.0, 9.0]);
    caller.accepted(caller.set_garment(&points(&positions), &triangles(&corners)));
    (caller, [7, double, blade, unused])
}

#[test]
fn every_flaw_is_named_by_the_callers_own_indices() {
    let (caller, [original, double, blade, unused]) = caller();
    assert_eq!(read(&caller, 4).1, 0, "nothing is known before prepare");
    // SAFETY: the session is alive.
    caller.accepted(unsafe { bespoke_session_prepare(caller.session) });
    let (list, count) = read(&caller, 1000);
    assert_eq!(list.len(), count);
    let of = |kind: BespokeDiagnosticKind| list.iter().filter(move |d| d.kind == kind as u32);
    let elements = |d: &BespokeDiagnostic| -> Vec<(u32, u32, u32)> {
        d.elements[..d.element_count as usize].iter().map(|e| (e.subject, e.kind, e.index)).collect()
    };
    let garment = BespokeSubject::Garment as u32;
    let triangle = |index| (garment, BespokeElementKind::Triangle as u32, index);
    let vertex = |index| (garment, BespokeElementKind::Vertex as u32, index);

    let split: Vec<_> = of(BespokeDiagnosticKind::SplitVertices).collect();
    assert_eq!((split.len(), split[0].severity), (1, BespokeSeverity::Note as u32));
    let twice: Vec<_> = of(BespokeDiagnosticKind::DuplicateTriangle).collect();
    assert_eq!(twice.len(), 1);
    assert!(elements(twice[0]).contains(&triangle(double)) && elements(twice[0]).contains(&triangle(original)));
    assert!(of(BespokeDiagnosticKind::UnusedVertex).any(|d| elements(d) == [vertex(unused)]));
    let crossing: Vec<_> = of(BespokeDiagnosticKind::SelfIntersection).collect();
    assert!(!crossing.is_empty());
    for d in crossing {
        assert_eq!((d.severity, d.element_count), (BespokeSeverity::Warning as u32, 2));
        assert!(elements(d).contains(&triangle(blade)), "{}", message(d));
        for (_, _, index) in elements(d) {
            assert!(message(d).contains(&index.to_string()), "{}", message(d));
        }
    }
    assert!(list.iter().all(|d| !message(d).is_empty() && d.struct_size as usize == size_of::<BespokeDiagnostic>()));
    a_longer_struct_is_filled_in_its_own_steps(&caller, &list);

    let (few, all) = read(&caller, 2);
    assert_eq!((few.len(), all), (2, count));
    assert_eq!(message(&few[1]), message(&list[1]));
    // SAFETY: the session is alive; a null list with a capacity is refused.
    let refused = unsafe { bespoke_session_read_diagnostics(caller.session, null_mut(), 3, null_mut()) };
    caller.refused(refused, InvalidArgument, &["diagnostics", "null"]);
    // SAFETY: the session is alive.
    caller.accepted(unsafe { bespoke_session_reset(caller.session) });
    assert_eq!(read(&caller, 4).1, 0, "reset forgets them");
}

/// A program built with a later header has longer structs: each is written where that program looks for it.
fn a_longer_struct_is_filled_in_its_own_steps(caller: &Caller, list: &[BespokeDiagnostic]) {
    let size = size_of::<BespokeDiagnostic>();
    let longer = size + 24;
    let mut room = vec![0xee_u8; 2 * longer];
    let read = |room: &mut [u8], size: usize| {
        room[..4].copy_from_slice(&(size as u32).to_ne_bytes());
        // SAFETY: the session is alive, and there is room for two of the longest size that is told.
        unsafe { bespoke_session_read_diagnostics(caller.session, room.as_mut_ptr().cast(), 2, null_mut()) }
    };
    for wrong in [0, size - 8, size + 4] {
        caller.refused(read(&mut room, wrong), InvalidArgument, &["diagnostics", "struct_size", &wrong.to_string()]);
        assert!(room[4..].iter().all(|&byte| byte == 0xee), "nothing is written");
    }
    caller.accepted(read(&mut room, longer));
    for (bytes, expected) in room.chunks(longer).zip(list) {
        // SAFETY: as many bytes were written as the struct has, and any are one.
        let written = unsafe { bytes.as_ptr().cast::<BespokeDiagnostic>().read_unaligned() };
        assert_eq!((written.struct_size as usize, written.kind), (longer, expected.kind));
        assert_eq!(message(&written), message(expected));
        assert!(bytes[size..].iter().all(|&byte| byte == 0), "what this version does not know is 0");
    }
}

/// Where prepare fails, what it found can be read all the same.
#[test]
fn a_failed_prepare_leaves_its_diagnostics() {
    let (caller, _) = caller();
    let options = bespoke::capi::options::BespokeOptions { strict: 1, ..no_options() };
    // SAFETY: the session is alive and the options are good.
    caller.accepted(unsafe { bespoke_session_set_options(caller.session, &options) });
    // SAFETY: the session is alive.
    caller.refused(unsafe { bespoke_session_prepare(caller.session) }, SelfIntersection, &["strict", "triangles"]);
    let (list, _) = read(&caller, 1000);
    let crossing = |d: &&BespokeDiagnostic| d.kind == BespokeDiagnosticKind::SelfIntersection as u32;
    assert!(list.iter().filter(crossing).count() > 0);
    assert!(list.iter().filter(crossing).all(|d| d.severity == BespokeSeverity::Error as u32));
}

/// A box around the y axis from x = `low` to `high`.
fn block(low: f32, high: f32, half: f32) -> Mesh {
    let corner =
        |k: u32| [if k & 1 == 0 { low } else { high }, (k >> 1 & 1) as f32 - 0.5, half * (k >> 2) as f32 - 0.5 * half];
    let square = |[a, b, c, d]: [u32; 4]| [[a, b, c], [a, c, d]];
    let sides = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
    ((0..8).map(corner).collect(), sides.into_iter().flat_map(square).collect())
}

/// Two boxes on two bones that overlap at full size, and a sleeve around one of them: what holds it can be read after the
/// failure, and is forgotten by a reset.
#[test]
fn a_stalled_inflation_names_what_holds_the_garment() {
    let caller = Caller::new();
    let joints = [[0.0, -1.0, 0.0], [0.0, 1.0, 0.0], [1.0, -1.0, 0.0], [1.0, 1.0, 0.0]];
    let (mut positions, mut corners) = block(-0.5, 0.5, 0.8);
    let (other, faces) = block(0.4, 1.4, 0.6);
    positions.extend(other);
    corners.extend(faces.iter().map(|t| t.map(|v| v + 8)));
    let garment = tube(0.3, -0.4, 0.4, 20, 12);
    let pairs = [[0, 1], [2, 3], [1, 3]];
    caller.accepted(caller.set_garment(&points(&garment.0), &triangles(&garment.1)));
    caller.accepted(caller.set_avatar(&points(&positions), &triangles(&corners)));
    caller.accepted(caller.set_source_skeleton(&points(&joints), &bones(&pairs)));
    caller.accepted(caller.set_target_skeleton(&points(&joints), &bones(&pairs)));
    // Joints 0 and 2 belong to one bone each.
    let skin: Vec<[u16; 1]> = (0..16).map(|v| [if v < 8 { 0 } else { 2 }]).collect();
    let (joints, weights) = (view(&skin, BespokeComponent::U16), view(&[[1.0f32]; 16], BespokeComponent::F32));
    // SAFETY: the session is alive and the views are valid.
    caller.accepted(unsafe { bespoke_session_set_target_skin_influences(caller.session, &joints, &weights, 1, 4) });
    // SAFETY: the session is alive.
    caller.refused(
        unsafe { bespoke_session_run(caller.session) },
        InflationStalled,
        &["the diagnostics name what holds the garment"],
    );

    let (list, _) = read(&caller, 100);
    let blocked = |d: &&BespokeDiagnostic| d.kind == BespokeDiagnosticKind::InflationBlocked as u32;
    let first = list.iter().find(blocked).expect("what holds the garment");
    assert_eq!((first.severity, first.element_count, first.distance), (BespokeSeverity::Error as u32, 3, 0.0));
    let [cloth, one, another] = [0, 1, 2].map(|k| first.elements[k]);
    assert!([cloth, one, another].iter().all(|e| e.kind == BespokeElementKind::Triangle as u32));
    assert_eq!(cloth.subject, BespokeSubject::Garment as u32);
    assert!((cloth.index as usize) < garment.1.len());
    // One triangle of each box.
    assert_eq!(
        (one.subject, another.subject),
        (BespokeSubject::TargetAvatar as u32, BespokeSubject::TargetAvatar as u32)
    );
    assert_ne!(one.index < 12, another.index < 12);
    for words in ["no garment can pass there", "(joints 0-1)", "(joints 2-3)"] {
        assert!(message(first).contains(words), "{}", message(first));
    }
    // SAFETY: the session is alive.
    caller.accepted(unsafe { bespoke_session_reset(caller.session) });
    assert_eq!(read(&caller, 4).1, 0);
}
