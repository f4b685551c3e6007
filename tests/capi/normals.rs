//! Normals and tangents of the garment, as a C program reads them.

use std::ptr::{null, null_mut};

use bespoke::capi::coordinate_system::*;
use bespoke::capi::normals::bespoke_session_read_garment_normals;
use bespoke::capi::running::*;
use bespoke::capi::status::BespokeStatus::{self, InvalidArgument, InvalidState};
use bespoke::capi::view::{BespokeBuffer, BespokeComponent, BespokeView};
use testing::caller::{Caller, Sample, points, triangles, view};

fn buffer<T>(room: &mut [T]) -> BespokeBuffer {
    let component = BespokeComponent::F32 as u32;
    BespokeBuffer { data: room.as_mut_ptr().cast(), capacity: room.len(), stride: 0, component }
}

/// The outward direction of the tube, which is around the y axis.
fn outward(sample: &Sample) -> Vec<[f32; 3]> {
    let direction = |p: &[f32; 3]| {
        let length = p[0].hypot(p[2]);
        [p[0] / length, 0.0, p[2] / length]
    };
    sample.garment.0.iter().map(direction).collect()
}

struct Read {
    status: BespokeStatus,
    count: usize,
    normals: Vec<[f32; 3]>,
    tangents: Vec<[f32; 4]>,
}

fn read(
    caller: &Caller,
    corners: Option<&BespokeView>,
    normals: Option<&BespokeView>,
    along: Option<&BespokeView>,
    room: usize,
) -> Read {
    let (mut to_normals, mut to_tangents, mut count) = (vec![[7.0; 3]; room], vec![[7.0; 4]; room], usize::MAX);
    let pointer = |view: Option<&BespokeView>| view.map_or(null(), std::ptr::from_ref);
    let (first, second) = (buffer(&mut to_normals), buffer(&mut to_tangents));
    let second = if along.is_some() { &raw const second } else { null() };
    // SAFETY: the session is alive, the views tell the truth, and there is as much room as said.
    let status = unsafe {
        let [corners, normals, along] = [corners, normals, along].map(pointer);
        bespoke_session_read_garment_normals(caller.session, corners, normals, along, &first, second, &mut count)
    };
    Read { status, count, normals: to_normals, tangents: to_tangents }
}

fn near(a: &[f32], b: &[f32], bar: f32) -> bool {
    a.iter().zip(b).all(|(a, b)| (a - b).abs() < bar)
}

#[test]
fn a_tube_keeps_the_normals_of_a_tube() {
    let (caller, sample) = Caller::with_sample();
    let (vertices, normals) = (sample.garment.0.len(), outward(&sample));
    let given = points(&normals);
    caller.refused(read(&caller, None, Some(&given), None, vertices).status, InvalidState, &["prepare"]);
    // SAFETY: the session is alive.
    caller.accepted(unsafe { bespoke_session_run(caller.session) });
    let found = read(&caller, None, Some(&given), None, vertices);
    caller.accepted(found.status);
    assert_eq!(found.count, vertices);
    let unit = |n: &[f32; 3]| (n.iter().map(|x| x * x).sum::<f32>() - 1.0).abs() < 1e-5;
    assert!(found.normals.iter().all(unit));
    let off = found.normals.iter().zip(&normals).filter(|(a, b)| !near(*a, *b, 0.35)).count();
    assert_eq!(off, 0, "{:?}", found.normals);
    // By vertices of its own, in another order: the same.
    let all = vertices as u32 - 1;
    let corners: Vec<[u32; 3]> = sample.garment.1.iter().map(|t| t.map(|v| all - v)).collect();
    let turned: Vec<[f32; 3]> = normals.iter().rev().copied().collect();
    let along = vec![[0.0f32, 1.0, 0.0, -1.0]; vertices];
    let along = view(&along, BespokeComponent::F32);
    let again = read(&caller, Some(&triangles(&corners)), Some(&points(&turned)), Some(&along), vertices);
    caller.accepted(again.status);
    for (v, n) in again.normals.iter().rev().enumerate() {
        assert!(near(n, &found.normals[v], 1e-5));
        let tangent = again.tangents[vertices - 1 - v];
        assert_eq!(tangent[3], -1.0);
        assert!((0..3).map(|k| tangent[k] * n[k]).sum::<f32>().abs() < 1e-5);
        assert!(tangent[1] > 0.9);
    }
    // Without normals: those of the triangles.
    let plain = read(&caller, None, None, None, vertices);
    caller.accepted(plain.status);
    let inward = plain.normals.iter().zip(&normals).filter(|(a, b)| (0..3).map(|k| a[k] * b[k]).sum::<f32>() < 0.8);
    assert_eq!(inward.count(), 0);
}

