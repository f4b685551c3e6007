//! Which bone each vertex belongs to where no skin weights say it.

use std::f64::consts::TAU;

use bespoke::geometry::mesh::TriangleMesh;
use bespoke::input::skeleton::Skeleton;
use bespoke::input::skin::SkinWeights;
use bespoke::stage::start::owners::{Owner, Owners};
use bespoke::stage::start::projection::project;
use glam::DVec3;

/// The sides of a limb.
const SIDES: u32 = 12;

/// A limb along `path`, closed at both ends.
fn limb(path: &[DVec3], radius: f64) -> TriangleMesh {
    let mut mesh = TriangleMesh::default();
    for k in 0..path.len() {
        let along = (path[(k + 1).min(path.len() - 1)] - path[k.max(1) - 1]).normalize();
        let across = along.cross(DVec3::Y).normalize();
        mesh.positions.extend((0..SIDES).map(|side| {
            let angle = TAU * f64::from(side) / f64::from(SIDES);
            path[k] + radius * (angle.cos() * across + angle.sin() * DVec3::Y)
        }));
    }
    let ring = |k: u32, side: u32| k * SIDES + side % SIDES;
    for k in 0..path.len() as u32 - 1 {
        for s in 0..SIDES {
            let [a, b, c, d] = [ring(k, s), ring(k, s + 1), ring(k + 1, s), ring(k + 1, s + 1)];
            mesh.triangles.extend([[a, b, c], [b, d, c]]);
        }
    }
    for (end, first) in [(path[0], 0), (path[path.len() - 1], path.len() as u32 - 1)] {
        let tip = mesh.positions.len() as u32;
        mesh.positions.push(end);
        let turned = |[a, b]: [u32; 2]| if first == 0 { [tip, b, a] } else { [tip, a, b] };
        mesh.triangles.extend((0..SIDES).map(|s| turned([ring(first, s), ring(first, s + 1)])));
    }
    mesh
}

/// Points along straight lines, so far apart at most.
fn dense(path: &[DVec3]) -> Vec<DVec3> {
    let between = |ends: &[DVec3]| {
        let count = (ends[0].distance(ends[1]) / 0.03).ceil() as usize;
        (0..count).map(|k| ends[0].lerp(ends[1], k as f64 / count as f64)).collect::<Vec<_>>()
    };
    path.windows(2).flat_map(between).chain(path.last().copied()).collect()
}

/// A leg, and an arm with a long hand that hangs beside the thigh and curls towards it; how many vertices the leg has.
fn body() -> (TriangleMesh, Skeleton, usize) {
    let joints = [(0.0, 0.0), (0.1, 0.0), (0.1, -0.9), (0.0, 0.6), (0.26, 0.5), (0.26, -0.1)];
    let skeleton = Skeleton {
        joints: joints.map(|(x, z)| DVec3::new(x, 0.0, z)).to_vec(),
        bones: vec![[0, 1], [1, 2], [0, 3], [3, 4], [4, 5]],
    };
    let path = |points: &[(f64, f64)]| dense(&points.iter().map(|&(x, z)| DVec3::new(x, 0.0, z)).collect::<Vec<_>>());
    let mut mesh = limb(&path(&[(0.1, -0.05), (0.1, -0.95)]), 0.05);
    let of_leg = mesh.positions.len();
    let arm = limb(&path(&[(0.26, 0.45), (0.26, -0.3), (0.205, -0.36), (0.205, -0.42)]), 0.03);
    mesh.positions.extend(arm.positions);
    mesh.triangles.extend(arm.triangles.iter().map(|t| t.map(|v| v + of_leg as u32)));
    (mesh, skeleton, of_leg)
}

const HIP: u32 = 0;
const LEG: u32 = 1;
const ARM: u32 = 4;

fn is_of(owner: Option<Owner>, bone: u32, skeleton: &Skeleton) -> bool {
    owner.is_some_and(|owner| owner.has(bone, skeleton.bones[bone as usize]))
}

#[test]
fn a_hand_beside_a_thigh_belongs_to_its_arm_and_the_thigh_to_the_leg() {
    let (mesh, skeleton, of_leg) = body();
    let to_bone = |v: usize, bone: u32| {
        let [a, b] = skeleton.bones[bone as usize].map(|j| skeleton.joints[j as usize]);
        let along = ((mesh.positions[v] - a).dot(b - a) / (b - a).length_squared()).clamp(0.0, 1.0);
        mesh.positions[v].distance(a.lerp(b, along))
    };
    let nearer = (of_leg..mesh.positions.len()).filter(|&v| to_bone(v, LEG) < to_bone(v, ARM)).count();
    assert!(nearer > 20, "of the hand {nearer} vertices are nearer to the bone of the leg");

    // It does not matter which way the surface faces.
    let turned =
        TriangleMesh { triangles: mesh.triangles.iter().map(|&[a, b, c]| [a, c, b]).collect(), ..mesh.clone() };
    for mesh in [&mesh, &turned] {
        let owners = Owners::find(mesh, &skeleton, None);
        for (v, &owner) in owners.of.iter().enumerate() {
            // The top of the leg is nearer to the bone of the hip.
            let bones = if v < of_leg { [LEG, HIP] } else { [ARM; 2] };
            let is_own = bones.iter().any(|&bone| is_of(owner, bone, &skeleton));
            assert!(is_own, "vertex {v}, {:?}: {owner:?}", mesh.positions[v]);
        }
        assert_eq!(owners.contested, [[0; 2]; 0]);
        assert_eq!(owners.unclear(mesh.positions.len(), &skeleton), None);
    }

    // So the hand starts beyond the wrist, and not at the thigh.
    let projected = project(&mesh, &skeleton, &skeleton, None);
    assert!(projected.shrunk[of_leg..].iter().all(|p| (p.x - 0.26).abs() < 1e-9));
    assert!(projected.shrunk[..of_leg].iter().all(|p| p.x < 0.1 + 1e-9));
}

#[test]
fn a_hand_that_is_one_mesh_with_the_thigh_is_told() {
    let (mut mesh, skeleton, of_leg) = body();
    let (hand, thigh) = (of_leg as u32 + 21 * SIDES, of_leg as u32 / 2);
    mesh.triangles.push([hand, thigh, thigh + 1]);
    let owners = Owners::find(&mesh, &skeleton, None);
    assert_eq!(owners.contested, [[thigh, hand], [thigh + 1, hand]]);
    let said = owners.unclear(mesh.positions.len(), &skeleton).expect("a finding").to_string();
    assert!(said.contains(&format!("vertices {thigh} and {hand}")), "{said}");
    assert!(said.contains("2 edges") && said.contains("skin weights"), "{said}");
    assert_eq!(owners.unclear(of_leg, &skeleton), None, "what is worn over it is not the body");

    // Weights decide, and then there is nothing to tell.
    let count = mesh.positions.len();
    let mut weights = vec![0.0; 6 * count];
    (0..count).for_each(|v| weights[if v < of_leg { count } else { 5 * count } + v] = 1.0);
    let skin = SkinWeights::from_dense(&weights, 6, count, "skin").unwrap();
    let owners = Owners::find(&mesh, &skeleton, Some(&skin));
    assert!(owners.of.iter().enumerate().all(|(v, &o)| o == Some(Owner::Joint(if v < of_leg { 1 } else { 5 }))));
    assert_eq!(owners.contested, [[0; 2]; 0]);
}
