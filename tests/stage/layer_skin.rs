//! Skin weights of layers.

use std::sync::Arc;

use bespoke::geometry::mesh::TriangleMesh;
use bespoke::input::body::Body;
use bespoke::input::skin::SkinWeights;
use bespoke::stage::setup::layer_skin::skin_with_layers;
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
