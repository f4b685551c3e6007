//! The fit region that the designed distance decides.

use bespoke::geometry::closest_point::ClosestPoint;
use bespoke::geometry::mesh::TriangleMesh;
use bespoke::stage::setup::fit_region::fit_region;
use glam::DVec3;

#[test]
fn weights_fall_from_one_to_nothing_between_the_reach_and_twice_that() {
    let corners = [[-9.0, -9.0], [9.0, -9.0], [0.0, 9.0]];
    let min_separation = TriangleMesh {
        positions: corners.iter().map(|&[x, y]| DVec3::new(x, y, 0.0)).collect(),
        triangles: vec![[0, 1, 2]],
    };
    let body = ClosestPoint::new(&min_separation);
    let heights: Vec<f64> = (0..=40).map(|k| 0.01 * f64::from(k)).collect();
    let points: Vec<DVec3> = heights.iter().map(|&z| DVec3::new(0.1, 0.2, -z)).collect();
    let weights = fit_region(&points, &body, 0.1);
    for (&z, &w) in heights.iter().zip(&weights) {
        match z {
            z if z <= 0.1 => assert_eq!(w, 1.0, "at {z}"),
            z if z > 0.2 - 1e-12 => assert!(w < 1e-12, "{w} at {z}"),
            _ => assert!((0.0..1.0).contains(&w), "{w} at {z}"),
        }
    }
    assert!(weights.windows(2).all(|w| w[1] <= w[0]));
    assert!((weights[15] - 0.5).abs() < 1e-12);
    assert_eq!(fit_region(&points, &body, f64::INFINITY), vec![1.0; points.len()]);
}
