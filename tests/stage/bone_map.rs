//! The map from beside one skeleton to beside another, against its formula, evaluated bone by bone.

use bespoke::geometry::mesh::TriangleMesh;
use bespoke::input::skeleton::Skeleton;
use bespoke::stage::setup::bone_map::BoneMap;
use glam::{DQuat, DVec3};
use testing::Random;

fn skeleton(joints: [DVec3; 4]) -> Skeleton {
    Skeleton { joints: joints.to_vec(), bones: vec![[0, 1], [1, 2], [1, 3]] }
}

/// Points around each bone: as far from it as `radius` says, at the middle half of its length; each three in a row are a triangle.
fn body(skeleton: &Skeleton, radius: [f64; 3]) -> TriangleMesh {
    let mut body = TriangleMesh::default();
    for (&[a, b], radius) in skeleton.bones.iter().zip(radius) {
        let [a, b] = [a, b].map(|j| skeleton.joints[j as usize]);
        let (u, v) = (b - a).normalize().any_orthonormal_pair();
        for k in 0..40 {
            let angle = 0.7 * f64::from(k);
            let along = 0.3 + 0.4 * f64::from(k) / 40.0;
            body.positions.push(a.lerp(b, along) + radius * (angle.cos() * u + angle.sin() * v));
            let last = body.positions.len() as u32 - 1;
            body.triangles.extend((k > 1).then_some([last - 2, last - 1, last]));
        }
    }
    body
}

/// The blend of the maps of all bones, as the formula has it. `thickness` is g of each bone.
fn expected(source: &Skeleton, target: &Skeleton, thickness: [f64; 3], p: DVec3) -> DVec3 {
    let (mut sum, mut total) = (DVec3::ZERO, 0.0);
    for (&[j, k], g) in source.bones.iter().zip(thickness) {
        let [[a, b], [c, d]] = [source, target].map(|s| [j, k].map(|joint| s.joints[joint as usize]));
        let w = ((p - a).dot(b - a) / (b - a).length_squared()).clamp(0.0, 1.0);
        let foot = a + w * (b - a);
        let turn = DQuat::from_rotation_arc((b - a).normalize(), (d - c).normalize());
        let image = c + w * (d - c) + g * (turn * (p - foot));
        let weight = (p.distance_squared(foot) + 0.02_f64.powi(2)).powi(-6);
        sum += weight * image;
        total += weight;
    }
    sum / total
}

fn pair() -> [Skeleton; 2] {
    let source = skeleton([DVec3::ZERO, DVec3::Y, DVec3::new(0.8, 1.6, 0.1), DVec3::new(-0.7, 1.5, 0.2)]);
    let target = skeleton([DVec3::X, DVec3::new(1.2, 1.4, 0.0), DVec3::new(2.0, 1.3, 0.3), DVec3::new(0.6, 2.0, 0.0)]);
    [source, target]
}

#[test]
fn agrees_with_the_formula() {
    let [source, target] = pair();
    let bodies = [body(&source, [0.1, 0.05, 0.08]), body(&target, [0.2, 0.05, 0.06])];
    let thick = BoneMap::new(&source, &target, Some([&bodies[0], &bodies[1]]));
    let plain = BoneMap::new(&source, &target, None);
    let mut random = Random::new(17);
    for _ in 0..500 {
        let p = DVec3::new(0.0, 0.9, 0.0) + random.vector();
        for (map, thickness) in [(&thick, [2.0, 1.0, 0.75]), (&plain, [1.0; 3])] {
            let (found, expected) = (map.apply(p), expected(&source, &target, thickness, p));
            assert!(found.distance(expected) < 1e-9, "{p}: {found} instead of {expected}");
        }
    }
}

/// As a face has them: many vertices on little of the surface.
#[test]
fn a_body_is_as_thick_as_most_of_its_surface_is_far() {
    let [source, target] = pair();
    let radii = [0.2, 0.05, 0.06];
    let (on_source, on_target) = (body(&source, [0.1, 0.05, 0.08]), body(&target, radii));
    let mut with_face = on_target.clone();
    let [a, b] = target.bones[0].map(|j| target.joints[j as usize]);
    let (u, v) = (b - a).normalize().any_orthonormal_pair();
    for k in 0..20 {
        for l in 0..20 {
            let at = a.lerp(b, 0.5) + 0.4 * u + 1e-3 * (f64::from(k) * v + f64::from(l) * (b - a));
            with_face.positions.push(at);
            let last = with_face.positions.len() as u32 - 1;
            with_face.triangles.extend((k > 0 && l > 0).then_some([last, last - 1, last - 20]));
        }
    }
    let [map, other] = [&on_target, &with_face].map(|body| BoneMap::new(&source, &target, Some([&on_source, body])));
    let mut random = Random::new(19);
    for _ in 0..100 {
        let p = DVec3::new(0.0, 0.9, 0.0) + random.vector();
        assert_eq!(map.apply(p), other.apply(p), "{p}");
    }
}

#[test]
fn a_skeleton_onto_itself_moves_nothing() {
    let [source, _] = pair();
    let map = BoneMap::new(&source, &source, None);
    let mut random = Random::new(18);
    for _ in 0..100 {
        let p = 2.0 * random.vector();
        assert!(map.apply(p).distance(p) < 1e-12);
    }
}

/// A stiff piece beside the middle of one bone follows that one alone.
#[test]
fn around_takes_the_bones_that_most_of_a_piece_is_near_to() {
    let [source, target] = pair();
    let map = BoneMap::new(&source, &target, None);
    let points: Vec<DVec3> = (0..5).map(|k| DVec3::new(0.05, 0.3 + 0.05 * f64::from(k), 0.1)).collect();
    let alone = map.around(&points, &[1.0; 5], 0.3);
    let one = Skeleton { joints: source.joints.clone(), bones: vec![source.bones[0]] };
    let other = Skeleton { joints: target.joints.clone(), bones: vec![target.bones[0]] };
    let expected = BoneMap::new(&one, &other, None);
    for p in points {
        assert_eq!(alone.apply(p), expected.apply(p));
    }
}
