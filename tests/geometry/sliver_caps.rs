//! Sliver caps at T-junctions.

use std::collections::BTreeMap;

use bespoke::geometry::mesh::TriangleMesh;
use bespoke::geometry::sliver_caps::without_caps;
use glam::DVec3;

use testing::Random;
use testing::obj::{assets, read_mesh};

fn p(x: f64, y: f64) -> DVec3 {
    DVec3::new(x, y, 0.0)
}

fn sorted(mut triangles: Vec<[u32; 3]>) -> Vec<[u32; 3]> {
    for t in &mut triangles {
        let lowest = (0..3).min_by_key(|&k| t[k]).unwrap();
        t.rotate_left(lowest);
    }
    triangles.sort_unstable();
    triangles
}

/// How often each edge is a side.
fn sides(triangles: &[[u32; 3]]) -> BTreeMap<[u32; 2], usize> {
    let mut count = BTreeMap::new();
    for &[a, b, c] in triangles {
        for [v, w] in [[a, b], [b, c], [c, a]] {
            *count.entry([v.min(w), v.max(w)]).or_default() += 1;
        }
    }
    count
}

fn border(triangles: &[[u32; 3]]) -> Vec<[u32; 2]> {
    sides(triangles).into_iter().filter(|s| s.1 == 1).map(|s| s.0).collect()
}

fn area(positions: &[DVec3], triangles: &[[u32; 3]]) -> f64 {
    let mesh = TriangleMesh { positions: positions.to_vec(), triangles: triangles.to_vec() };
    mesh.areas().iter().sum()
}

#[test]
fn a_cap_is_flipped_away_in_the_winding_of_its_neighbour() {
    let positions = [p(0.0, 0.0), p(1.0, 0.0), p(0.4, 0.0), p(0.5, -1.0)];
    for cap in [[0, 1, 2], [2, 0, 1], [1, 0, 2]] {
        assert_eq!(sorted(without_caps(&positions, &[cap, [1, 0, 3]]).unwrap()), [[0, 3, 2], [1, 2, 3]]);
        assert_eq!(sorted(without_caps(&positions, &[[0, 1, 3], cap]).unwrap()), [[0, 2, 3], [1, 3, 2]]);
    }
}

#[test]
fn other_triangles_stay() {
    let square = [p(0.0, 0.0), p(1.0, 0.0), p(1.0, 1.0), p(0.0, 1.0)];
    assert_eq!(without_caps(&square, &[[0, 1, 2], [0, 2, 3]]), None);
    // A needle's short edge is no reason to flip; nor is a triangle that repeats a corner, or lies in one point.
    let needle = [p(0.0, 0.0), p(1.0, 0.0), p(0.0, 1e-5), p(0.5, -1.0)];
    assert_eq!(without_caps(&needle, &[[0, 1, 2], [1, 0, 3]]), None);
    assert_eq!(without_caps(&square, &[[0, 1, 1], [0, 1, 2]]), None);
    assert_eq!(without_caps(&[DVec3::ONE; 4], &[[0, 1, 2], [1, 0, 3]]), None);
    // Nothing lies beyond a cap at the border; a copy of it or a triangle that repeats a corner does not count.
    let cap = [p(0.0, 0.0), p(1.0, 0.0), p(0.4, 0.0), p(0.5, 1.0)];
    for beside in [[0, 2, 3], [1, 0, 2], [0, 1, 1]] {
        assert_eq!(without_caps(&cap, &[[0, 1, 2], beside]).unwrap(), [[0, 1, 2], beside]);
    }
}

#[test]
fn every_triangle_beyond_a_non_manifold_edge_is_split() {
    let wing = |angle: f64| DVec3::new(0.5, angle.cos(), angle.sin());
    let positions = [p(0.0, 0.0), p(1.0, 0.0), p(0.4, 0.0), wing(0.5), wing(2.5), wing(4.5)];
    let result = without_caps(&positions, &[[0, 1, 3], [0, 1, 4], [0, 2, 1], [5, 0, 1]]).unwrap();
    let wanted = [3, 4, 5].into_iter().flat_map(|k| [[0, 2, k], [1, k, 2]]).collect();
    assert_eq!(sorted(result), sorted(wanted));
}

