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

/// How far along the way from `from` to `to` the triangle `t` is met, and whether from behind.
fn met(from: DVec3, to: DVec3, t: [DVec3; 3]) -> Option<(f64, bool)> {
    let (way, normal) = (to - from, (t[1] - t[0]).cross(t[2] - t[0]));
    let along = normal.dot(t[0] - from) / normal.dot(way);
    let at = from + along * way;
    let is_inside = (0..3).all(|k| (t[(k + 1) % 3] - t[k]).cross(at - t[k]).dot(normal) >= 0.0);
    (is_inside && along > 0.0 && along < 1.0).then(|| (along, normal.dot(way) > 0.0))
}

/// The bone of each vertex of [`body`], facing outwards, by the rule alone: every bone, every triangle, and distances along the
/// edges that are improved until none changes.
fn owners_one_by_one(mesh: &TriangleMesh, skeleton: &Skeleton) -> Vec<u32> {
    let corners: Vec<[DVec3; 3]> = mesh.triangles.iter().map(|t| t.map(|v| mesh.positions[v as usize])).collect();
    let mut normals = vec![DVec3::ZERO; mesh.positions.len()];
    for (t, [a, b, c]) in mesh.triangles.iter().zip(&corners) {
        t.iter().for_each(|&v| normals[v as usize] += (*b - *a).cross(*c - *a));
    }
    let is_leaf = |joint: u32| skeleton.bones.iter().flatten().filter(|&&j| j == joint).count() == 1;
    let on_bone = |p: DVec3, [j, k]: [u32; 2]| {
        let [a, b] = [j, k].map(|j| skeleton.joints[j as usize]);
        let along = (p - a).dot(b - a) / (b - a).length_squared();
        let along = if is_leaf(j) { along } else { along.max(0.0) };
        a.lerp(b, if is_leaf(k) { along } else { along.min(1.0) })
    };
    let nearest = |p: DVec3| {
        let mut bones: Vec<(f64, u32, DVec3)> = (0..)
            .zip(&skeleton.bones)
            .map(|(bone, &ends)| (p.distance(on_bone(p, ends)), bone, on_bone(p, ends)))
            .collect();
        bones.sort_by(|a, b| a.0.total_cmp(&b.0));
        bones
    };
    let is_open = |v: usize, to: DVec3| {
        let (p, normal) = (mesh.positions[v], normals[v].normalize());
        let from = p - f64::min(1e-3, 0.02 * p.distance(to)) * normal;
        let mut hits: Vec<(f64, bool)> = corners.iter().filter_map(|&t| met(from, to, t)).collect();
        hits.sort_by(|a, b| a.0.total_cmp(&b.0));
        hits.push((1.0, true));
        let (mut depth, mut at, mut outside) = (1, 0.0, 0.0);
        for (along, leaves) in hits {
            outside += if depth <= 0 { along - at } else { 0.0 };
            (depth, at) = (depth + if leaves { -1 } else { 1 }, along);
        }
        p.distance(to) <= 0.02 || outside * from.distance(to) <= 0.02
    };
    // The distance along the surface to a vertex with a way, and whose bone that has.
    let mut reached: Vec<Option<(f64, u32)>> = (0..mesh.positions.len())
        .map(|v| {
            let bones = nearest(mesh.positions[v]);
            let near = bones.iter().filter(|(distance, ..)| *distance <= 2.5 * bones[0].0);
            near.into_iter().find(|&&(.., to)| is_open(v, to)).map(|&(_, bone, _)| (0.0, bone))
        })
        .collect();
    loop {
        let before = reached.clone();
        for &[a, b, c] in &mesh.triangles {
            for (from, to) in [(a, b), (b, a), (b, c), (c, b), (c, a), (a, c)].map(|(f, t)| (f as usize, t as usize)) {
                let Some((so_far, bone)) = reached[from] else { continue };
                let length = so_far + mesh.positions[from].distance(mesh.positions[to]);
                if reached[to].is_none_or(|(best, _)| length < best) {
                    reached[to] = Some((length, bone));
                }
            }
        }
        if reached == before {
            return reached.into_iter().map(|reached| reached.expect("a vertex with a way").1).collect();
        }
    }
}

#[test]
fn the_owners_are_those_of_the_rule_alone() {
    let (mut mesh, skeleton, _) = body();
    let volume = |t: &[u32; 3]| {
        let [a, b, c] = t.map(|v| mesh.positions[v as usize]);
        a.dot(b.cross(c))
    };
    if mesh.triangles.iter().map(volume).sum::<f64>() < 0.0 {
        mesh.triangles.iter_mut().for_each(|t| t.swap(1, 2));
    }
    let owners = Owners::find(&mesh, &skeleton, None);
    let mut the_very_bone = 0;
    for (v, (owner, bone)) in owners.of.iter().zip(owners_one_by_one(&mesh, &skeleton)).enumerate() {
        // A bone that meets the right one at a joint will do where it is the nearest.
        let p = mesh.positions[v];
        let meets = |&other: &u32| {
            skeleton.bones[other as usize].iter().any(|joint| skeleton.bones[bone as usize].contains(joint))
        };
        let own = (0..skeleton.bones.len() as u32).filter(meets).find(|&b| is_of(*owner, b, &skeleton));
        assert!(own.is_some(), "vertex {v}, {p}: {owner:?}, by the rule {bone}");
        the_very_bone += usize::from(is_of(*owner, bone, &skeleton));
    }
    assert!(the_very_bone > owners.of.len() * 9 / 10, "{the_very_bone} of {}", owners.of.len());
}
