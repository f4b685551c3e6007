//! Small cases with a known answer, and meshes that are refused.

use bespoke::error::ErrorKind;
use bespoke::geometry::mesh::TriangleMesh;
use bespoke::verify::intersections;
use glam::DVec3;

fn mesh(points: &[[f64; 3]], triangles: &[[u32; 3]]) -> TriangleMesh {
    TriangleMesh { positions: points.iter().map(|&p| p.into()).collect(), triangles: triangles.to_vec() }
}

fn within(points: &[[f64; 3]], triangles: &[[u32; 3]]) -> u64 {
    intersections(&mesh(points, triangles), None, 0).unwrap().count
}

const FLAT: [[f64; 3]; 3] = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0]];

fn with_flat(other: [[f64; 3]; 3]) -> bool {
    let [s, t] = [&FLAT[..], &other[..]].map(|p| mesh(p, &[[0, 1, 2]]));
    let both = [intersections(&s, Some(&t), 9), intersections(&t, Some(&s), 9)].map(|r| r.unwrap().count);
    assert_eq!(both[0], both[1], "not symmetric for {other:?}");
    both[0] == 1
}

#[test]
fn two_triangles() {
    // Pierced, touched by a corner, touched by a side, just missed.
    assert!(with_flat([[1.0, 1.0, -1.0], [1.0, 1.0, 1.0], [9.0, 9.0, 1.0]]));
    assert!(with_flat([[1.0, 1.0, 0.0], [1.0, 1.0, 1.0], [2.0, 1.0, 1.0]]));
    assert!(with_flat([[2.0, 2.0, -1.0], [2.0, 2.0, 1.0], [9.0, 9.0, 0.0]]));
    assert!(!with_flat([[1.0, 1.0, f64::MIN_POSITIVE], [1.0, 1.0, 1.0], [2.0, 1.0, 1.0]]));
    let beyond = 2.0f64.next_up();
    assert!(!with_flat([[2.0, beyond, -1.0], [2.0, beyond, 1.0], [9.0, 9.0, 0.0]]));
    // In one plane: inside, around, corner to corner, apart.
    assert!(with_flat([[1.0, 1.0, 0.0], [2.0, 1.0, 0.0], [1.0, 2.0, 0.0]]));
    assert!(with_flat([[-9.0, -9.0, 0.0], [30.0, -9.0, 0.0], [-9.0, 30.0, 0.0]]));
    assert!(with_flat([[4.0, 0.0, 0.0], [8.0, 0.0, 0.0], [8.0, 4.0, 0.0]]));
    assert!(!with_flat([[4.0, 4.0, 0.0], [8.0, 0.0, 0.0], [8.0, 4.0, 0.0]]));
    // Without area: a segment through, a segment in the plane, a point in, a point outside.
    assert!(with_flat([[1.0, 1.0, -1.0], [1.0, 1.0, 1.0], [1.0, 1.0, 3.0]]));
    assert!(with_flat([[-1.0, 1.0, 0.0], [5.0, 1.0, 0.0], [2.0, 1.0, 0.0]]));
    assert!(with_flat([[1.0, 1.0, 0.0]; 3]));
    assert!(!with_flat([[1.0, 1.0, 0.5]; 3]));
}

#[test]
fn neighbours() {
    let p = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0], [4.0, 4.0, 0.0], [1.0, 1.0, 0.0], [0.0, 0.0, 0.0]];
    // Across an edge: flat, folded onto each other, the same triangle twice.
    assert_eq!(within(&p, &[[0, 1, 2], [2, 1, 3]]), 0);
    assert_eq!(within(&p, &[[0, 1, 2], [2, 1, 4]]), 1);
    assert_eq!(within(&p, &[[0, 1, 2], [1, 0, 2]]), 1);
    // At a corner: next to each other, one inside the other.
    assert_eq!(within(&[p[0], p[1], p[3], [-4.0, 0.0, 0.0], [0.0, -4.0, 0.0]], &[[0, 1, 2], [0, 3, 4]]), 0);
    assert_eq!(within(&[p[0], p[1], p[2], p[4], [1.0, 2.0, 0.0]], &[[0, 1, 2], [0, 3, 4]]), 1);
    // Vertex 5 is at the position of vertex 0 but another vertex: a contact.
    let seam = [p[0], p[1], p[2], [-4.0, 0.0, 0.0], [0.0, -4.0, 0.0], p[5]];
    assert_eq!(within(&seam, &[[0, 1, 2], [0, 3, 4]]), 0);
    assert_eq!(within(&seam, &[[0, 1, 2], [5, 3, 4]]), 1);
}

#[test]
fn coordinates_that_no_sum_of_doubles_keeps() {
    // A point 2^-60 above the plane x + y + z = 1, seen by exact signs only.
    let plane = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let lift = 2f64.powi(-60);
    for (z, touches) in [(lift, false), (0.0, true)] {
        let other = [[0.5, 0.5, z], [1.5, 0.5, 0.5], [0.5, 1.5, 0.5]];
        let [s, t] = [&plane[..], &other[..]].map(|p| mesh(p, &[[0, 1, 2]]));
        assert_eq!(intersections(&s, Some(&t), 0).unwrap().count == 1, touches, "lift {z}");
    }
}

#[test]
fn meshes_that_cannot_be_verified_are_refused() {
    let nan = mesh(&[[0.0; 3], [f64::NAN, 0.0, 0.0], [0.0; 3]], &[[0, 1, 2]]);
    let far = mesh(&FLAT, &[[0, 1, 3]]);
    for bad in [&nan, &far] {
        assert_eq!(intersections(bad, None, 0).unwrap_err().kind, ErrorKind::InvalidMesh);
        let error = intersections(&mesh(&FLAT, &[[0, 1, 2]]), Some(bad), 0).unwrap_err();
        assert!(error.message.starts_with("second mesh"), "{error}");
    }
    let empty = TriangleMesh::default();
    assert_eq!(intersections(&empty, None, 5).unwrap().count, 0);
    assert_eq!(intersections(&mesh(&FLAT, &[[0, 1, 2]]), Some(&empty), 5).unwrap().count, 0);
    assert_eq!(intersections(&TriangleMesh { positions: vec![DVec3::ZERO; 3], ..empty }, None, 5).unwrap().count, 0);
}
