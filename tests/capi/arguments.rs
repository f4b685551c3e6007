//! Null pointers, bad views, bad options: refused with a message, and nothing has changed.

use std::ffi::CStr;
use std::ptr::{null, null_mut};

use bespoke::capi::control::*;
use bespoke::capi::coordinate_system::*;
use bespoke::capi::fit::*;
use bespoke::capi::inputs::*;
use bespoke::capi::options::*;
use bespoke::capi::results::*;
use bespoke::capi::running::*;
use bespoke::capi::session::*;
use bespoke::capi::status::*;
use bespoke::capi::version::*;
use bespoke::capi::view::{BespokeBuffer, BespokeComponent, BespokeView};

use testing::caller::{Caller, bones, no_options, points, triangles};

use BespokeStatus::{InvalidArgument, InvalidWeights, MemoryLimit, Ok};

#[test]
fn null_sessions_are_refused() {
    let sample = testing::caller::Sample::new();
    let (p, t) = (points(&sample.garment.0), triangles(&sample.garment.1));
    let (j, b) = (points(&sample.source_joints), bones(&sample.bones));
    let session = null_mut();
    let mut control = null_mut();
    // SAFETY: null pointers are what is tested, all others are good.
    unsafe {
        for status in [
            bespoke_session_create(null_mut()),
            bespoke_session_reset(session),
            bespoke_session_last_message(session, null_mut(), 0, null_mut()),
            bespoke_session_set_garment(session, &p, &t),
            bespoke_session_set_target_avatar(session, &p, &t),
            bespoke_session_set_source_avatar(session, &p, &t),
            bespoke_session_set_source_skeleton(session, &j, &b),
            bespoke_session_set_target_skeleton(session, &j, &b),
            bespoke_session_set_target_skin_weights(session, &p, 3),
            bespoke_session_set_target_skin_influences(session, &t, &p, 3, 3),
            bespoke_session_set_vertex_fit_weights(session, &p),
            bespoke_session_set_no_fit_vertices(session, &t),
            bespoke_session_set_pinned_vertices(session, &t, null()),
            bespoke_session_add_rigid_group(session, &t),
            bespoke_session_clear_rigid_groups(session),
            bespoke_session_add_curve(session, &t, 0, 1.0, 1.0),
            bespoke_session_clear_curves(session),
            bespoke_session_set_source_coordinate_system(session, null()),
            bespoke_session_set_target_coordinate_system(session, null()),
            bespoke_session_set_options(session, &no_options()),
            bespoke_options_read_defaults(null_mut()),
            bespoke_session_prepare(session),
            bespoke_session_step(session, 0, 0, null_mut()),
            bespoke_session_run(session),
            bespoke_session_verify(session, BespokeComponent::F32 as u32, null_mut()),
            bespoke_session_cancel(session),
            bespoke_session_read_progress(session, null_mut()),
            bespoke_session_read_report(session, null_mut()),
            bespoke_session_read_energy(session, 0, null_mut()),
            bespoke_session_read_garment_vertices(session, null(), null_mut()),
            bespoke_session_read_avatar_vertices(session, null(), null_mut()),
            bespoke_session_read_distortion(session, null(), null_mut()),
            bespoke_session_create_control(session, &mut control),
            bespoke_session_create_control(session, null_mut()),
            bespoke_control_cancel(null()),
            bespoke_control_read_progress(null(), null_mut()),
        ] {
            assert_eq!(status, InvalidArgument);
        }
        assert!(control.is_null());
        assert_eq!(bespoke_session_destroy(session), Ok);
        bespoke_control_destroy(null_mut());
    }
}

