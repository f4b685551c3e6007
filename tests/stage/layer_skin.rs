//! Skin weights of layers.

use std::sync::Arc;

use bespoke::geometry::mesh::TriangleMesh;
use bespoke::input::body::Body;
use bespoke::input::skeleton::Skeleton;
use bespoke::input::skin::SkinWeights;
use bespoke::stage::setup::layer_skin::{skin_on_skeleton, skin_with_layers};
use glam::DVec3;

/// A unit square from x = 0 to 1, its left side moved by joint 0, its right side by joint 1 with weights of another sum.
fn avatar() -> (Arc<TriangleMesh>, SkinWeights) {
    let positions = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]].map(|[x, y]| DVec3::new(x, y, 0.0)).to_vec();
    let mesh = TriangleMesh { positions, triangles: vec![[0, 1, 3], [0, 3, 2]] };
    let rows = [100.0, 0.0, 100.0, 0.0, 0.0, 0.01, 0.0, 0.01];
    (Arc::new(mesh), SkinWeights::from_dense(&rows, 2, 4, "skin").unwrap())
}

#[test]
fn a_layer_has_the_weights_of_the_nearest_point_beneath() {
    let (avatar, skin) = avatar();
    let at = [-3.0, 0.1, 0.45, 0.55, 0.9, 7.0];
    let positions = at.iter().map(|&x| DVec3::new(x, 0.4, 0.3)).collect();
    let layer = Arc::new(TriangleMesh { positions, triangles: vec![[0, 1, 2], [3, 4, 5]] });
    let body = Body::new(&avatar, &[layer.clone(), layer]).unwrap();
    let extended = skin_with_layers(&skin, &body);
    assert_eq!((extended.joint_count(), extended.vertex_count()), (2, 4 + 6 + 6));
    let joints: Vec<_> = (0..16).map(|v| extended.dominant_joint(v)).collect();
    let [left, right] = [Some(0), Some(1)];
    assert_eq!(joints[..4], [left, right, left, right]);
    for layer in [&joints[4..10], &joints[10..]] {
        assert_eq!(layer, [left, left, left, right, right, right]);
    }
}

#[test]
fn no_weights_beneath_are_none_above() {
    let (avatar, _) = avatar();
    let skin = SkinWeights::from_dense(&[0.0; 8], 2, 4, "skin").unwrap();
    let layer = Arc::new(TriangleMesh { positions: vec![DVec3::Z; 3], triangles: vec![[0, 1, 2]] });
    let body = Body::new(&avatar, &[layer]).unwrap();
    let extended = skin_with_layers(&skin, &body);
    assert!((0..7).all(|v| extended.dominant_joint(v).is_none()));
    assert_eq!(*skin_with_layers(&skin, &Body::new(&avatar, &[]).unwrap()), skin);
}

#[test]
fn the_inner_side_of_a_shoe_does_not_belong_to_the_other_foot() {
    // Two feet as squares side by side, 0.1 apart, at the ends of legs of two bones.
    let square = |x: f64| [[x, 0.0], [x + 1.0, 0.0], [x, 1.0], [x + 1.0, 1.0]].map(|[x, y]| DVec3::new(x, y, 0.0));
    let positions = [square(-1.05), square(0.05)].concat();
    let avatar = Arc::new(TriangleMesh { positions, triangles: vec![[0, 1, 3], [0, 3, 2], [4, 5, 7], [4, 7, 6]] });
    // Hips, left knee and ankle, right knee and ankle; the feet belong to the ankles.
    let skeleton = Skeleton { joints: vec![DVec3::ZERO; 5], bones: vec![[0, 1], [1, 2], [0, 3], [3, 4]] };
    let rows = (0..8).map(|v| vec![(if v < 4 { 2 } else { 4 }, 1.0)]);
    let skin = SkinWeights::from_rows(5, rows);
    // A sole on the left foot that reaches over to the other one, cut along its length by a seam.
    let at = |x: f64, y: f64| DVec3::new(x, y, 0.1);
    let sole = TriangleMesh {
        positions: [-1.1, -0.5, -0.5, 0.02].iter().flat_map(|&x| [at(x, 0.0), at(x, 1.0)]).collect(),
        triangles: vec![[0, 2, 3], [0, 3, 1], [4, 6, 7], [4, 7, 5]],
    };
    let body = Body::new(&avatar, &[Arc::new(sole)]).unwrap();
    let joints = |skin: &SkinWeights| (8..16).map(|v| skin.dominant_joint(v)).collect::<Vec<_>>();
    let (left, right) = (Some(2), Some(4));
    assert_eq!(joints(&skin_with_layers(&skin, &body)), [left, left, left, left, left, left, right, right]);
    assert_eq!(joints(&skin_on_skeleton(&skin, &body, &skeleton)), [left; 8]);
    // A sole each is no matter.
    let soles = [-1.05, 0.05].map(|x| {
        let positions = square(x).map(|p| p + 0.1 * DVec3::Z).to_vec();
        Arc::new(TriangleMesh { positions, triangles: vec![[0, 1, 3], [0, 3, 2]] })
    });
    let body = Body::new(&avatar, &soles).unwrap();
    assert_eq!(joints(&skin_on_skeleton(&skin, &body, &skeleton)), [[left; 4], [right; 4]].concat());
}
