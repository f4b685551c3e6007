//! What passes through itself as designed is pulled apart, and what cannot be stays as it was.

use bespoke::control::Cancel;
use bespoke::geometry::mesh::TriangleMesh;
use bespoke::stage::start::untangle::untangle;
use bespoke::verify::intersections;
use glam::DVec3;

const CELL: f64 = 0.05;

/// Adds a square sheet of `cells` x `cells`, its points moved by `shape`.
fn add_sheet(mesh: &mut TriangleMesh, cells: u32, shape: impl Fn(f64, f64) -> DVec3) {
    let first = mesh.positions.len() as u32;
    for i in 0..=cells {
        for j in 0..=cells {
            mesh.positions.push(shape(CELL * f64::from(i), CELL * f64::from(j)));
        }
    }
    for i in 0..cells {
        for j in 0..cells {
            let at = |i: u32, j: u32| first + i * (cells + 1) + j;
            mesh.triangles.push([at(i, j), at(i + 1, j), at(i + 1, j + 1)]);
            mesh.triangles.push([at(i, j), at(i + 1, j + 1), at(i, j + 1)]);
        }
    }
}

fn pairs_of(mesh: &TriangleMesh) -> Vec<[u32; 2]> {
    intersections(mesh, None, usize::MAX).unwrap().pairs
}

/// Untangles `mesh`, and returns the pairs that came and that remain, and the start.
fn untangled(mesh: &TriangleMesh) -> ([Vec<[u32; 2]>; 2], Vec<DVec3>) {
    let designed = pairs_of(mesh);
    let Some(done) = untangle(mesh, &designed, &Cancel::new()).unwrap() else {
        return ([designed.clone(), designed], mesh.positions.clone());
    };
    let now = pairs_of(&TriangleMesh { positions: done.start.clone(), triangles: mesh.triangles.clone() });
    assert_eq!(now, done.remaining, "what it says remains is what intersects");
    assert!(now.iter().all(|pair| designed.binary_search(pair).is_ok()), "something new intersects");
    ([designed, now], done.start)
}

/// A pocket on a coat: a smaller sheet just above a larger one, dented into it by `depth`, in places.
fn pocket(depth: f64) -> TriangleMesh {
    let mut mesh = TriangleMesh::default();
    add_sheet(&mut mesh, 20, |x, y| DVec3::new(x, y, 0.0));
    let dent = |x: f64, y: f64| (9.0 * x).sin() * (7.0 * y + 0.5).sin();
    add_sheet(&mut mesh, 10, |x, y| DVec3::new(x + 0.26, y + 0.24, 0.01 - (0.01 + depth) * dent(x, y).max(0.0)));
    mesh
}

#[test]
fn a_pocket_that_dips_into_the_coat_is_pulled_out() {
    for depth in [0.002, 0.01, 0.02] {
        let mesh = pocket(depth);
        let ([designed, remaining], start) = untangled(&mesh);
        assert!(designed.len() > 20, "only {} pairs intersect in the design", designed.len());
        assert_eq!(remaining.len(), 0, "of {} pairs, at depth {depth}", designed.len());
        let farthest = start.iter().zip(&mesh.positions).map(|(a, b)| a.distance(*b)).fold(0.0, f64::max);
        assert!(farthest < 2.5 * depth + 0.5 * CELL, "a vertex moved by {farthest} where {depth} was to be undone");
        let far = |p: &DVec3| p.x < 0.1 || p.y < 0.1 || p.x > 0.9 || p.y > 0.9;
        assert!(mesh.positions.iter().zip(&start).all(|(p, q)| !far(p) || p == q), "a vertex moved that is far away");
    }
}

#[test]
fn an_edge_that_pokes_through_is_drawn_back() {
    let mut mesh = TriangleMesh::default();
    add_sheet(&mut mesh, 20, |x, y| DVec3::new(x, y, 0.0));
    // A flap whose free edge ends below the sheet.
    add_sheet(&mut mesh, 8, |x, y| DVec3::new(x + 0.3, 0.5, 0.387 - y));
    let ([designed, remaining], _) = untangled(&mesh);
    assert!(designed.len() >= 8);
    assert_eq!(remaining.len(), 0);
}

#[test]
fn what_takes_large_displacements_stays_and_the_rest_is_pulled_apart() {
    let mut mesh = pocket(0.01);
    let pocket_only = pairs_of(&mesh).len();
    // Two sheets through each other in the middle, far from the pocket: nothing small parts them.
    add_sheet(&mut mesh, 16, |x, y| DVec3::new(x + 3.0, y, 0.0));
    add_sheet(&mut mesh, 16, |x, y| DVec3::new(3.4, x, y - 0.4));
    let ([designed, remaining], start) = untangled(&mesh);
    assert_eq!(remaining.len(), designed.len() - pocket_only);
    let crossing = |p: &DVec3| p.x > 2.0;
    assert!(mesh.positions.iter().zip(&start).all(|(p, q)| !crossing(p) || p == q), "a vertex of the cross moved");
}

#[test]
fn a_clean_garment_is_left_alone() {
    let mut mesh = TriangleMesh::default();
    add_sheet(&mut mesh, 6, |x, y| DVec3::new(x, y, 0.0));
    assert!(untangle(&mesh, &[], &Cancel::new()).unwrap().is_none());
}

#[test]
fn a_cancelled_token_ends_it() {
    let mesh = pocket(0.01);
    let cancel = Cancel::new();
    cancel.request();
    assert!(untangle(&mesh, &pairs_of(&mesh), &cancel).is_err());
}