/// A quarter of a polygon's border runs along one edge of a large triangle, over `count` points: the worst kind of
/// T-junction.
#[test]
fn many_points_on_one_edge_are_connected() {
    let mut random = Random::new(4);
    for round in 0..60 {
        // Points 0..=n on the line in order, then a corner on each side.
        let n = 2 + round % 20;
        let mut at: Vec<f64> = (0..n - 1).map(|_| 0.02 + 0.96 * random.unit()).chain([0.0, 1.0]).collect();
        at.sort_by(f64::total_cmp);
        // 32-bit coordinates off the axes: no three points are exactly on a line.
        let turned =
            |x: f64, y: f64| DVec3::new(10.0 + 0.6 * x - 0.8 * y, 0.8 * x + 0.6 * y, 0.3 * x).as_vec3().as_dvec3();
        let mut positions: Vec<DVec3> = at.iter().map(|&x| turned(x, 0.0)).collect();
        positions.extend([turned(0.4, -1.0), turned(0.6, 0.8)]);
        let (below, above) = (n + 1, n + 2);
        let mut triangles = vec![[n, 0, below]];
        triangles.extend((0..n).map(|k| [k, k + 1, above]));
        // Caps between: ears of the flat polygon 0..=n are cut off at random.
        let mut flat: Vec<u32> = (0..=n).collect();
        while flat.len() > 2 {
            let k = 1 + (random.unit() * (flat.len() - 2) as f64) as usize;
            triangles.push([flat[k - 1], flat[k + 1], flat[k]]);
            flat.remove(k);
        }
        let result = without_caps(&positions, &triangles).unwrap();
        let wanted = (0..n).flat_map(|k| [[k, k + 1, above], [k + 1, k, below]]).collect();
        assert_eq!(sorted(result), sorted(wanted), "{n} points");
    }
}

/// Sheets of cells where points were put on edges of one side only.
#[test]
fn sheets_with_t_junctions_become_conforming() {
    let mut random = Random::new(9);
    for _ in 0..40 {
        let (columns, rows) = (5, 5);
        let mut positions: Vec<DVec3> = (0..columns * rows)
            .map(|k| p(f64::from(k % columns), f64::from(k / columns)) + 0.2 * random.vector() * p(1.0, 1.0))
            .collect();
        let mut triangles: Vec<[u32; 3]> = Vec::new();
        for (j, i) in (0..rows - 1).flat_map(|j| (0..columns - 1).map(move |i| (j, i))) {
            let (a, c) = (j * columns + i, (j + 1) * columns + i);
            triangles.extend([[a, a + 1, c], [a + 1, c + 1, c]]);
        }
        let (whole, outline) = (area(&positions, &triangles), border(&triangles));
        for _ in 0..6 {
            // One side of an inner edge gets a point, a cap closes the gap.
            let k = (random.unit() * triangles.len() as f64) as usize;
            let [a, b, c] = triangles[k];
            if border(&triangles).contains(&[a.min(b), a.max(b)]) {
                continue;
            }
            let v = positions.len() as u32;
            positions.push(positions[a as usize].lerp(positions[b as usize], 0.2 + 0.6 * random.unit()));
            triangles[k] = [a, v, c];
            triangles.extend([[v, b, c], [a, b, v]]);
        }
        let result = without_caps(&positions, &triangles).unwrap_or(triangles);
        assert_eq!(without_caps(&positions, &result), None);
        assert!((area(&positions, &result) - whole).abs() < 1e-9);
        assert_eq!(border(&result), outline);
        assert!(sides(&result).values().all(|&n| n <= 2));
        // Consistently wound: all face +z.
        for t in &result {
            let [a, b, c] = t.map(|v| positions[v as usize]);
            assert!((b - a).cross(c - a).z > 0.0);
        }
    }
}

#[test]
fn any_soup_terminates() {
    let mut random = Random::new(6);
    for round in 0..300 {
        // Many points on few lines, so that caps have caps as neighbours.
        let positions: Vec<DVec3> = (0..12)
            .map(|k| p((8.0 * random.unit()).floor(), if round % 3 == 0 { 0.0 } else { f64::from(k % 3) }))
            .collect();
        let triangles: Vec<[u32; 3]> =
            (0..40).map(|_| std::array::from_fn(|_| (12.0 * random.unit()) as u32)).collect();
        if let Some(result) = without_caps(&positions, &triangles) {
            assert!(result.len() <= 9 * triangles.len());
            assert!(result.iter().flatten().all(|&v| v < 12));
            assert_eq!(without_caps(&positions, &triangles), Some(result));
        }
    }
}

#[test]
fn real_garments_have_none() {
    let Some(folder) = assets() else { return };
    for name in ["Puffer_dense", "jumpsuit_dense"] {
        let garment = read_mesh(&folder.join(format!("garments/{name}/garment.obj")));
        assert_eq!(without_caps(&garment.positions, &garment.triangles), None, "{name}");
    }
}