#[test]
fn null_views_and_null_data_are_named() {
    let (caller, sample) = Caller::with_sample();
    let (p, t) = (points(&sample.garment.0), triangles(&sample.garment.1));
    // SAFETY: null pointers are what is tested, all others are good.
    unsafe {
        let refused = |status, word| caller.refused(status, InvalidArgument, &[word, "null"]);
        refused(bespoke_session_set_garment(caller.session, null(), &t), "garment positions");
        refused(bespoke_session_set_garment(caller.session, &p, null()), "garment triangles");
        refused(bespoke_session_set_target_avatar(caller.session, null(), &t), "target avatar positions");
        refused(bespoke_session_set_source_avatar(caller.session, &p, null()), "source avatar triangles");
        refused(bespoke_session_set_source_skeleton(caller.session, null(), &t), "source skeleton joints");
        refused(bespoke_session_set_target_skeleton(caller.session, &p, null()), "target skeleton bones");
        refused(bespoke_session_set_target_skin_weights(caller.session, null(), 1), "skin weights");
        refused(bespoke_session_set_target_skin_influences(caller.session, null(), &p, 1, 1), "skin weights");
        refused(bespoke_session_set_vertex_fit_weights(caller.session, null()), "fit weights");
        refused(bespoke_session_set_no_fit_vertices(caller.session, null()), "no-fit vertices");
        refused(bespoke_session_add_curve(caller.session, null(), 0, 1.0, 1.0), "curve");
        refused(bespoke_session_set_source_coordinate_system(caller.session, null()), "source coordinate system");
        refused(bespoke_session_set_target_coordinate_system(caller.session, null()), "target coordinate system");
        refused(bespoke_session_set_options(caller.session, null()), "options");
        refused(bespoke_session_read_report(caller.session, null_mut()), "report");
        refused(bespoke_session_read_energy(caller.session, 0, null_mut()), "energy");
        refused(bespoke_session_set_garment(caller.session, &BespokeView { data: null(), ..p }, &t), "positions");
        refused(bespoke_session_set_garment(caller.session, &p, &BespokeView { data: null(), ..t }), "triangles");
    }
}

#[test]
fn views_that_cannot_be_are_refused() {
    let (caller, sample) = Caller::with_sample();
    let (p, t) = (points(&sample.garment.0), triangles(&sample.garment.1));
    let refused = |p: &BespokeView, t: &BespokeView, words: &[&str]| {
        caller.refused(caller.set_garment(p, t), InvalidArgument, words);
    };
    refused(&BespokeView { component: 0, ..p }, &t, &["garment positions", "component is 0"]);
    refused(&BespokeView { component: BespokeComponent::U32 as u32, ..p }, &t, &["component is 4"]);
    refused(
        &p,
        &BespokeView { component: BespokeComponent::F32 as u32, ..t },
        &["garment triangles", "component is 1"],
    );
    refused(&BespokeView { stride: 11, ..p }, &t, &["stride is 11"]);
    refused(&BespokeView { count: usize::MAX, ..p }, &t, &["garment positions"]);
    refused(&BespokeView { stride: usize::MAX / 2, ..p }, &t, &["garment positions"]);
}

#[test]
fn message_fits_into_what_there_is() {
    let caller = Caller::new();
    assert_eq!(caller.message(), "");
    // SAFETY: the options are null, which is refused; buffers are as large as said.
    unsafe {
        bespoke_session_set_options(caller.session, null());
        let whole = caller.message();
        for capacity in 1..whole.len() + 3 {
            let mut buffer = vec![b'#'; capacity + 1];
            let mut needed = 0;
            let status =
                bespoke_session_last_message(caller.session, buffer.as_mut_ptr().cast(), capacity, &mut needed);
            assert_eq!((status, needed), (Ok, whole.len() + 1));
            assert_eq!(buffer[capacity], b'#', "nothing is written behind the buffer");
            let text = CStr::from_bytes_until_nul(&buffer).expect("a zero byte").to_str().expect("UTF-8");
            assert_eq!(text, &whole[..whole.len().min(capacity - 1)]);
        }
        assert_eq!(bespoke_session_last_message(caller.session, null_mut(), 1, null_mut()), InvalidArgument);
    }
}

