//! A limb along x with its skin weights, and sleeves around it.

use bespoke::geometry::mesh::TriangleMesh;
use bespoke::input::skin::SkinWeights;
use glam::DVec3;

/// A tube along x from `from` to `to` with a radius, open at both ends, facing outwards.
pub fn tube(from: f64, to: f64, radius: f64, rings: u32, sectors: u32) -> TriangleMesh {
    let place = |ring: u32, sector: u32| {
        let angle = std::f64::consts::TAU * f64::from(sector) / f64::from(sectors);
        DVec3::new(from + (to - from) * f64::from(ring) / f64::from(rings), radius * angle.cos(), radius * angle.sin())
    };
    let positions = (0..=rings).flat_map(|ring| (0..sectors).map(move |sector| place(ring, sector))).collect();
    let at = |ring: u32, sector: u32| ring * sectors + sector % sectors;
    let quad = |ring: u32, sector: u32| {
        let [a, b] = [at(ring, sector), at(ring, sector + 1)];
        [[a, b, b + sectors], [a, b + sectors, a + sectors]]
    };
    let triangles = (0..rings).flat_map(|ring| (0..sectors).flat_map(move |sector| quad(ring, sector))).collect();
    TriangleMesh { positions, triangles }
}

/// Two meshes as one.
pub fn joined(a: &TriangleMesh, b: &TriangleMesh) -> TriangleMesh {
    let first = a.positions.len() as u32;
    TriangleMesh {
        positions: [&a.positions[..], &b.positions].concat(),
        triangles: a.triangles.iter().copied().chain(b.triangles.iter().map(|t| t.map(|v| first + v))).collect(),
    }
}

/// Weights of two joints that go over into each other between x = -1 and x = 1.
pub fn skin(mesh: &TriangleMesh) -> SkinWeights {
    let row = |p: &DVec3| {
        let second = (0.5 + 0.5 * p.x).clamp(0.0, 1.0);
        [(0, 1.0 - second), (1, second)].into_iter().filter(|w| w.1 > 0.0).collect()
    };
    SkinWeights::from_rows(2, mesh.positions.iter().map(row))
}

/// The weight of a vertex for a joint.
pub fn weight(skin: &SkinWeights, vertex: usize, joint: u32) -> f64 {
    skin.weights(vertex).iter().find(|w| w.0 == joint).map_or(0.0, |w| w.1)
}

/// Each vertex has weights above 0, of sum 1, of at most `influences` joints.
#[track_caller]
pub fn assert_weights(skin: &SkinWeights, vertices: usize, influences: usize) {
    assert_eq!(skin.vertex_count(), vertices);
    for v in 0..vertices {
        let own = skin.weights(v);
        let sum: f64 = own.iter().map(|w| w.1).sum();
        assert!((1..=influences).contains(&own.len()), "vertex {v} has {} influences", own.len());
        assert!(own.iter().all(|w| w.1 > 0.0 && w.1 <= 1.0 + 1e-12), "vertex {v}: {own:?}");
        assert!((sum - 1.0).abs() < 1e-12, "the weights of vertex {v} sum to {sum}");
    }
}
