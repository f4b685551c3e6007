//! The whole way, and what is read on it.

use std::ffi::CStr;
use std::ptr::null_mut;

use bespoke::capi::results::*;
use bespoke::capi::running::*;
use bespoke::capi::status::BespokeStatus::{InvalidArgument, Ok};
use bespoke::capi::view::{BespokeBuffer, BespokeComponent};

use testing::caller::Caller;

fn read(caller: &Caller, count: usize) -> Vec<[f32; 3]> {
    let mut room = vec![[0.0f32; 3]; count];
    let component = BespokeComponent::F32 as u32;
    let buffer = BespokeBuffer { data: room.as_mut_ptr().cast(), capacity: count, stride: 0, component };
    // SAFETY: the session is alive and the buffer as large as said.
    caller.accepted(unsafe { bespoke_session_read_garment_vertices(caller.session, &buffer, null_mut()) });
    room
}

fn report(caller: &Caller) -> BespokeReport {
    // SAFETY: all fields are numbers, for which zero is a value; the report is as large as it says.
    unsafe {
        let mut report: BespokeReport = std::mem::zeroed();
        report.struct_size = size_of::<BespokeReport>() as u32;
        caller.accepted(bespoke_session_read_report(caller.session, &mut report));
        report
    }
}

/// Steps end where run ends, to the bit.
#[test]
fn steps_and_run_give_the_same_verified_result() {
    let (stepped, sample) = Caller::with_sample();
    let count = sample.garment.0.len();
    // SAFETY: the session is alive.
    stepped.accepted(unsafe { bespoke_session_prepare(stepped.session) });
    let mut stage = BespokeStage::Prepared as u32;
    let mut steps = 0;
    while stage != BespokeStage::Done as u32 {
        // SAFETY: the session is alive and the pointer good.
        stepped.accepted(unsafe { bespoke_session_step(stepped.session, 1, 0, &mut stage) });
        assert!(read(&stepped, count).iter().flatten().all(|c| c.is_finite()), "a preview is there at any time");
        steps += 1;
        assert!(steps < 10_000, "the session does not come to an end");
    }
    let (ran, _) = Caller::with_sample();
    // SAFETY: the session is alive.
    ran.accepted(unsafe { bespoke_session_run(ran.session) });
    assert_eq!(read(&stepped, count), read(&ran, count));

    let mut counts = BespokeIntersections { garment_garment: 9, initial: 9, garment_avatar: 9 };
    let component = BespokeComponent::F32 as u32;
    // SAFETY: the session is alive and the pointer good.
    ran.accepted(unsafe { bespoke_session_verify(ran.session, component, &mut counts) });
    assert_eq!(counts, BespokeIntersections::default());
    let report = report(&ran);
    assert_eq!((report.is_verified, report.garment_intersections, report.avatar_intersections), (1, 0, 0));
}

#[test]
fn reports_have_sizes_and_named_energies() {
    let (caller, sample) = Caller::with_sample();
    // SAFETY: the session is alive.
    caller.accepted(unsafe { bespoke_session_run(caller.session) });
    let report = report(&caller);
    assert_eq!(report.garment_vertices, sample.garment.0.len() as u64);
    assert_eq!(report.garment_triangles, sample.garment.1.len() as u64);
    assert_eq!(report.avatar_vertices, sample.avatar.0.len() as u64);
    assert_eq!(report.avatar_triangles, sample.avatar.1.len() as u64);
    assert!(report.energy_count > 0);
    // SAFETY: all fields are numbers, for which zero is a value.
    let mut energy: BespokeEnergy = unsafe { std::mem::zeroed() };
    let mut names = Vec::new();
    // SAFETY: the session is alive and the pointer good.
    let refused = unsafe { bespoke_session_read_energy(caller.session, 0, &mut energy) };
    caller.refused(refused, InvalidArgument, &["energy", "struct_size"]);
    energy.struct_size = size_of::<BespokeEnergy>() as u32;
    for index in 0..report.energy_count {
        // SAFETY: the session is alive and the pointer good.
        caller.accepted(unsafe { bespoke_session_read_energy(caller.session, index, &mut energy) });
        // SAFETY: the name ends with a zero byte.
        let name = unsafe { CStr::from_ptr(energy.name.as_ptr()) }.to_str().expect("UTF-8").to_owned();
        assert!(!name.is_empty() && !names.contains(&name), "terms have names of their own");
        assert!(energy.value.is_finite() && energy.weight >= 0.0);
        names.push(name);
    }
    // SAFETY: the session is alive and the pointer good.
    let status = unsafe { bespoke_session_read_energy(caller.session, report.energy_count, &mut energy) };
    caller.refused(status, InvalidArgument, &["energy"]);
}

#[test]
fn the_count_alone_can_be_asked_for() {
    let (caller, sample) = Caller::with_sample();
    let nowhere = BespokeBuffer { data: null_mut(), capacity: 0, stride: 0, component: 2 };
    let mut count = 0;
    // SAFETY: the session is alive and the pointers good.
    unsafe {
        caller.accepted(bespoke_session_prepare(caller.session));
        assert_eq!(bespoke_session_read_garment_vertices(caller.session, &nowhere, &mut count), Ok);
        assert_eq!(count, sample.garment.0.len());
        assert_eq!(bespoke_session_read_avatar_vertices(caller.session, &nowhere, &mut count), Ok);
        assert_eq!(count, sample.avatar.0.len());
    }
}

/// The avatar is as it was set once the garment is done.
#[test]
fn the_dressed_avatar_is_the_one_that_was_set() {
    let (caller, sample) = Caller::with_sample();
    let mut room = vec![[0.0f32; 3]; sample.avatar.0.len()];
    let buffer = BespokeBuffer { data: room.as_mut_ptr().cast(), capacity: room.len(), stride: 0, component: 1 };
    // SAFETY: the session is alive and the buffer as large as said.
    unsafe {
        caller.accepted(bespoke_session_run(caller.session));
        caller.accepted(bespoke_session_read_avatar_vertices(caller.session, &buffer, null_mut()));
    }
    assert_eq!(room, sample.avatar.0);
}
