//! Closest points against brute force and known answers.

use bespoke::geometry::closest_point::{ClosestPoint, barycentric, closest_on_triangle, ray_triangle};
use bespoke::geometry::mesh::TriangleMesh;
use glam::DVec3;

use testing::Random;

/// The smallest distance over a fine grid of points of the triangle: an upper bound that is close.
fn sampled_distance(p: DVec3, [a, b, c]: [DVec3; 3]) -> f64 {
    let n = 200;
    (0..=n)
        .flat_map(|i| (0..=n - i).map(move |j| (i as f64 / n as f64, j as f64 / n as f64)))
        .map(|(v, w)| (a + v * (b - a) + w * (c - a)).distance(p))
        .fold(f64::INFINITY, f64::min)
}

#[test]
fn closest_point_of_a_triangle_beats_every_sampled_point() {
    let mut random = Random::new(1);
    for i in 0..300 {
        let mut corners = [random.vector(), random.vector(), random.vector()];
        match i % 4 {
            1 => corners[2] = corners[0].lerp(corners[1], 0.3),
            2 => corners[2] = corners[1],
            3 => corners[2] = corners[0] + 1e-7 * (corners[2] - corners[0]),
            _ => {}
        }
        if i % 20 == 2 {
            corners[1] = corners[0];
            corners[2] = corners[0];
        }
        let p = 2.0 * random.vector();
        let d = closest_on_triangle(p, &corners).distance(p);
        let sampled = sampled_distance(p, corners);
        assert!(d <= sampled + 1e-9, "{i}: {d} is farther than {sampled}");
        // A grid of 200 steps on edges of length up to 3.5 is within 0.02 of every point.
        assert!(d >= sampled - 0.02, "{i}: {d} is not on the triangle, {sampled}");
    }
}

#[test]
fn tree_agrees_with_brute_force() {
    let mut random = Random::new(2);
    for count in [1, 2, 4, 5, 9, 400] {
        let mut mesh = TriangleMesh::default();
        for t in 0..count {
            let centre = random.vector();
            let size = if t % 7 == 0 { 0.0 } else { 0.2 };
            let first = mesh.positions.len() as u32;
            mesh.positions.extend([(); 3].map(|()| centre + size * random.vector()));
            mesh.triangles.push([first, first + 1, first + 2]);
        }
        let tree = ClosestPoint::new(&mesh);
        for _ in 0..500 {
            let p = 1.5 * random.vector();
            let all = mesh.triangles.iter().map(|t| closest_on_triangle(p, &t.map(|v| mesh.positions[v as usize])));
            let brute = all.map(|q| q.distance_squared(p)).fold(f64::INFINITY, f64::min).sqrt();
            assert_eq!(tree.distance(p), brute);
            let closest = tree.closest(p).expect("there are triangles");
            assert_eq!(closest.distance, brute);
            assert!((closest.point.distance(p) - brute).abs() < 1e-14);
            let corners = mesh.triangles[closest.triangle as usize].map(|v| mesh.positions[v as usize]);
            assert_eq!(closest_on_triangle(p, &corners), closest.point);
        }
    }
}

/// First hits and signed crossings against all triangles, one by one.
#[test]
fn rays_agree_with_brute_force() {
    let mut random = Random::new(5);
    let mut mesh = TriangleMesh::default();
    for _ in 0..300 {
        let (centre, first) = (random.vector(), mesh.positions.len() as u32);
        mesh.positions.extend([(); 3].map(|()| centre + 0.3 * random.vector()));
        mesh.triangles.push([first, first + 1, first + 2]);
    }
    let tree = ClosestPoint::new(&mesh);
    let mut met = 0;
    for _ in 0..400 {
        let (p, direction) = (1.2 * random.vector(), random.vector());
        let corners = mesh.triangles.iter().map(|t| t.map(|v| mesh.positions[v as usize]));
        let hits: Vec<(f64, bool)> = corners
            .filter_map(|c| {
                let along = ray_triangle(p, direction, &c)?;
                Some((along, (c[1] - c[0]).cross(c[2] - c[0]).dot(direction) > 0.0))
            })
            .collect();
        let first = hits.iter().map(|hit| hit.0).reduce(f64::min);
        let crossings: i32 = hits.iter().map(|hit| if hit.1 { 1 } else { -1 }).sum();
        assert_eq!(tree.first_hit(p, direction), first);
        assert_eq!(tree.crossings(p, direction), crossings);
        assert_eq!(tree.meets_ray(p, direction), first.is_some());
        // What comes after the first.
        let beyond = first.unwrap_or(0.0);
        let next = tree.next_hit(p, direction, beyond);
        assert_eq!(
            next.map(|hit| hit.0),
            hits.iter().map(|hit| hit.0).filter(|&along| along > beyond).reduce(f64::min)
        );
        let outwards = |along: f64| hits.iter().find(|hit| hit.0 == along).map(|hit| hit.1);
        assert_eq!(next.map(|hit| hit.1.dot(direction) > 0.0), next.and_then(|hit| outwards(hit.0)));
        met += usize::from(first.is_some());
    }
    assert!((50..350).contains(&met), "{met}");
}