#[test]
fn options_are_checked() {
    let caller = Caller::new();
    // SAFETY: the options are as large as they say.
    let set = |options: BespokeOptions| unsafe { bespoke_session_set_options(caller.session, &options) };
    caller.accepted(set(no_options()));
    caller.accepted(set(BespokeOptions { fit_weight: BESPOKE_WEIGHT_OFF, ..no_options() }));
    for (options, word) in [
        (BespokeOptions { struct_size: 0, ..no_options() }, "struct_size is 0"),
        (BespokeOptions { struct_size: 8, ..no_options() }, "struct_size is 8"),
        (BespokeOptions { fit_weight: f64::NAN, ..no_options() }, "fit_weight"),
        (BespokeOptions { fit_weight: -2.0, ..no_options() }, "fit_weight"),
        (BespokeOptions { position_weight: f64::INFINITY, ..no_options() }, "position_weight"),
        (BespokeOptions { surface_weight: BESPOKE_WEIGHT_OFF, ..no_options() }, "surface_weight"),
        (BespokeOptions { barrier_weight: -1.0, ..no_options() }, "barrier_weight"),
        (BespokeOptions { dhat: 1e9, ..no_options() }, "dhat"),
        (BespokeOptions { voxel_size: f64::NAN, ..no_options() }, "voxel_size"),
        (BespokeOptions { min_separation: 0.01, ..no_options() }, "min_separation"),
        (BespokeOptions { tolerance: -1.0, ..no_options() }, "tolerance"),
        (BespokeOptions { threads: 100_000, ..no_options() }, "threads"),
        (BespokeOptions { surface_form: 2, ..no_options() }, "surface_form is 2"),
    ] {
        caller.refused(set(options), InvalidArgument, &[word]);
    }
}

/// A program that was built with an earlier header: its struct ends where a later field begins.
#[test]
fn the_first_part_of_the_options_is_accepted_alone() {
    let (caller, _sample) = Caller::with_sample();
    let end = std::mem::offset_of!(BespokeOptions, surface_weight);
    // What lies behind it is none of the library's.
    let options = BespokeOptions { struct_size: end as u32, memory_limit: 1, dhat: 7.0, ..no_options() };
    // SAFETY: the session is alive, the options larger than they say.
    unsafe {
        caller.accepted(bespoke_session_set_options(caller.session, &options));
        caller.refused(bespoke_session_prepare(caller.session), MemoryLimit, &["MB", "memory_limit"]);
        let options = BespokeOptions { struct_size: end as u32, dhat: 7.0, ..no_options() };
        caller.accepted(bespoke_session_set_options(caller.session, &options));
        caller.accepted(bespoke_session_prepare(caller.session));
        caller.accepted(bespoke_session_reset(caller.session));
        let options = BespokeOptions { dhat: 7.0, ..no_options() };
        caller.refused(bespoke_session_set_options(caller.session, &options), InvalidArgument, &["dhat", "7"]);
        let mut defaults = BespokeOptions { struct_size: end as u32, dhat: 77.0, ..no_options() };
        assert_eq!(bespoke_options_read_defaults(&mut defaults), Ok);
        assert_eq!((defaults.dhat, defaults.fit_weight), (77.0, 2.0));
    }
}

#[test]
fn default_options_are_accepted_and_written_out() {
    let caller = Caller::new();
    let mut options = no_options();
    // SAFETY: the options are as large as they say.
    unsafe {
        assert_eq!(bespoke_options_read_defaults(&mut options), Ok);
        assert_eq!((options.fit_weight, options.dhat, options.max_iterations), (2.0, 0.002, 500));
        caller.accepted(bespoke_session_set_options(caller.session, &options));
    }
}

/// A struct of a later header: what it adds must be zero when it goes in, and becomes zero when it comes out.
#[test]
fn longer_structs_of_later_headers_work() {
    #[repr(C)]
    struct Later {
        options: BespokeOptions,
        added: f64,
    }
    let caller = Caller::new();
    let size = size_of::<Later>() as u32;
    let mut later = Later { options: BespokeOptions { struct_size: size, ..no_options() }, added: 0.0 };
    // SAFETY: the struct is as large as it says.
    unsafe {
        let pointer = (&raw mut later).cast::<BespokeOptions>();
        caller.accepted(bespoke_session_set_options(caller.session, pointer));
        (*pointer.cast::<Later>()).added = 1.0;
        caller.refused(bespoke_session_set_options(caller.session, pointer), InvalidArgument, &["does not know"]);
        assert_eq!(bespoke_options_read_defaults(pointer), Ok);
        assert_eq!(((*pointer).struct_size, (*pointer.cast::<Later>()).added), (size, 0.0));
    }
}

