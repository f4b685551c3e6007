//! Points spread over a surface.

use bespoke::geometry::mesh::TriangleMesh;
use bespoke::geometry::spread::spread;
use glam::DVec3;

/// A strip from x = 0 to 3, of which one square is two triangles and the other two are many.
fn strip() -> TriangleMesh {
    let mut corners = Vec::new();
    let mut square = |low: f64, high: f64, y: [f64; 2]| {
        let [a, b, c, d] = [(low, y[0]), (high, y[0]), (high, y[1]), (low, y[1])].map(|(x, y)| DVec3::new(x, y, 0.0));
        corners.extend([[a, b, c], [a, c, d]]);
    };
    square(0.0, 1.0, [0.0, 1.0]);
    for k in 0..400 {
        let [x, y] = [f64::from(k / 20) / 10.0, f64::from(k % 20) / 20.0];
        square(1.0 + x, 1.1 + x, [y, y + 0.05]);
    }
    TriangleMesh::from_corners(corners)
}

#[test]
fn points_lie_on_their_triangles_in_proportion_to_the_area() {
    let mesh = strip();
    let points = spread(&mesh, 90);
    assert!((88..=92).contains(&points.len()), "{}", points.len());
    let in_first = points.iter().filter(|(p, _)| p.x < 1.0).count();
    assert!((25..=35).contains(&in_first), "{in_first} of {}", points.len());
    for (p, v) in points {
        let triangle = v / 3;
        let [a, b, c] = mesh.corners(triangle);
        let parts: f64 = [[a, b], [b, c], [c, a]].map(|[s, t]| 0.5 * (s - p).cross(t - p).length()).iter().sum();
        assert!((parts - mesh.areas()[triangle as usize]).abs() < 1e-12, "{p} in triangle {triangle}");
    }
}
