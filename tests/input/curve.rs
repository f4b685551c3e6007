//! Curves that a caller names, on garments whose vertices are split.

use bespoke::error::ErrorKind;
use bespoke::geometry::mesh::{Topology, TriangleMesh};
use bespoke::input::curve::Curve;
use bespoke::input::weld::Weld;
use glam::DVec3;

/// A row of squares of own vertices, four each: 0 to 3 are the first one's corners, around it.
fn squares(count: u32) -> Weld {
    let mut mesh = TriangleMesh::default();
    for k in 0..count {
        let x = f64::from(k);
        mesh.positions.extend([[x, 0.0], [x + 1.0, 0.0], [x + 1.0, 1.0], [x, 1.0]].map(|[x, y]| DVec3::new(x, y, 0.0)));
        mesh.triangles.extend([[4 * k, 4 * k + 1, 4 * k + 2], [4 * k, 4 * k + 2, 4 * k + 3]]);
    }
    Weld::new(&mesh).0
}

fn curve(vertices: &[u32], closed: bool) -> Curve {
    Curve { vertices: vertices.to_vec(), closed, curve_weight: 1.0, position_weight: 1.0 }
}

#[test]
fn copies_in_a_row_are_one_vertex() {
    let weld = squares(2);
    let edges = Topology::new(weld.mesh.positions.len(), &weld.mesh.triangles).edges;
    let lower = curve(&[0, 1, 4, 5], false).welded(0, &weld).unwrap();
    assert_eq!((lower.curve.vertices.len(), lower.callers.as_slice()), (3, [0, 1, 5].as_slice()));
    lower.check_edges(0, &edges).unwrap();
    // Around all of it, by the copies of either square; the last is the first again.
    let around = curve(&[4, 5, 6, 7, 3, 0, 1], true).welded(0, &weld).unwrap();
    assert_eq!(around.callers, [4, 5, 6, 7, 3, 0]);
    around.check_edges(0, &edges).unwrap();
}

#[test]
fn what_is_no_curve_is_refused() {
    let weld = squares(2);
    let edges = Topology::new(weld.mesh.positions.len(), &weld.mesh.triangles).edges;
    let refused = |curve: Curve, words: &[&str]| {
        let error = curve.welded(4, &weld).and_then(|curve| curve.check_edges(4, &edges)).unwrap_err();
        assert_eq!(error.kind, ErrorKind::InvalidArgument);
        assert!(
            error.message.starts_with("curve 4: ") && words.iter().all(|word| error.message.contains(word)),
            "{error:?}"
        );
    };
    refused(curve(&[1, 4], false), &["1 places", "open"]);
    refused(curve(&[0, 1, 4], true), &["2 places", "closed"]);
    refused(curve(&[1, 5, 6, 4], false), &["vertices 1 and 4 share their place"]);
    refused(curve(&[0, 8], false), &["vertex 8", "8 vertices"]);
    // A diagonal that no triangle has, and the way back of a closed one.
    refused(curve(&[1, 3], false), &["vertices 1 and 3"]);
    refused(curve(&[0, 1, 5], true), &["vertices 5 and 0"]);
}

#[test]
fn curves_coincide_either_way_around() {
    let ring = curve(&[3, 5, 8, 2], true);
    for same in [[3, 5, 8, 2], [8, 2, 3, 5], [2, 8, 5, 3], [5, 3, 2, 8]] {
        assert!(ring.coincides(true, &same), "{same:?}");
        assert!(!ring.coincides(false, &same));
    }
    for other in [[3, 8, 5, 2], [3, 5, 8, 9], [9, 5, 8, 2]] {
        assert!(!ring.coincides(true, &other), "{other:?}");
    }
    assert!(!ring.coincides(true, &[3, 5, 8]));
    let line = curve(&[3, 5, 8], false);
    assert!(
        line.coincides(false, &[8, 5, 3]) && line.coincides(false, &[3, 5, 8]) && !line.coincides(false, &[5, 8, 3])
    );
}
