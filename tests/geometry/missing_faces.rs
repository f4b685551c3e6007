//! Holes where faces are missing, told from the openings of tubes and sheets.

use std::f64::consts::TAU;

use bespoke::geometry::mesh::{Topology, TriangleMesh};
use bespoke::geometry::missing_faces::are_missing_faces;
use glam::DVec3;

/// A tube that narrows by `cone` of its radius from end to end, with `sides` sides and quads of about equal sides.
fn tube(sides: u32, cone: f64) -> TriangleMesh {
    let rings = 2 * sides.max(6);
    let edge = TAU / f64::from(sides);
    let at = |r: u32, s: u32| r * sides + s % sides;
    let mut mesh = TriangleMesh::default();
    for (r, s) in (0..=rings).flat_map(|r| (0..sides).map(move |s| (r, s))) {
        let (sin, cos) = (edge * f64::from(s)).sin_cos();
        let radius = 1.0 - cone * f64::from(r) / f64::from(rings);
        mesh.positions.push(DVec3::new(radius * cos, radius * sin, edge * f64::from(r)));
    }
    for (r, s) in (0..rings).flat_map(|r| (0..sides).map(move |s| (r, s))) {
        mesh.triangles.extend([[at(r, s), at(r, s + 1), at(r + 1, s)], [at(r, s + 1), at(r + 1, s + 1), at(r + 1, s)]]);
    }
    mesh
}

/// Takes away `count` triangles in a row along the tube, of the strip between two rows of vertices, `every` so many rings.
fn with_holes(mut mesh: TriangleMesh, sides: usize, count: usize, every: usize) -> (TriangleMesh, usize) {
    let rings = mesh.positions.len() / sides - 1;
    let first: Vec<usize> = (1..rings).step_by(every).filter(|r| r + 2 < rings).map(|r| 2 * sides * r + 2).collect();
    let is_taken = |t: usize| first.iter().any(|&f| (f..f + count).contains(&t));
    let mut t = 0..;
    mesh.triangles.retain(|_| !is_taken(t.next().unwrap()));
    (mesh, first.len())
}

fn found(mesh: &TriangleMesh) -> (usize, Vec<usize>) {
    let topology = Topology::new(mesh.positions.len(), &mesh.triangles);
    let flags = are_missing_faces(mesh, &topology);
    assert_eq!(flags.len(), topology.loops.len());
    let openings = topology.loops.iter().zip(&flags).filter(|(_, is_missing)| !**is_missing);
    (flags.iter().filter(|&&is_missing| is_missing).count(), openings.map(|(l, _)| l.vertices.len()).collect())
}

#[test]
fn the_ends_of_a_tube_are_openings_and_holes_in_it_are_not() {
    for sides in [4, 5, 6, 8, 12, 24] {
        for cone in [0.0, 0.6] {
            let whole = tube(sides, cone);
            assert_eq!(found(&whole), (0, vec![sides as usize; 2]), "{sides} {cone}");
            // A tube of few sides bends by more than a hole of two faces across them.
            let most = if sides < 8 { 1 } else { 3 };
            for count in 1..=most {
                let (mesh, holes) = with_holes(whole.clone(), sides as usize, count, 3);
                assert!(holes > 2);
                assert_eq!(found(&mesh), (holes, vec![sides as usize; 2]), "{sides} {cone} {count}");
            }
        }
    }
}

#[test]
fn a_sheet_has_a_rim_and_what_is_large_in_it_is_an_opening() {
    const N: u32 = 20;
    let at = |i: u32, j: u32| i * (N + 1) + j;
    let mut mesh = TriangleMesh::default();
    for (i, j) in (0..=N).flat_map(|i| (0..=N).map(move |j| (i, j))) {
        mesh.positions.push(DVec3::new(f64::from(i), f64::from(j), 0.0));
    }
    // A neck hole of a poncho, of 16 edges, and one of two faces.
    let is_cut = |i: u32, j: u32| (8..12).contains(&i) && (8..12).contains(&j) || (i, j) == (3, 3);
    for (i, j) in (0..N).flat_map(|i| (0..N).map(move |j| (i, j))).filter(|&(i, j)| !is_cut(i, j)) {
        mesh.triangles.extend([[at(i, j), at(i + 1, j), at(i, j + 1)], [at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]]);
    }
    assert_eq!(found(&mesh), (1, vec![4 * N as usize, 16]));
}
