//! Bound points, and motions of vertices as morphs use them.

use bespoke::follow::binding::Place;
use glam::DVec3;
use testing::Random;

use crate::scene::{bumpy, moved, sheet, similarity};

#[test]
fn a_similarity_takes_points_and_offsets_along() {
    let mut random = Random::new(5);
    for scale in [1.0, 0.02, 9.0] {
        let (points, triangles) = bumpy(4, &mut random);
        let (map, turn) = similarity(&mut random, scale);
        let surface = moved(&points, &triangles, |p| map.transform_point3(p));
        let motions = surface.vertex_motions();
        // Near, far, beside the rim, and on vertices.
        let mut bound: Vec<DVec3> = (0..60).map(|_| DVec3::new(0.5, 0.5, 0.0) + random.vector()).collect();
        bound.extend(&points);
        for (place, &p) in Place::of_all(&surface, &bound).iter().zip(&bound) {
            let now = place.unwrap().now(&surface, &motions);
            assert!(now.distance(map.transform_point3(p)) < 1e-12 * scale.max(1.0), "{now}");
        }
        for motion in &motions {
            let offset = random.vector();
            assert!(motion.of_vector(offset).distance(scale * (turn * offset)) < 1e-12 * scale.max(1.0));
        }
    }
}

/// On a rolled sheet, what was above it is above it at the same distance, whichever triangle is the nearest.
#[test]
fn what_is_bound_above_an_edge_does_not_jump() {
    let (points, triangles) = sheet(10);
    let roll = |p: DVec3| DVec3::new(p.x.sin(), p.y, 1.0 - p.x.cos());
    let surface = moved(&points, &triangles, roll);
    let motions = surface.vertex_motions();
    let line: Vec<DVec3> = (0..=800).map(|k| DVec3::new(0.1 + 0.001 * f64::from(k), 0.437, 0.05)).collect();
    let now: Vec<DVec3> =
        Place::of_all(&surface, &line).iter().map(|place| place.unwrap().now(&surface, &motions)).collect();
    for (p, q) in line.iter().zip(&now) {
        let wanted = roll(*p) + 0.05 * DVec3::new(-p.x.sin(), 0.0, p.x.cos());
        assert!(q.distance(wanted) < 2e-3, "{p}: {q}");
    }
    assert!(now.windows(2).all(|pair| pair[0].distance(pair[1]) < 1.2e-3));
}

/// The nearest point, by a search over all triangles.
#[test]
fn the_nearest_point_is_taken() {
    let mut random = Random::new(7);
    let (points, triangles) = bumpy(4, &mut random);
    let surface = moved(&points, &triangles, |p| p);
    let asked: Vec<DVec3> = (0..50).map(|_| DVec3::new(0.5, 0.5, 0.0) + random.vector()).collect();
    for (place, p) in Place::of_all(&surface, &asked).iter().zip(&asked) {
        let twin = |t: &[u32; 3]| {
            let corners = t.map(|v| points[v as usize]);
            bespoke::geometry::closest_point::closest_on_triangle(*p, &corners).distance(*p)
        };
        let nearest = triangles.iter().map(twin).fold(f64::INFINITY, f64::min);
        assert!((place.unwrap().distance() - nearest).abs() < 1e-12);
    }
    let nothing = moved(&points, &[], |p| p);
    assert!(Place::of_all(&nothing, &asked).iter().all(Option::is_none));
}
