//! Solid angles against directions that are counted, and on a closed surface.

use std::f64::consts::PI;

use bespoke::geometry::closest_point::ray_triangle;
use bespoke::geometry::mesh::TriangleMesh;
use bespoke::geometry::solid_angle::{solid_angle, winding};
use glam::DVec3;

use testing::Random;

#[test]
fn it_is_the_share_of_directions_that_meet_the_triangle() {
    let mut random = Random::new(71);
    let directions: Vec<DVec3> =
        std::iter::repeat_with(|| random.vector()).filter(|d| (1e-3..1.0).contains(&d.length())).take(40_000).collect();
    for _ in 0..20 {
        let corners = [random.vector(), random.vector(), random.vector()];
        let p = random.vector();
        let met = directions.iter().filter(|&&d| ray_triangle(p, d, &corners).is_some()).count();
        let share = met as f64 / directions.len() as f64;
        let angle = solid_angle(p, corners);
        assert!((angle.abs() / (4.0 * PI) - share).abs() < 0.01, "{angle} {share}");
        let [a, b, c] = corners;
        assert_eq!(angle > 0.0, (b - a).cross(c - a).dot(a - p) > 0.0);
    }
}

#[test]
fn over_a_closed_surface_it_is_all_around_or_nothing() {
    let o = DVec3::ZERO;
    let faces =
        [[o, DVec3::Y, DVec3::X], [o, DVec3::Z, DVec3::Y], [o, DVec3::X, DVec3::Z], [DVec3::X, DVec3::Y, DVec3::Z]];
    let all = |p: DVec3| faces.iter().map(|&face| solid_angle(p, face)).sum::<f64>();
    assert!((all(DVec3::splat(0.2)) - 4.0 * PI).abs() < 1e-12);
    assert!(all(DVec3::splat(0.5)).abs() < 1e-12 && all(DVec3::new(-0.3, 0.2, 0.1)).abs() < 1e-12);
}

#[test]
fn a_surface_winds_around_what_is_inside_once() {
    let corner = |k: u32| DVec3::new(f64::from(k & 1), f64::from(k >> 1 & 1), f64::from(k >> 2));
    let quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let triangles = quads.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
    let cube = TriangleMesh { positions: (0..8).map(corner).collect(), triangles };
    let mut random = Random::new(76);
    for _ in 0..200 {
        let p = DVec3::splat(0.5) + random.vector();
        let is_inside = p.cmpgt(DVec3::ZERO).all() && p.cmplt(DVec3::ONE).all();
        assert!((winding(&cube, 0..12, p) - f64::from(u8::from(is_inside))).abs() < 1e-9, "{p}");
        // One of six sides is missing.
        if is_inside {
            let without = winding(&cube, 2..12, p);
            assert!(without > 0.0 && without < 1.0, "{without}");
        }
    }
    assert!((winding(&cube, 2..12, DVec3::splat(0.5)) - 5.0 / 6.0).abs() < 1e-12);
}