#[test]
fn equal_triangles_are_found() {
    let corner = [DVec3::ZERO, DVec3::X, DVec3::Y];
    let mesh = TriangleMesh { positions: corner.to_vec(), triangles: vec![[0, 1, 2]; 1000] };
    assert_eq!(ClosestPoint::new(&mesh).distance(DVec3::new(0.2, 0.2, 3.0)), 3.0);
}

#[test]
fn without_triangles_the_distance_is_infinite() {
    let tree = ClosestPoint::new(&TriangleMesh::default());
    assert_eq!(tree.distance(DVec3::ZERO), f64::INFINITY);
    assert!(tree.closest(DVec3::ZERO).is_none());
}

#[test]
fn barycentric_coordinates_give_the_point_back() {
    let mut random = Random::new(9);
    for k in 0..200 {
        let mut corners = [random.vector(), random.vector(), random.vector()];
        if k % 10 == 0 {
            // Without area: the corners on a line, or in one place.
            corners[2] = if k % 20 == 0 { corners[0] } else { corners[0].lerp(corners[1], 0.25) };
        }
        let p = closest_on_triangle(2.0 * random.vector(), &corners);
        let b = barycentric(p, corners);
        assert!((b.iter().sum::<f64>() - 1.0).abs() < 1e-12 && b.iter().all(|&b| b >= 0.0));
        if k % 10 != 0 {
            let back: DVec3 = corners.iter().zip(b).map(|(&c, b)| b * c).sum();
            assert!(back.distance(p) < 1e-9, "{back} {p}");
        }
    }
    let [a, b] = [DVec3::ZERO, DVec3::X];
    assert_eq!(barycentric(DVec3::new(0.9, 0.0, 0.0), [a, b, a]), [0.0, 1.0, 0.0]);
}

/// Möller and Trumbore's test, solved for the barycentric coordinates.
fn ray_meets(p: DVec3, direction: DVec3, [a, b, c]: [DVec3; 3]) -> bool {
    let (e, f) = (b - a, c - a);
    let q = direction.cross(f);
    let determinant = e.dot(q);
    let (u, r) = ((p - a).dot(q) / determinant, (p - a).cross(e));
    let (v, t) = (direction.dot(r) / determinant, f.dot(r) / determinant);
    u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t >= 0.0
}

#[test]
fn rays_meet_what_brute_force_says() {
    let mut random = Random::new(5);
    for count in [0, 1, 3, 40, 500] {
        let size = 3.0 / f64::from(count + 1).sqrt();
        let mut mesh = TriangleMesh::default();
        for t in 0..count {
            let centre = random.vector();
            mesh.positions.extend((0..3).map(|_| centre + size * random.vector()));
            mesh.triangles.push([3 * t, 3 * t + 1, 3 * t + 2]);
        }
        let tree = ClosestPoint::new(&mesh);
        let mut hits = 0;
        for k in 0..400 {
            let (p, mut direction) = (1.5 * random.vector(), random.vector());
            if k % 5 == 0 {
                // Along an axis, where the inverse is infinite.
                direction = DVec3::AXES[k % 3];
            }
            let expected =
                mesh.triangles.iter().any(|t| ray_meets(p, direction, t.map(|v| mesh.positions[v as usize])));
            assert_eq!(tree.meets_ray(p, direction), expected, "{count} triangles, from {p} along {direction}");
            hits += usize::from(expected);
        }
        assert!(count < 3 || (20..400).contains(&hits), "{hits} of 400 rays hit {count} triangles");
    }
}
