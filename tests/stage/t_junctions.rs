//! T-junctions, against a search over all vertices and edges.

use bespoke::geometry::mesh::{TriangleMesh, triangle_area};
use bespoke::stage::setup::t_junctions::TJunctions;
use glam::DVec3;

/// A bent sheet of 8 x 8 quads whose triangles of every third quad are split at their diagonal on one side only; the new
/// vertex is `off` the edge.
fn sheet(off: f64) -> (TriangleMesh, usize) {
    const N: u32 = 8;
    let mut mesh = TriangleMesh::default();
    for (i, j) in (0..=N).flat_map(|i| (0..=N).map(move |j| (i, j))) {
        let (x, y) = (0.1 * f64::from(i), 0.1 * f64::from(j));
        mesh.positions.push(DVec3::new(x, y, 0.3 * x * y));
    }
    let mut count = 0;
    for (i, j) in (0..N).flat_map(|i| (0..N).map(move |j| (i, j))) {
        let a = i * (N + 1) + j;
        let [b, c, d] = [a + N + 1, a + N + 2, a + 1];
        mesh.triangles.push([a, b, c]);
        if (i + j) % 3 == 0 {
            let m = mesh.positions.len() as u32;
            let share = 0.3 + 0.05 * f64::from(i);
            let [p, q] = [a, c].map(|v| mesh.positions[v as usize]);
            mesh.positions.push(p.lerp(q, share) + off * DVec3::Z);
            mesh.triangles.extend([[a, m, d], [m, c, d]]);
            count += 1;
        } else {
            mesh.triangles.push([a, c, d]);
        }
    }
    (mesh, count)
}

/// Vertices and triangles that have an edge with no other triangle, on which the vertex lies between its ends.
fn by_search(mesh: &TriangleMesh, distance: f64) -> Vec<(u32, [u32; 3])> {
    let has = |t: &[u32; 3], e: [u32; 2]| e.iter().all(|v| t.contains(v));
    let mut found = Vec::new();
    for v in 0..mesh.positions.len() as u32 {
        let p = mesh.positions[v as usize];
        for t in mesh.triangles.iter().filter(|t| !t.contains(&v)) {
            for k in 0..3 {
                let e = [t[k], t[(k + 1) % 3]];
                let alone = mesh.triangles.iter().filter(|other| has(other, e)).count() == 1;
                let [a, b] = e.map(|v| mesh.positions[v as usize]);
                let along = (p - a).dot(b - a) / (b - a).length_squared();
                let off = p.distance(a.lerp(b, along));
                if alone && along > 0.05 && along < 0.95 && off <= distance {
                    found.push((v, *t));
                }
            }
        }
    }
    found
}

#[test]
fn what_lies_on_an_edge_is_found_and_joined() {
    for (off, is_on) in [(0.0, true), (1e-9, true), (5e-4, true), (2e-3, false)] {
        let (mesh, count) = sheet(off);
        let found = TJunctions::find(&mesh, 1e-3);
        let holds: Vec<(u32, [u32; 3])> = found.holds.iter().map(|hold| (hold.vertex, hold.triangle)).collect();
        assert_eq!(holds, by_search(&mesh, 1e-3));
        assert_eq!(holds.len(), if is_on { count } else { 0 });
        // The two triangles at each vertex and that with the edge.
        let mut pairs = Vec::new();
        for (v, t) in holds {
            let index = |t: &[u32; 3]| mesh.triangles.iter().position(|other| other == t).unwrap() as u32;
            let own = mesh.triangles.iter().filter(|t| t.contains(&v));
            pairs.extend(own.map(|s| [index(s).min(index(&t)), index(s).max(index(&t))]));
        }
        pairs.sort_unstable();
        assert_eq!(found.joined, pairs);
        let areas: Vec<f64> =
            mesh.triangles.iter().map(|&t| triangle_area(t.map(|v| mesh.positions[v as usize]))).collect();
        assert!(found.holds.iter().all(|hold| hold.area > areas.iter().copied().fold(f64::INFINITY, f64::min)));
    }
}

/// A lining whose border lies on that of the cloth is another layer.
#[test]
fn two_layers_are_not_joined() {
    let mut mesh = TriangleMesh::default();
    for (count, height) in [(4, 0.0), (7, 1e-5)] {
        let first = mesh.positions.len() as u32;
        for i in 0..=count {
            let x = f64::from(i) / f64::from(count);
            mesh.positions.extend([DVec3::new(x, 0.0, height), DVec3::new(x, 0.2, height)]);
        }
        for i in 0..count {
            let a = first + 2 * i;
            mesh.triangles.extend([[a, a + 2, a + 1], [a + 2, a + 3, a + 1]]);
        }
    }
    assert_eq!(TJunctions::find(&mesh, 1e-3), TJunctions::default());
}

#[test]
fn without_a_distance_none_is_found() {
    assert_eq!(TJunctions::find(&sheet(0.0).0, 0.0), TJunctions::default());
}
