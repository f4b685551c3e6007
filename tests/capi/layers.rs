//! Garments that the avatar wears already, as a C program adds them.

use std::ptr::{null, null_mut};

use bespoke::capi::layers::*;
use bespoke::capi::results::*;
use bespoke::capi::running::*;
use bespoke::capi::session::*;
use bespoke::capi::status::BespokeStatus::{InvalidArgument, InvalidMesh, InvalidState};
use bespoke::capi::view::{BespokeBuffer, BespokeComponent, BespokeView};
use bespoke::geometry::mesh::TriangleMesh;
use bespoke::verify::intersections;
use glam::DVec3;

use testing::caller::{Caller, Mesh, Sample, points, triangles, view};

/// The garment on the avatar and these layers.
fn dressed(sample: &Sample, layers: &[Mesh]) -> Mesh {
    let caller = Caller::new();
    caller.set_sample(sample);
    let mut room = vec![[0.0f32; 3]; sample.garment.0.len()];
    let buffer = BespokeBuffer { data: room.as_mut_ptr().cast(), capacity: room.len(), stride: 0, component: 1 };
    // SAFETY: the session is alive, views and buffer are as large as said.
    unsafe {
        for (p, t) in layers {
            caller.accepted(bespoke_session_add_layer(caller.session, &points(p), &triangles(t)));
        }
        caller.accepted(bespoke_session_run(caller.session));
        let mut counts = BespokeIntersections::default();
        caller.accepted(bespoke_session_verify(caller.session, BespokeComponent::F32 as u32, &mut counts));
        assert_eq!(counts, BespokeIntersections::default());
        let mut avatar = 0;
        let nowhere = BespokeBuffer { data: null_mut(), capacity: 0, stride: 0, component: 1 };
        caller.accepted(bespoke_session_read_avatar_vertices(caller.session, &nowhere, &mut avatar));
        assert_eq!(avatar, sample.avatar.0.len(), "the avatar alone");
        caller.accepted(bespoke_session_read_garment_vertices(caller.session, &buffer, null_mut()));
    }
    (room, sample.garment.1.clone())
}

fn mesh((positions, triangles): &Mesh) -> TriangleMesh {
    let positions = positions.iter().map(|p| DVec3::from(p.map(f64::from))).collect();
    TriangleMesh { positions, triangles: triangles.clone() }
}

#[test]
fn three_garments_over_each_other() {
    let sample = Sample::new();
    let mut layers = Vec::new();
    for _ in 0..3 {
        layers.push(dressed(&sample, &layers));
    }
    for (k, outer) in layers.iter().enumerate() {
        for inner in layers[..k].iter().chain([&sample.avatar]) {
            assert_eq!(intersections(&mesh(outer), Some(&mesh(inner)), 0).unwrap().count, 0);
        }
        let radius = |(p, _): &Mesh| p.iter().map(|p| p[0].hypot(p[2])).sum::<f32>();
        assert!(layers[..k].iter().all(|inner| radius(inner) < radius(outer)), "layer {k} is not outside");
    }
}

#[test]
fn layers_are_refused_by_name_and_number() {
    let (caller, sample) = Caller::with_sample();
    let session = caller.session;
    let (p, t) = (points(&sample.garment.0), triangles(&sample.garment.1));
    // SAFETY: the session is alive and the views are valid, or are refused.
    let add = |p: *const BespokeView, t: *const BespokeView| unsafe { bespoke_session_add_layer(session, p, t) };
    caller.refused(add(null(), &t), InvalidArgument, &["layer 0 positions", "null"]);
    caller.refused(add(&p, null()), InvalidArgument, &["layer 0 triangles", "null"]);
    caller.refused(add(&t, &t), InvalidArgument, &["layer 0 positions", "component is 4"]);
    caller.accepted(add(&p, &t));
    let mut broken = sample.garment.1.clone();
    broken[33][2] = 9000;
    caller.refused(add(&p, &triangles(&broken)), InvalidMesh, &["layer 1: triangle 33", "9000"]);
    let mut away = sample.garment.0.clone();
    away[7][1] = f32::NAN;
    caller.refused(add(&points(&away), &t), InvalidMesh, &["layer 1", "vertex 7"]);
    caller.refused(add(&points(&[]), &triangles(&[])), InvalidMesh, &["layer 1"]);
    // 64-bit points and 16-bit indices.
    let doubles: Vec<[f64; 3]> = sample.garment.0.iter().map(|p| p.map(f64::from)).collect();
    let shorts: Vec<[u16; 3]> = sample.garment.1.iter().map(|t| t.map(|v| v as u16)).collect();
    caller.accepted(add(&view(&doubles, BespokeComponent::F64), &view(&shorts, BespokeComponent::U16)));
}

#[test]
fn layers_are_fixed_from_prepare_to_reset() {
    let (caller, sample) = Caller::with_sample();
    let (p, t) = (points(&sample.garment.0), triangles(&sample.garment.1));
    // SAFETY: the session is alive and the views are valid.
    unsafe {
        assert_eq!(bespoke_session_add_layer(null_mut(), &p, &t), InvalidArgument);
        assert_eq!(bespoke_session_clear_layers(null_mut()), InvalidArgument);
        let session = caller.session;
        caller.accepted(bespoke_session_prepare(session));
        caller.refused(bespoke_session_add_layer(session, &p, &t), InvalidState, &["layer", "reset"]);
        caller.refused(bespoke_session_clear_layers(session), InvalidState, &["layers", "reset"]);
        caller.accepted(bespoke_session_reset(session));
        caller.accepted(bespoke_session_clear_layers(session));
        caller.accepted(bespoke_session_add_layer(session, &p, &t));
        caller.accepted(bespoke_session_clear_layers(session));
        caller.accepted(bespoke_session_prepare(session));
    }
}