#[test]
fn coordinate_systems_are_checked() {
    let caller = Caller::new();
    let default = BespokeCoordinateSystem {
        struct_size: size_of::<BespokeCoordinateSystem>() as u32,
        right: 0,
        up: 0,
        forward: 0,
        metres_per_unit: 0.0,
        winding: 0,
        trusted: 0,
    };
    // SAFETY: the struct is as large as it says.
    let set = |system: BespokeCoordinateSystem| unsafe {
        bespoke_session_set_target_coordinate_system(caller.session, &system)
    };
    caller.accepted(set(default));
    let z_up = [BespokeAxis::PositiveX, BespokeAxis::PositiveZ, BespokeAxis::PositiveY].map(|axis| axis as u32);
    caller.accepted(set(BespokeCoordinateSystem { right: z_up[0], up: z_up[1], forward: z_up[2], ..default }));
    for (system, word) in [
        (BespokeCoordinateSystem { struct_size: 4, ..default }, "struct_size is 4"),
        (BespokeCoordinateSystem { up: BespokeAxis::NegativeX as u32, ..default }, "perpendicular"),
        (BespokeCoordinateSystem { right: 7, ..default }, "right is 7"),
        (BespokeCoordinateSystem { winding: 2, ..default }, "winding is 2"),
        (BespokeCoordinateSystem { trusted: 2, ..default }, "trusted is 2"),
        (BespokeCoordinateSystem { metres_per_unit: -1.0, ..default }, "-1"),
        (BespokeCoordinateSystem { metres_per_unit: f64::NAN, ..default }, "NaN"),
    ] {
        caller.refused(set(system), InvalidArgument, &["target coordinate system", word]);
    }
}

#[test]
fn skin_weights_are_checked() {
    let (caller, sample) = Caller::with_sample();
    let count = sample.avatar.0.len();
    let dense = |weights: &[f32], joints: usize, vertices: usize| {
        let rows = BespokeView { count: joints, ..testing::caller::view(weights, BespokeComponent::F32) };
        // SAFETY: the slice holds joints * vertices numbers.
        unsafe { bespoke_session_set_target_skin_weights(caller.session, &rows, vertices) }
    };
    let mut weights = vec![0.5; 3 * count];
    caller.accepted(dense(&weights, 3, count));
    for bad in [f32::NAN, f32::INFINITY, -0.25] {
        weights[count + 7] = bad;
        caller.refused(dense(&weights, 3, count), InvalidWeights, &["vertex 7", "joint 1"]);
    }
    weights[count + 7] = 0.5;

    // Of a wrong size: found when the avatar is there to compare with.
    for (joints, vertices) in [(2, count), (3, count - 1)] {
        caller.accepted(dense(&weights, joints, vertices));
        // SAFETY: the session is alive.
        caller.refused(unsafe { bespoke_session_prepare(caller.session) }, InvalidWeights, &["skin weights"]);
    }
}

#[test]
fn sparse_skin_weights_are_checked() {
    let (caller, sample) = Caller::with_sample();
    let count = sample.avatar.0.len();
    let set = |joints: &[[u16; 4]], weights: &[[f32; 4]]| {
        let joints = testing::caller::view(joints, BespokeComponent::U16);
        let weights = testing::caller::view(weights, BespokeComponent::F32);
        // SAFETY: the views are valid.
        unsafe { bespoke_session_set_target_skin_influences(caller.session, &joints, &weights, 4, 3) }
    };
    let mut joints = vec![[0, 1, 2, 999]; count];
    let weights = vec![[0.5, 0.25, 0.25, 0.0]; count];
    caller.accepted(set(&joints, &weights));
    caller.refused(set(&joints, &weights[1..]), InvalidArgument, &["skin weights"]);
    joints[5][1] = 3;
    caller.refused(set(&joints, &weights), InvalidWeights, &["vertex 5", "joint 3"]);
}