/// Seen in a mirror, the bitangent has the other sign, and nothing else changes.
#[test]
fn mirrored_coordinates_change_the_handedness() {
    let run = |mirrored: bool| {
        let (caller, mut sample) = Caller::with_sample();
        if mirrored {
            // What the garment's file calls right is left.
            let mirror = |p: &mut [f32; 3]| p[0] = -p[0];
            sample.garment.0.iter_mut().for_each(mirror);
            sample.source_joints.iter_mut().for_each(mirror);
            caller.set_sample(&sample);
            // SAFETY: all fields are numbers, for which zero is a value.
            let mut system: BespokeCoordinateSystem = unsafe { std::mem::zeroed() };
            system.struct_size = size_of::<BespokeCoordinateSystem>() as u32;
            system.right = BespokeAxis::NegativeX as u32;
            system.up = BespokeAxis::PositiveY as u32;
            system.forward = BespokeAxis::NegativeZ as u32;
            system.metres_per_unit = 1.0;
            system.winding = BespokeWinding::CounterClockwise as u32;
            system.trusted = 1;
            // SAFETY: the session is alive and the struct as large as it says.
            caller.accepted(unsafe { bespoke_session_set_source_coordinate_system(caller.session, &system) });
        }
        let (normals, vertices) = (outward(&sample), sample.garment.0.len());
        let along = vec![[0.0f32, 1.0, 0.0, 1.0]; vertices];
        let along = view(&along, BespokeComponent::F32);
        // SAFETY: the session is alive.
        caller.accepted(unsafe { bespoke_session_prepare(caller.session) });
        let found = read(&caller, None, Some(&points(&normals)), Some(&along), vertices);
        caller.accepted(found.status);
        found
    };
    let (plain, mirrored) = (run(false), run(true));
    for v in 0..plain.count {
        assert!(near(&plain.normals[v], &mirrored.normals[v], 1e-5));
        assert!(near(&plain.tangents[v][..3], &mirrored.tangents[v][..3], 1e-5));
        assert_eq!([plain.tangents[v][3], mirrored.tangents[v][3]], [1.0, -1.0]);
    }
}

#[test]
fn what_does_not_fit_is_refused_and_nothing_written() {
    let (caller, sample) = Caller::with_sample();
    // SAFETY: the session is alive.
    caller.accepted(unsafe { bespoke_session_prepare(caller.session) });
    let vertices = sample.garment.0.len();
    let normals = outward(&sample);
    let refuse = |found: Read, words: &[&str]| {
        caller.refused(found.status, InvalidArgument, words);
        assert!(found.normals.iter().flatten().chain(found.tangents.iter().flatten()).all(|&x| x == 7.0));
    };
    let fewer = points(&normals[1..]);
    refuse(read(&caller, None, Some(&fewer), None, vertices), &["garment normals", "one for each vertex"]);
    refuse(read(&caller, None, Some(&points(&normals)), None, vertices - 1), &["garment normals", "capacity"]);
    let one = triangles(&sample.garment.1[1..]);
    refuse(read(&caller, Some(&one), Some(&points(&normals)), None, vertices), &["triangles", "the garment has"]);
    let wild = triangles(&[[0, 1, u32::MAX - 1]]);
    refuse(read(&caller, Some(&wild), None, None, vertices), &["name vertex 4294967294", "give the normals"]);
    let mut bad = normals.clone();
    bad[3][1] = f32::NAN;
    refuse(read(&caller, None, Some(&points(&bad)), None, vertices), &["vertex 3", "not finite"]);
    let good = points(&normals);
    let along = vec![[0.0f32; 4]; vertices];
    let along = view(&along, BespokeComponent::F32);
    refuse(read(&caller, None, Some(&good), Some(&along), 1), &["garment normals", "capacity"]);
    let mut room = vec![[0.0f32; 3]; vertices];
    let out = buffer(&mut room);
    // SAFETY: the session is alive, and null pointers are what is tested.
    unsafe {
        let read = bespoke_session_read_garment_normals;
        let status = read(caller.session, null(), &good, null(), &out, &out, null_mut());
        caller.refused(status, InvalidArgument, &["garment tangents", "none of the design"]);
        let status = read(caller.session, null(), &good, null(), null(), null(), null_mut());
        caller.refused(status, InvalidArgument, &["garment normals", "null"]);
        assert_eq!(read(null_mut(), null(), &good, null(), &out, null(), null_mut()), InvalidArgument);
    }
}
