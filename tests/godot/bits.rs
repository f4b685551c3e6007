//! What GDScript has written of a scene, dressed by the C API.

use std::ffi::CString;
use std::fs;
use std::path::Path;

use bespoke::capi::coordinate_system::*;
use bespoke::capi::inputs::*;
use bespoke::capi::results::*;
use bespoke::capi::rig_results::*;
use bespoke::capi::rigs::*;
use bespoke::capi::running::*;
use bespoke::capi::view::*;
use serde_json::Value;
use testing::caller::{Caller, points, triangles, view};

/// Numbers of 32 bits.
fn numbers<T>(folder: &Path, file: &str, from: fn([u8; 4]) -> T) -> Vec<T> {
    let bytes = fs::read(folder.join(file)).unwrap_or_else(|reason| panic!("{file}: {reason}"));
    bytes.as_chunks::<4>().0.iter().map(|&number| from(number)).collect()
}

fn threes<T: Copy>(numbers: &[T]) -> Vec<[T; 3]> {
    numbers.as_chunks::<3>().0.to_vec()
}

/// A mesh with its weights.
struct Skinned {
    positions: Vec<[f32; 3]>,
    triangles: Vec<[u32; 3]>,
    joints: Vec<u32>,
    weights: Vec<f32>,
    influences: usize,
}

impl Skinned {
    fn read(folder: &Path, name: &str) -> Self {
        let positions = threes(&numbers(folder, &format!("{name}.positions"), f32::from_le_bytes));
        let weights = numbers(folder, &format!("{name}.weights"), f32::from_le_bytes);
        Self {
            influences: weights.len() / positions.len(),
            triangles: threes(&numbers(folder, &format!("{name}.triangles"), u32::from_le_bytes)),
            joints: numbers(folder, &format!("{name}.bones"), u32::from_le_bytes),
            positions,
            weights,
        }
    }

    fn rows(&self) -> [BespokeView; 2] {
        let wide = |mut rows: BespokeView| {
            rows.count /= self.influences;
            rows.stride = 4 * self.influences;
            rows
        };
        [wide(view(&self.joints, BespokeComponent::U32)), wide(view(&self.weights, BespokeComponent::F32))]
    }
}

/// The joints of a side, and their names.
fn rig(folder: &Path, side: &str) -> (Vec<CString>, Vec<BespokeJoint>) {
    let text = fs::read(folder.join(format!("{side}.joints.json"))).expect("the joints were written");
    let listed: Vec<Value> = serde_json::from_slice(&text).expect("they are JSON");
    let (mut names, mut joints) = (Vec::new(), Vec::new());
    for (k, joint) in listed.iter().enumerate() {
        let name = CString::new(joint["name"].as_str().expect("a name")).expect("no zero byte");
        let rest = numbers(folder, &format!("{side}.{k}.rest"), f32::from_le_bytes);
        let mut bind = [0.0; 16];
        for (column, three) in threes(&rest).iter().enumerate() {
            for axis in 0..3 {
                bind[4 * column + axis] = f64::from(three[axis]);
            }
        }
        bind[15] = 1.0;
        let parent = joint["parent"].as_f64().expect("a number");
        let parent = if parent < 0.0 { u32::MAX } else { parent as u32 };
        joints.push(BespokeJoint { name: name.as_ptr(), parent, reserved: 0, bind });
        names.push(name);
    }
    (names, joints)
}

/// Dresses the same, and compares vertices and joints bit by bit.
pub fn compare(folder: &Path) {
    let [garment, body, avatar] = ["garment", "body", "avatar"].map(|name| Skinned::read(folder, name));
    let (_source_names, source) = rig(folder, "source");
    let (_target_names, target) = rig(folder, "target");
    let caller = Caller::new();
    let session = caller.session;
    // Godot draws clockwise triangles.
    let mut space = BespokeCoordinateSystem {
        struct_size: size_of::<BespokeCoordinateSystem>() as u32,
        right: 0,
        up: 0,
        forward: 0,
        metres_per_unit: 0.0,
        winding: 1,
        trusted: 1,
    };
    let (cloth, cloth_triangles) = (points(&garment.positions), triangles(&garment.triangles));
    let [joints, weights] = garment.rows();
    let [body_joints, body_weights] = body.rows();
    let [avatar_joints, avatar_weights] = avatar.rows();
    let mut dressed = vec![[0.0_f32; 3]; garment.positions.len()];
    let mut dressed_joints = vec![0_u32; 4 * dressed.len()];
    let mut dressed_weights = vec![0.0_f32; 4 * dressed.len()];
    let into = BespokeBuffer {
        data: dressed.as_mut_ptr().cast(),
        capacity: dressed.len(),
        stride: 0,
        component: BespokeComponent::F32 as u32,
    };
    // SAFETY: all views are of arrays that live to the end of this function.
    unsafe {
        caller.accepted(bespoke_session_set_source_coordinate_system(session, &space));
        space.trusted = 0;
        caller.accepted(bespoke_session_set_target_coordinate_system(session, &space));
        caller.accepted(bespoke_session_set_garment(session, &cloth, &cloth_triangles));
        let influences = garment.influences;
        let set = bespoke_session_set_garment_skin_influences(session, &joints, &weights, influences, source.len());
        caller.accepted(set);
        caller.accepted(bespoke_session_set_source_rig(session, source.as_ptr(), source.len()));
        caller.accepted(bespoke_session_set_source_avatar(
            session,
            &points(&body.positions),
            &triangles(&body.triangles),
        ));
        let influences = body.influences;
        let set =
            bespoke_session_set_source_skin_influences(session, &body_joints, &body_weights, influences, source.len());
        caller.accepted(set);
        caller.accepted(bespoke_session_set_target_rig(session, target.as_ptr(), target.len()));
        caller.accepted(caller.set_avatar(&points(&avatar.positions), &triangles(&avatar.triangles)));
        let influences = avatar.influences;
        let set = bespoke_session_set_target_skin_influences(
            session,
            &avatar_joints,
            &avatar_weights,
            influences,
            target.len(),
        );
        caller.accepted(set);
        caller.accepted(bespoke_session_run(session));
        caller.accepted(bespoke_session_read_garment_vertices(session, &into, std::ptr::null_mut()));
        caller.accepted(bespoke_session_read_garment_skin_influences(
            session,
            4,
            dressed_joints.as_mut_ptr(),
            dressed_weights.as_mut_ptr(),
            dressed.len(),
            std::ptr::null_mut(),
        ));
    }
    let found = threes(&numbers(folder, "dressed", f32::from_le_bytes));
    assert_eq!(found.len(), dressed.len());
    let bits = |p: &[f32; 3]| p.map(f32::to_bits);
    let same = found.iter().zip(&dressed).filter(|(found, wanted)| bits(found) == bits(wanted)).count();
    assert_eq!(same, dressed.len(), "of {} vertices so many have the same bits", dressed.len());
    assert_eq!(numbers(folder, "dressed.bones", u32::from_le_bytes), dressed_joints);
    println!("{same} of {} vertices have the same bits", dressed.len());
}