#[test]
fn fit_weights_are_checked() {
    let (caller, sample) = Caller::with_sample();
    let count = sample.garment.0.len();
    let set = |weights: &[f64]| {
        let view = testing::caller::view(weights, BespokeComponent::F64);
        // SAFETY: the view is valid.
        unsafe { bespoke_session_set_vertex_fit_weights(caller.session, &view) }
    };
    let mut weights = vec![1.0; count];
    caller.accepted(set(&weights));
    for bad in [f64::NAN, f64::INFINITY, -1.0] {
        weights[3] = bad;
        caller.refused(set(&weights), InvalidWeights, &["vertex 3"]);
    }
    caller.accepted(set(&[1.0, 1.0]));
    // SAFETY: the session is alive.
    caller.refused(unsafe { bespoke_session_prepare(caller.session) }, InvalidWeights, &["fit weights"]);
}

#[test]
fn no_fit_vertices_are_checked() {
    let set = |caller: &Caller, vertices: &[u32]| {
        let view = testing::caller::view(vertices, BespokeComponent::U32);
        // SAFETY: the view is valid.
        unsafe { bespoke_session_set_no_fit_vertices(caller.session, &view) }
    };
    let empty = Caller::new();
    empty.refused(set(&empty, &[0]), BespokeStatus::InvalidState, &["garment"]);
    let (caller, sample) = Caller::with_sample();
    let count = sample.garment.0.len() as u32;
    caller.accepted(set(&caller, &[]));
    caller.accepted(set(&caller, &[0, count - 1, 0]));
    caller.refused(set(&caller, &[0, count]), InvalidArgument, &["no-fit", &format!("vertex {count}")]);
}

#[test]
fn buffers_that_cannot_be_are_refused() {
    let (caller, sample) = Caller::with_sample();
    let mut room = vec![[7.0f32; 3]; sample.garment.0.len()];
    let buffer = BespokeBuffer { data: room.as_mut_ptr().cast(), capacity: room.len(), stride: 0, component: 1 };
    let read = |buffer: &BespokeBuffer, count: &mut usize| {
        // SAFETY: the buffer holds what it says, or is refused.
        unsafe { bespoke_session_read_garment_vertices(caller.session, buffer, count) }
    };
    // SAFETY: the session is alive.
    caller.accepted(unsafe { bespoke_session_prepare(caller.session) });
    let mut count = 0;
    for (bad, word) in [
        (BespokeBuffer { component: 3, ..buffer }, "component is 3"),
        (BespokeBuffer { capacity: room.len() - 1, ..buffer }, "capacity"),
        (BespokeBuffer { stride: 8, ..buffer }, "stride is 8"),
        (BespokeBuffer { data: null_mut(), ..buffer }, "null"),
    ] {
        caller.refused(read(&bad, &mut count), InvalidArgument, &["garment vertices", word]);
        assert_eq!(count, room.len());
    }
    assert!(room.iter().all(|p| *p == [7.0; 3]), "nothing is written by a call that is refused");
}

#[test]
fn names_and_versions() {
    // SAFETY: the library's own texts end with a zero byte.
    let text = |pointer| unsafe { CStr::from_ptr(pointer) }.to_str().expect("UTF-8");
    assert_eq!(text(bespoke_status_name(Ok as u32)), "BESPOKE_STATUS_OK");
    assert_eq!(text(bespoke_status_name(BespokeStatus::Internal as u32)), "BESPOKE_STATUS_INTERNAL");
    assert_eq!(text(bespoke_status_name(BespokeStatus::NoThread as u32)), "BESPOKE_STATUS_NO_THREAD");
    assert_eq!(text(bespoke_status_name(999)), "BESPOKE_STATUS_UNKNOWN");
    assert_eq!(text(bespoke_version_text()), env!("CARGO_PKG_VERSION"));
    assert_eq!(bespoke_abi_version(), BESPOKE_ABI_VERSION);
}
