//! Weights for meshes of any kind: finite, above 0, of sum 1.

use bespoke::control::Cancel;
use bespoke::geometry::mesh::TriangleMesh;
use bespoke::input::skin::SkinWeights;
use bespoke::rig::weights::{TransferOptions, limited, move_as_one, transfer};
use glam::DVec3;
use proptest::prelude::*;
use testing::Random;

use crate::limbs::{assert_weights, joined, skin, tube};

/// A soup with everything that a mesh can have: edges of many triangles, slivers, triangles in a point or on a line, layers
/// in one place, repeated indices, vertices that no triangle has.
fn soup(seed: u64, count: usize, scale: f64) -> TriangleMesh {
    let mut random = Random::new(seed);
    let mut positions: Vec<DVec3> = (0..count).map(|_| scale * random.vector()).collect();
    for k in 0..count / 4 {
        let (from, to) = (random.unit() * count as f64, random.unit() * count as f64);
        positions[to as usize] =
            positions[from as usize] + if k % 2 == 0 { DVec3::ZERO } else { 1e-9 * scale * random.vector() };
    }
    let mut pick = |_| ((random.unit() * 0.9 * count as f64) as u32).min(count as u32 - 1);
    let mut triangles: Vec<[u32; 3]> = (0..2 * count).map(|_| [(); 3].map(|()| pick(()))).collect();
    triangles.extend_from_within(..count / 3);
    TriangleMesh { positions, triangles }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 60, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_mesh_gets_weights(
        seed in any::<u64>(),
        count in 3_usize..120,
        exponent in -12_i32..12,
        nearness in 0.0..0.5_f64,
        normal_angle in 0.0..90.0_f64,
        smoothing in 0.0..4.0_f64,
        influences in 1_usize..9,
    ) {
        let scale = 10_f64.powi(exponent);
        let mut body = tube(-1.0, 1.0, 0.4, 8, 8);
        body.positions.iter_mut().for_each(|p| *p *= scale);
        let mut random = Random::new(seed ^ 1);
        let row = |_: &DVec3| {
            let joints = (0..(4.0 * random.unit()) as u32).map(|k| (5 * k, random.unit() + 1e-9));
            joints.collect::<Vec<_>>()
        };
        let mut rows: Vec<Vec<(u32, f64)>> = body.positions.iter().map(row).collect();
        rows[0] = vec![(1, 1.0)];
        let skin = SkinWeights::from_rows(20, rows);
        let garment = soup(seed, count, scale);
        let options = TransferOptions { nearness, normal_angle, smoothing };
        let result = transfer(&garment, &body, &skin, &options, &Cancel::new()).expect("weights");
        assert_weights(&result, count, 20);
        let group = (0..count as u32).step_by(3).collect();
        let limited = limited(&move_as_one(&result, &[group]).expect("vertices in range"), influences);
        assert_weights(&limited, count, influences);
    }
}

/// Beyond what squares of coordinates can hold, and below.
#[test]
fn extreme_coordinates_get_weights() {
    for scale in [1e-200, 1e-100, 1e100, 1e153, 1e200] {
        let (mut body, mut garment) = (tube(-3.0, 3.0, 0.5, 12, 8), tube(-2.0, 2.0, 0.6, 9, 7));
        let weights = skin(&body);
        for p in body.positions.iter_mut().chain(&mut garment.positions) {
            *p *= scale;
        }
        let result = transfer(&garment, &body, &weights, &TransferOptions::default(), &Cancel::new()).expect("weights");
        assert_weights(&result, garment.positions.len(), 2);
    }
}

/// A body in one point, a garment in one point, and none at all.
#[test]
fn points_get_weights() {
    let limb = tube(-3.0, 3.0, 0.5, 12, 8);
    let point = TriangleMesh { positions: vec![DVec3::ONE; limb.positions.len()], triangles: limb.triangles.clone() };
    for (garment, body) in [(&limb, &point), (&point, &limb), (&point, &point), (&joined(&limb, &point), &limb)] {
        let result =
            transfer(garment, body, &skin(&limb), &TransferOptions::default(), &Cancel::new()).expect("weights");
        assert_weights(&result, garment.positions.len(), 2);
    }
    let none = TriangleMesh::default();
    let result = transfer(&none, &limb, &skin(&limb), &TransferOptions::default(), &Cancel::new()).expect("weights");
    assert_eq!(result.vertex_count(), 0);
}
