//! The projection of an avatar onto its skeleton.

use bespoke::geometry::mesh::TriangleMesh;
use bespoke::input::skeleton::{BoneGraph, Skeleton};
use bespoke::input::skin::SkinWeights;
use bespoke::stage::start::projection::{ProjectedAvatar, project};
use glam::DVec3;

use testing::Random;

/// A body with arms, legs and a spine: 7 joints.
fn skeleton(random: &mut Random) -> Skeleton {
    let joints = [(0, 0), (0, 4), (0, 8), (3, 8), (6, 7), (-3, 8), (2, -4)]
        .map(|(x, z)| DVec3::new(f64::from(x), 0.0, f64::from(z)) + 0.2 * random.vector());
    Skeleton { joints: joints.to_vec(), bones: vec![[0, 1], [1, 2], [2, 3], [4, 3], [2, 5], [0, 6]] }
}

fn soup(random: &mut Random, count: u32) -> TriangleMesh {
    let positions = (0..3 * count).map(|_| 9.0 * random.vector()).collect();
    TriangleMesh { positions, triangles: (0..count).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect() }
}

fn distance_to_line(p: DVec3, [a, b]: [DVec3; 2]) -> f64 {
    (p - a).cross(b - a).length() / (b - a).length()
}

/// Every triangle of the shrunk avatar lies on the line of one bone.
fn collapses(projected: &ProjectedAvatar, source: &Skeleton) {
    for triangle in &projected.triangles {
        let corners = triangle.map(|v| projected.start[v as usize]);
        let on_one_bone = source.bones.iter().any(|bone| {
            let ends = bone.map(|j| source.joints[j as usize]);
            corners.iter().all(|&c| distance_to_line(c, ends) < 1e-9)
        });
        assert!(on_one_bone, "{corners:?}");
    }
}

fn area(p: [DVec3; 3]) -> f64 {
    0.5 * (p[1] - p[0]).cross(p[2] - p[0]).length()
}

#[test]
fn every_triangle_collapses_onto_one_bone_and_keeps_its_own_shape_at_the_end() {
    let mut random = Random::new(5);
    for _ in 0..20 {
        let source = skeleton(&mut random);
        let target = Skeleton { bones: source.bones.clone(), ..skeleton(&mut random) };
        let avatar = soup(&mut random, 120);
        let projected = project(&avatar, &target, &source, None);
        collapses(&projected, &source);
        let whole: f64 = avatar.triangles.iter().map(|t| area(t.map(|v| avatar.positions[v as usize]))).sum();
        let pieces: f64 = projected.triangles.iter().map(|t| area(t.map(|v| projected.end[v as usize]))).sum();
        assert!((whole - pieces).abs() < 1e-9 * whole, "the pieces tile the avatar: {whole} {pieces}");
        assert!(projected.triangles.len() > avatar.triangles.len());
    }
}

/// The nearest point of the skeleton, by dense sampling of every bone, beyond leaf joints too where nothing else decides.
#[test]
fn a_vertex_that_no_triangle_uses_goes_to_the_nearest_point_of_the_skeleton() {
    let mut random = Random::new(6);
    let body = skeleton(&mut random);
    let graph = BoneGraph::new(&body);
    let avatar = TriangleMesh { triangles: Vec::new(), ..soup(&mut random, 60) };
    let projected = project(&avatar, &body, &body, None);
    for (&p, &q) in avatar.positions.iter().zip(&projected.shrunk) {
        let mut nearest = f64::INFINITY;
        for bone in &body.bones {
            let [a, b] = bone.map(|j| body.joints[j as usize]);
            let low = if graph.is_leaf(bone[0]) { -20.0 } else { 0.0 };
            let high = if graph.is_leaf(bone[1]) { 20.0 } else { 1.0 };
            for k in 0..=40_000 {
                nearest = nearest.min(p.distance(a.lerp(b, low + (high - low) * f64::from(k) / 40_000.0)));
            }
        }
        assert!(p.distance(q) <= nearest + 1e-12 && p.distance(q) >= nearest - 2e-3, "{} {nearest}", p.distance(q));
    }
}

#[test]
fn skin_weights_decide_the_bone() {
    let mut random = Random::new(7);
    let body = skeleton(&mut random);
    let avatar = soup(&mut random, 40);
    let count = avatar.positions.len();
    let mut weights = vec![0.0; 7 * count];
    // All to joint 4, the hand, which only bone 3 has.
    weights[4 * count..5 * count].fill(1.0);
    let skin = SkinWeights::from_dense(&weights, 7, count, "skin").unwrap();
    let projected = project(&avatar, &body, &body, Some(&skin));
    let ends = body.bones[3].map(|j| body.joints[j as usize]);
    assert!(projected.shrunk.iter().all(|&p| distance_to_line(p, ends) < 1e-9));
    assert_eq!(projected.triangles.len(), avatar.triangles.len(), "no triangle spans two bones");
}

#[test]
fn neighbours_that_are_split_alike_share_their_new_points() {
    let body = Skeleton {
        joints: vec![DVec3::ZERO, DVec3::X, 2.0 * DVec3::X, 3.0 * DVec3::X],
        bones: vec![[0, 1], [1, 2], [2, 3]],
    };
    let positions = vec![
        DVec3::new(0.5, 0.3, 0.0),
        DVec3::new(2.5, 0.3, 0.1),
        DVec3::new(0.6, 0.4, 0.7),
        DVec3::new(2.4, 0.4, -0.7),
    ];
    let avatar = TriangleMesh { positions, triangles: vec![[0, 1, 2], [1, 0, 3]] };
    let projected = project(&avatar, &body, &body, None);
    collapses(&projected, &body);
    for (i, a) in projected.start.iter().zip(&projected.end).enumerate() {
        for b in projected.start.iter().zip(&projected.end).skip(i + 1) {
            assert!(a != b, "vertex {i} exists twice");
        }
    }
    // The shared edge 0-1 crosses two joints: both triangles must use the same two points on it.
    let on_edge = |p: &DVec3| {
        let t = (p.x - 0.5) / 2.0;
        p.distance(avatar.positions[0].lerp(avatar.positions[1], t)) < 1e-12 && t > 1e-9 && t < 1.0 - 1e-9
    };
    assert_eq!(projected.end.iter().filter(|p| on_edge(p)).count(), 2);
}

/// A chain of many bones: the pieces must not multiply, and still tile the triangle.
#[test]
fn a_triangle_over_a_long_chain_is_cut_into_few_pieces() {
    let count = 40;
    let joints = (0..=count).map(|k| DVec3::new(f64::from(k), 0.1 * f64::from(k % 3), 0.0)).collect();
    let chain = Skeleton { joints, bones: (0..count).map(|k| [k, k + 1]).collect() };
    let positions =
        vec![DVec3::new(0.4, 1.0, 0.0), DVec3::new(f64::from(count) - 0.5, 1.0, 0.2), DVec3::new(12.5, 1.0, 0.7)];
    let avatar = TriangleMesh { positions: positions.clone(), triangles: vec![[0, 1, 2]] };
    let projected = project(&avatar, &chain, &chain, None);
    collapses(&projected, &chain);
    assert!(projected.triangles.len() < 40 * 40, "{} pieces", projected.triangles.len());
    assert!(projected.bones.iter().all(Option::is_some));
    let whole = area([positions[0], positions[1], positions[2]]);
    let pieces: f64 = projected.triangles.iter().map(|t| area(t.map(|v| projected.end[v as usize]))).sum();
    assert!((whole - pieces).abs() < 1e-9 * whole, "{whole} {pieces}");
}
