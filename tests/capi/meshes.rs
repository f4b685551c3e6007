//! Meshes and skeletons that cannot be used: refused with the element at fault.

use bespoke::capi::running::bespoke_session_prepare;
use bespoke::capi::status::BespokeStatus::{InvalidMesh, InvalidSkeleton};
use bespoke::capi::view::{BespokeComponent, BespokeView};

use testing::caller::{Caller, Sample, bones, points, triangles, view};

#[test]
fn meshes_without_vertices_or_triangles_are_refused() {
    let (caller, sample) = (Caller::new(), Sample::new());
    let (p, t) = (points(&sample.garment.0), triangles(&sample.garment.1));
    caller.refused(caller.set_garment(&points(&[]), &t), InvalidMesh, &["garment"]);
    caller.refused(caller.set_garment(&p, &triangles(&[])), InvalidMesh, &["garment"]);
    caller.refused(caller.set_avatar(&points(&[]), &triangles(&[])), InvalidMesh, &["target avatar"]);
}

#[test]
fn indices_out_of_range_are_named() {
    let (caller, mut sample) = (Caller::new(), Sample::new());
    let count = sample.garment.0.len() as u32;
    for bad in [count, u32::MAX] {
        sample.garment.1[12][1] = bad;
        let status = caller.set_garment(&points(&sample.garment.0), &triangles(&sample.garment.1));
        caller.refused(status, InvalidMesh, &["garment", "triangle 12", &bad.to_string(), &count.to_string()]);
    }
}

#[test]
fn coordinates_that_are_not_finite_are_named() {
    let (caller, mut sample) = (Caller::new(), Sample::new());
    for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        sample.garment.0[5][2] = bad;
        sample.avatar.0[6][0] = bad;
        let status = caller.set_garment(&points(&sample.garment.0), &triangles(&sample.garment.1));
        caller.refused(status, InvalidMesh, &["garment", "vertex 5"]);
        let status = caller.set_avatar(&points(&sample.avatar.0), &triangles(&sample.avatar.1));
        caller.refused(status, InvalidMesh, &["target avatar", "vertex 6"]);
        let joints = [[0.0, -1.0, 0.0], [0.0, bad, 0.0], [0.0, 1.0, 0.0]];
        let status = caller.set_source_skeleton(&points(&joints), &bones(&sample.bones));
        caller.refused(status, InvalidSkeleton, &["source skeleton", "joint 1"]);
    }
}

#[test]
fn skeletons_that_cannot_be_used_are_refused() {
    let (caller, sample) = (Caller::new(), Sample::new());
    let joints = points(&sample.source_joints);
    caller.refused(caller.set_source_skeleton(&points(&[]), &bones(&[])), InvalidSkeleton, &["source skeleton"]);
    let status = caller.set_target_skeleton(&joints, &bones(&[[0, 1], [1, 9]]));
    caller.refused(status, InvalidSkeleton, &["target skeleton", "9"]);
    let status = caller.set_target_skeleton(&joints, &bones(&[[0, 1]]));
    caller.refused(status, InvalidSkeleton, &["target skeleton", "joint 2"]);
}

#[test]
fn skeletons_of_another_topology_are_refused() {
    let (caller, sample) = Caller::with_sample();
    let joints = points(&sample.target_joints);
    // Order and direction of bones are free; their ends are not.
    caller.accepted(caller.set_target_skeleton(&joints, &bones(&[[2, 1], [1, 0]])));
    caller.accepted(caller.set_target_skeleton(&joints, &bones(&[[0, 1], [0, 2]])));
    // SAFETY: the session is alive.
    let status = unsafe { bespoke_session_prepare(caller.session) };
    caller.refused(status, InvalidSkeleton, &["target skeleton"]);

    let joints = [[0.0, -1.0, 0.0], [0.0, 0.0, 0.0], [0.0, 0.5, 0.0], [0.0, 1.0, 0.0]];
    caller.accepted(caller.set_target_skeleton(&points(&joints), &bones(&[[0, 1], [1, 2], [2, 3]])));
    // SAFETY: the session is alive.
    let status = unsafe { bespoke_session_prepare(caller.session) };
    caller.refused(status, InvalidSkeleton, &["target skeleton"]);

    // A refused prepare changes nothing: with the right skeleton the session goes on.
    caller.set_sample(&sample);
    // SAFETY: the session is alive.
    caller.accepted(unsafe { bespoke_session_prepare(caller.session) });
}

/// One vertex buffer of an engine: positions in the middle of a struct, unaligned, 16-bit indices.
#[test]
fn interleaved_and_narrow_buffers_are_read() {
    let (caller, sample) = (Caller::new(), Sample::new());
    let (stride, offset) = (31, 5);
    let mut bytes = vec![0xAB; sample.garment.0.len() * stride];
    for (vertex, position) in bytes.chunks_exact_mut(stride).zip(&sample.garment.0) {
        for (to, from) in vertex[offset..].chunks_exact_mut(4).zip(position) {
            to.copy_from_slice(&from.to_ne_bytes());
        }
    }
    let positions = BespokeView {
        data: bytes[offset..].as_ptr().cast(),
        count: sample.garment.0.len(),
        stride,
        component: BespokeComponent::F32 as u32,
    };
    let narrow: Vec<[u16; 3]> = sample.garment.1.iter().map(|t| t.map(|v| v as u16)).collect();
    caller.set_sample(&sample);
    caller.accepted(caller.set_garment(&positions, &view(&narrow, BespokeComponent::U16)));
    // SAFETY: the session is alive.
    caller.accepted(unsafe { bespoke_session_prepare(caller.session) });
}
