//! A hat through which the head goes, as a C program hands it in: it is tried with the hat on the source avatar, and that is said.

use std::ffi::{CStr, CString};

use bespoke::capi::diagnostics::*;
use bespoke::capi::inputs::*;
use bespoke::capi::options::bespoke_session_set_options;
use bespoke::capi::rigs::*;
use bespoke::capi::running::*;
use bespoke::capi::session::bespoke_session_reset;
use bespoke::capi::status::BespokeStatus::NotEnclosed;
use bespoke::capi::view::BespokeComponent;
use closet::rigs::Character;
use glam::DMat4;
use testing::caller::{Caller, no_options, points, triangles, view};
use testing::pierced_hat::PiercedHat;

use crate::diagnostics::read;

/// Influences of a vertex in the closet.
const INFLUENCES: usize = 4;

fn set_rig(caller: &Caller, of: &Character, is_source: bool) {
    let names: Vec<CString> = of.joints.iter().map(|joint| CString::new(joint.name.as_str()).unwrap()).collect();
    let joints: Vec<BespokeJoint> = of
        .joints
        .iter()
        .zip(&names)
        .map(|(joint, name)| BespokeJoint {
            name: name.as_ptr(),
            parent: joint.parent.map_or(BESPOKE_NO_JOINT, |parent| parent as u32),
            reserved: 0,
            bind: DMat4::from(joint.bind).to_cols_array(),
        })
        .collect();
    let set = if is_source { bespoke_session_set_source_rig } else { bespoke_session_set_target_rig };
    // SAFETY: the session is alive, there are as many joints as said, and their names end.
    caller.accepted(unsafe { set(caller.session, joints.as_ptr(), joints.len()) });
}

fn set_figures(caller: &Caller, scene: &PiercedHat) {
    set_rig(caller, &scene.source, true);
    set_rig(caller, &scene.target, false);
    let meshes = [
        (
            &scene.hat,
            bespoke_session_set_garment as unsafe extern "C" fn(_, _, _) -> _,
            bespoke_session_set_garment_skin_influences as unsafe extern "C" fn(_, _, _, _, _) -> _,
        ),
        (&scene.source, bespoke_session_set_source_avatar, bespoke_session_set_source_skin_influences),
        (&scene.target, bespoke_session_set_target_avatar, bespoke_session_set_target_skin_influences),
    ];
    for (figure, set_mesh, set_skin) in meshes {
        let places: Vec<[f32; 3]> = figure.mesh.positions.iter().map(|p| p.as_vec3().to_array()).collect();
        let corners = &figure.mesh.triangles;
        let influence = |row: &Vec<(usize, f64)>, k: usize| row.get(k).copied().unwrap_or((0, 0.0));
        let rows = &figure.influences;
        let joints: Vec<[u32; INFLUENCES]> =
            rows.iter().map(|row| std::array::from_fn(|k| influence(row, k).0 as u32)).collect();
        let weights: Vec<[f64; INFLUENCES]> =
            rows.iter().map(|row| std::array::from_fn(|k| influence(row, k).1)).collect();
        let (joints, weights) = (view(&joints, BespokeComponent::U32), view(&weights, BespokeComponent::F64));
        // SAFETY: the session is alive and the views tell the truth.
        unsafe {
            caller.accepted(set_mesh(caller.session, &points(&places), &triangles(corners)));
            caller.accepted(set_skin(caller.session, &joints, &weights, INFLUENCES, figure.joints.len()));
        }
    }
}

#[test]
fn a_hat_that_the_head_goes_through_is_dressed_with_a_warning() {
    let (caller, scene) = (Caller::new(), PiercedHat::new());
    set_figures(&caller, &scene);
    let is_told = |found: &BespokeDiagnostic| found.kind == BespokeDiagnosticKind::SourceDressed as u32;
    for strict in [true, false] {
        let mut options = no_options();
        (options.strict, options.voxel_size) = (u32::from(strict), 0.04);
        // SAFETY: the session is alive.
        let status = unsafe {
            caller.accepted(bespoke_session_reset(caller.session));
            caller.accepted(bespoke_session_set_options(caller.session, &options));
            bespoke_session_run(caller.session)
        };
        let (found, _) = read(&caller, 64);
        let told: Vec<&BespokeDiagnostic> = found.iter().filter(|found| is_told(found)).collect();
        if strict {
            caller.refused(status, NotEnclosed, &["garment"]);
            assert!(told.is_empty());
            continue;
        }
        caller.accepted(status);
        let [told] = told[..] else { panic!("{} of them", told.len()) };
        assert_eq!((told.severity, told.element_count), (BespokeSeverity::Warning as u32, 2));
        let subjects = [BespokeSubject::Garment, BespokeSubject::SourceAvatar].map(|subject| subject as u32);
        assert_eq!([0, 1].map(|k| told.elements[k].subject), subjects);
        // SAFETY: a zero byte ends the message.
        let message = unsafe { CStr::from_ptr(told.message.as_ptr()) }.to_str().unwrap();
        assert!(message.starts_with("source avatar: it passes through the garment"), "{message}");
    }
}
