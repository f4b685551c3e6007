//! Meshes whose distance is known.

use bespoke::geometry::mesh::TriangleMesh;
use glam::DVec3;

/// A sphere of `rings` x `2 rings` quads, without what lies above the height `top` (in radii).
pub fn sphere(centre: DVec3, radius: f64, rings: usize, top: f64) -> TriangleMesh {
    let around = 2 * rings;
    let point = |i: usize, j: usize| {
        let polar = std::f64::consts::PI * i as f64 / rings as f64;
        let angle = std::f64::consts::TAU * (j % around) as f64 / around as f64;
        DVec3::new(polar.sin() * angle.cos(), polar.sin() * angle.sin(), -polar.cos())
    };
    let mut mesh = TriangleMesh::default();
    for i in 0..rings {
        for j in 0..around {
            let quad = [point(i, j), point(i, j + 1), point(i + 1, j + 1), point(i + 1, j)];
            if quad.iter().any(|p| p.z > top) {
                continue;
            }
            // The triangles at the poles have no area, on purpose.
            for corners in [[0, 1, 2], [0, 2, 3]] {
                let first = mesh.positions.len() as u32;
                mesh.positions.extend(corners.map(|c| centre + radius * quad[c]));
                mesh.triangles.push([first, first + 1, first + 2]);
            }
        }
    }
    mesh
}

/// The box from `-half` to `half`, 12 triangles with shared vertices.
pub fn cuboid(half: DVec3) -> TriangleMesh {
    let positions = (0..8)
        .map(|i| {
            let sign = |bit: usize| if i >> bit & 1 == 1 { 1.0 } else { -1.0 };
            half * DVec3::new(sign(0), sign(1), sign(2))
        })
        .collect();
    let quads: [[u32; 4]; 6] = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let triangles = quads.iter().flat_map(|q| [[q[0], q[1], q[2]], [q[0], q[2], q[3]]]).collect();
    TriangleMesh { positions, triangles }
}

/// Signed distance to the box from `-half` to `half`.
pub fn cuboid_distance(half: DVec3, p: DVec3) -> f64 {
    let q = p.abs() - half;
    q.max(DVec3::ZERO).length() + q.max_element().min(0.0)
}

/// Both meshes as one.
pub fn union(mut a: TriangleMesh, b: &TriangleMesh) -> TriangleMesh {
    let first = a.positions.len() as u32;
    a.positions.extend_from_slice(&b.positions);
    a.triangles.extend(b.triangles.iter().map(|t| t.map(|v| v + first)));
    a
}
