//! Distortion of each triangle.

use bespoke::energy::distortion::distortion;
use glam::{DMat3, DVec3};

use crate::patch::{rotation, shaken, sheet, similar, triangles, tube};
use testing::Random;

fn area(x: &[DVec3], [a, b, c]: [u32; 3]) -> f64 {
    let [a, b, c] = [a, b, c].map(|v| x[v as usize]);
    0.5 * (b - a).cross(c - a).length()
}

/// The definition as written: every pair of triangles is tested, tau is a matrix.
fn by_definition(rest: &[DVec3], x: &[DVec3], triangles: &[[u32; 3]]) -> Vec<f64> {
    let frame = |p: &[DVec3], [i, j, k]: [u32; 3]| {
        let (e1, e2) = (p[j as usize] - p[i as usize], p[k as usize] - p[i as usize]);
        let n = e1.cross(e2);
        DMat3::from_cols(e1, e2, n / n.length().sqrt())
    };
    let apex = |t: [u32; 3], a: u32, b: u32| t.into_iter().find(|&v| v != a && v != b).unwrap();
    let total = |x: &[DVec3]| triangles.iter().map(|&t| area(x, t)).sum::<f64>();
    let growth = total(x) / total(rest);
    let of = |s: &[u32; 3]| {
        let mut values = Vec::new();
        for t in triangles.iter().filter(|&t| t != s) {
            let shared: Vec<u32> = s.iter().copied().filter(|v| t.contains(v)).collect();
            let [a, b] = shared[..] else { continue };
            // In the order in which `s` goes along the edge.
            let k = s.iter().position(|&v| v == a).unwrap();
            let (v1, v2) = if s[(k + 1) % 3] == b { (a, b) } else { (b, a) };
            let (v3, v4) = (apex(*s, a, b), apex(*t, a, b));
            let across = (rest[v4 as usize] - rest[v3 as usize]).normalize();
            let tau = |t| frame(x, t) * frame(rest, t).inverse() * across;
            values.push((tau([v1, v2, v3]) - tau([v2, v1, v4])).length_squared());
        }
        values.iter().sum::<f64>() / values.len() as f64 / growth
    };
    triangles.iter().map(of).collect()
}

#[test]
fn agrees_with_the_definition() {
    let mut random = Random::new(31);
    for (patch, triangles) in
        [(sheet(6, 5, &mut random), triangles(6, 5, false)), (tube(7, 4, &mut random), triangles(7, 4, true))]
    {
        for amount in [0.02, 0.3] {
            let x = shaken(&patch.rest, amount, &mut random);
            let (found, expected) =
                (distortion(&patch.rest, &x, &triangles), by_definition(&patch.rest, &x, &triangles));
            assert_eq!(found.len(), triangles.len());
            for (found, expected) in found.iter().zip(&expected) {
                assert!(*expected > 0.0 && (found - expected).abs() <= 1e-9 * expected, "{found} {expected}");
            }
        }
    }
}

#[test]
fn a_similarity_costs_nothing_and_units_do_not_count() {
    let mut random = Random::new(32);
    let (patch, triangles) = (tube(9, 6, &mut random), triangles(9, 6, true));
    for scale in [1e-3, 1.0, 250.0] {
        let x = similar(&patch.rest, scale, &mut random);
        assert!(distortion(&patch.rest, &x, &triangles).iter().all(|d| (0.0..1e-20).contains(d)));
    }
    let x = shaken(&patch.rest, 0.2, &mut random);
    let once = distortion(&patch.rest, &x, &triangles);
    let turn = rotation(&mut random);
    let elsewhere: Vec<DVec3> = x.iter().map(|&p| turn * (100.0 * p) + DVec3::splat(3.0)).collect();
    let small: Vec<DVec3> = patch.rest.iter().map(|&p| 0.01 * p).collect();
    for (one, other) in once.iter().zip(distortion(&small, &elsewhere, &triangles)) {
        assert!((one - other).abs() <= 1e-9 * one, "{one} {other}");
    }
}

/// Triangles far from the change keep their value, but for the ratio of areas.
#[test]
fn it_is_where_the_change_is() {
    let mut random = Random::new(33);
    let (patch, triangles) = (sheet(8, 6, &mut random), triangles(8, 6, false));
    let mut x = patch.rest.clone();
    x[0] += DVec3::new(-0.4, -0.3, 0.5);
    let at = distortion(&patch.rest, &x, &triangles);
    // A triangle's value changes with its own corners and those opposite to its edges.
    let touched = |t: &[u32; 3]| t.contains(&0);
    let near = |t: &[u32; 3]| {
        let beside = |s: &&[u32; 3]| s.iter().filter(|v| t.contains(v)).count() == 2;
        touched(t) || triangles.iter().filter(beside).any(touched)
    };
    for (t, value) in triangles.iter().zip(at) {
        assert_eq!(value > 1e-6, near(t), "triangle {t:?}: {value}");
    }
}

#[test]
fn what_has_no_shape_has_no_distortion() {
    let o = DVec3::ZERO;
    let rest = [o, DVec3::X, DVec3::Y, DVec3::new(1.0, 1.0, 0.0), DVec3::new(0.5, 0.0, 0.0)];
    let x = [o, 2.0 * DVec3::X, DVec3::Y, DVec3::new(1.0, 1.0, 0.7), DVec3::new(0.5, 0.0, 0.2)];
    // A flat triangle, one without neighbours that have a shape, one that repeats a corner.
    let values = distortion(&rest, &x, &[[0, 1, 2], [0, 4, 1], [3, 3, 2]]);
    assert_eq!(values, [0.0; 3]);
    assert_eq!(distortion(&rest, &[o; 5], &[[0, 1, 2], [1, 3, 2]]), [0.0; 2]);
    assert!(distortion(&rest, &x, &[[0, 1, 2], [1, 3, 2]]).iter().all(|&d| d > 0.0));
    assert_eq!(distortion(&[], &[], &[]), Vec::<f64>::new());
}
