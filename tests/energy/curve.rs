//! Curvature and torsion terms.

use bespoke::energy::curve::{Curvature, Polyline, Torsion};
use bespoke::energy::{Configuration, Energy};
use bespoke::geometry::mesh::BoundaryLoop;
use glam::DVec3;

use crate::harness::{check_gradient, check_hessian, check_semidefinite, dense};
use crate::patch::{shaken, similar};
use testing::Random;

fn value(energy: &dyn Energy, x: &[DVec3]) -> f64 {
    energy.value(Configuration { x, t: 0.0 }, 0..energy.len())
}

fn boundary(n: u32) -> BoundaryLoop {
    BoundaryLoop { vertices: (0..n).collect() }
}

/// An uneven ring of n vertices.
fn ring(n: u32, random: &mut Random) -> Vec<DVec3> {
    let at = |k: u32| {
        let angle = std::f64::consts::TAU * f64::from(k) / f64::from(n);
        DVec3::new(angle.cos(), angle.sin(), 0.0)
    };
    (0..n).map(|k| at(k) + 0.2 * random.vector()).collect()
}

/// The terms of section 3.4.5 as they are written, with the projection P: curvature, torsion.
fn by_definition(rest: &[DVec3], x: &[DVec3]) -> [f64; 2] {
    let n = rest.len();
    let project = |v: DVec3, w: DVec3| v - w.dot(v) * w;
    let edge = |p: &[DVec3], i: usize| p[(i + 1) % n] - p[i % n];
    let quantities = |p: &[DVec3], i: usize| {
        let [before, here, after] = [i + n - 1, i, i + 1].map(|k| edge(p, k).normalize());
        let (forth, back) = (project(after, here), project(-before, here));
        [-before.dot(here), forth.dot(back), forth.cross(back).dot(here)]
    };
    let mut sums = [0.0; 2];
    for i in 0..n {
        let w = 0.5 * (edge(rest, i + n - 1).length() + edge(rest, i).length());
        let (s, c) = (quantities(rest, i), quantities(x, i));
        sums[0] += w * (s[0] - c[0]).powi(2);
        sums[1] += w * ((s[1] - c[1]).powi(2) + (s[2] - c[2]).powi(2));
    }
    sums
}

#[test]
fn agree_with_the_definition() {
    let mut random = Random::new(11);
    for n in [3, 4, 5, 12] {
        let rest = ring(n, &mut random);
        let loops = [boundary(n)];
        let (curvature, torsion) = (Curvature::new(&rest, &loops, 0.0), Torsion::new(&rest, &loops, 0.0));
        assert_eq!((curvature.len(), torsion.len()), (n as usize, n as usize));
        for _ in 0..20 {
            let x = shaken(&rest, 0.5, &mut random);
            let [c, t] = by_definition(&rest, &x);
            assert!((value(&curvature, &x) - c).abs() <= 1e-12 * c);
            assert!((value(&torsion, &x) - t).abs() <= 1e-12 * t);
        }
    }
}

#[test]
fn gradients_are_exact_and_hessians_semidefinite() {
    let mut random = Random::new(12);
    for n in [3, 4, 9] {
        for scale in [1e-2, 1.0, 1e2] {
            let rest: Vec<DVec3> = ring(n, &mut random).iter().map(|&p| p * scale).collect();
            let loops = [boundary(n)];
            let x = shaken(&rest, 0.3 * scale, &mut random);
            for energy in [&Curvature::new(&rest, &loops, 0.0) as &dyn Energy, &Torsion::new(&rest, &loops, 0.0)] {
                check_gradient(energy, &x, 0.0, 1e-4 * scale, 1e-7);
                check_semidefinite(energy, &x, 0.0, &mut || random.signed());
            }
        }
    }
}

#[test]
fn hessians_are_exact_without_residual() {
    let mut random = Random::new(13);
    for n in [3, 4, 8] {
        let rest = ring(n, &mut random);
        let loops = [boundary(n)];
        for scale in [0.5, 1.0, 4.0] {
            let x = similar(&rest, scale, &mut random);
            check_hessian(&Curvature::new(&rest, &loops, 0.0), &x, 0.0, 1e-4, 1e-7);
            check_hessian(&Torsion::new(&rest, &loops, 0.0), &x, 0.0, 1e-4, 1e-7);
        }
    }
}

#[test]
fn similarities_cost_nothing_and_a_mirror_image_does() {
    let mut random = Random::new(14);
    let rest = ring(10, &mut random);
    let loops = [boundary(10)];
    let (curvature, torsion) = (Curvature::new(&rest, &loops, 0.0), Torsion::new(&rest, &loops, 0.0));
    for _ in 0..20 {
        let scale = 0.2 + 3.0 * random.unit();
        let x = similar(&rest, scale, &mut random);
        assert!(value(&curvature, &x) < 1e-20 && value(&torsion, &x) < 1e-20);
    }
    // Curvature and beta cannot tell a curve from its mirror image; gamma can.
    let mirrored: Vec<DVec3> = rest.iter().map(|p| DVec3::new(p.x, p.y, -p.z)).collect();
    assert!(value(&curvature, &mirrored) < 1e-20);
    assert!(value(&torsion, &mirrored) > 1e-2);
    // A circle must not become an ellipse freely.
    let stretched: Vec<DVec3> = rest.iter().map(|p| DVec3::new(2.0 * p.x, p.y, p.z)).collect();
    assert!(value(&curvature, &stretched) > 1e-2);
}

#[test]
fn open_curves_have_no_corner_at_their_ends() {
    let mut random = Random::new(15);
    let rest = ring(6, &mut random);
    let vertices: Vec<u32> = (0..6).collect();
    let open = |n: usize| [Polyline { vertices: &vertices[..n], closed: false, weight: 1.0 }];
    for (n, corners, twists) in [(0, 0, 0), (1, 0, 0), (2, 0, 0), (3, 1, 0), (4, 2, 1), (6, 4, 3)] {
        assert_eq!(
            (Curvature::new(&rest, open(n), 0.0).len(), Torsion::new(&rest, open(n), 0.0).len()),
            (corners, twists)
        );
    }
    let x = shaken(&rest, 0.3, &mut random);
    check_gradient(&Curvature::new(&rest, open(6), 0.0), &x, 0.0, 1e-4, 1e-7);
    check_gradient(&Torsion::new(&rest, open(6), 0.0), &x, 0.0, 1e-4, 1e-7);
}

#[test]
fn a_curve_costs_its_weight_times_as_much() {
    let mut random = Random::new(19);
    let rest = ring(12, &mut random);
    let x = shaken(&rest, 0.3, &mut random);
    let vertices: Vec<u32> = (0..12).collect();
    for (closed, chord) in [(true, 0.0), (false, 0.0), (true, 0.3), (false, 0.3)] {
        let curve = |weight: f64| [Polyline { vertices: &vertices, closed, weight }];
        let cost = |weight: f64| {
            let (curvature, torsion) =
                (Curvature::new(&rest, curve(weight), chord), Torsion::new(&rest, curve(weight), chord));
            [value(&curvature, &x), value(&torsion, &x)]
        };
        for (one, many) in cost(1.0).into_iter().zip(cost(3.5)) {
            assert!(one > 0.0 && (many - 3.5 * one).abs() < 1e-9 * many, "{one} {many}");
        }
    }
}

#[test]
fn short_and_degenerate_curves_are_left_out() {
    let mut random = Random::new(16);
    let mut rest = ring(6, &mut random);
    for n in 0..3 {
        assert_eq!(
            (Curvature::new(&rest, &[boundary(n)], 0.0).len(), Torsion::new(&rest, &[boundary(n)], 0.0).len()),
            (0, 0)
        );
    }
    // There and back again, and a triangle: whatever is left has distinct vertices.
    let loops = [BoundaryLoop { vertices: vec![0, 1, 0, 2] }, boundary(3)];
    let (curvature, torsion) = (Curvature::new(&rest, &loops, 0.0), Torsion::new(&rest, &loops, 0.0));
    assert_eq!((curvature.len(), torsion.len()), (5, 3));
    for energy in [&curvature as &dyn Energy, &torsion] {
        energy.stencils(&mut |v| {
            let mut distinct = v.to_vec();
            distinct.sort_unstable();
            distinct.dedup();
            assert_eq!(distinct.len(), v.len());
        });
    }
    // One rest edge without length removes the two corners at its ends, and the three torsion elements around it.
    rest[3] = rest[2];
    let loops = [boundary(6)];
    assert_eq!((Curvature::new(&rest, &loops, 0.0).len(), Torsion::new(&rest, &loops, 0.0).len()), (4, 3));
}

#[test]
fn a_collapsed_edge_gives_finite_derivatives() {
    let mut random = Random::new(17);
    let rest = ring(5, &mut random);
    let loops = [boundary(5)];
    for energy in [&Curvature::new(&rest, &loops, 0.0) as &dyn Energy, &Torsion::new(&rest, &loops, 0.0)] {
        for offset in [0.0, 1e-320, 1e-200, 1e-40] {
            let mut x = rest.clone();
            x[2] = x[1] + DVec3::X * offset;
            let d = dense(energy, &x, 0.0);
            assert!(value(energy, &x).is_finite());
            assert!(d.gradient.iter().chain(d.hessian.iter().flatten()).all(|v| v.is_finite()));
        }
    }
}

/// The point at `s` along a rest curve, as the vertices and their shares: by walking from edge to edge.
fn walked(rest: &[DVec3], closed: bool, s: f64) -> Vec<(usize, f64)> {
    let n = rest.len();
    let mut left = s;
    for k in 0.. {
        let (a, b) = (k % n, (k + 1) % n);
        let length = rest[a].distance(rest[b]);
        let is_last = !closed && k + 2 == n;
        if left <= length || is_last {
            return vec![(a, 1.0 - left / length), (b, left / length)];
        }
        left -= length;
    }
    unreachable!()
}

/// Both terms on points `chord` apart, as an integral over densely spread starts.
fn by_integration(rest: &[DVec3], x: &[DVec3], closed: bool, chord: f64) -> [f64; 2] {
    let n = rest.len();
    let length: f64 = (0..if closed { n } else { n - 1 }).map(|k| rest[k].distance(rest[(k + 1) % n])).sum();
    let project = |v: DVec3, w: DVec3| v - w.dot(v) * w;
    let quantities = |p: &[DVec3], s: f64, count: usize| {
        let points: Vec<DVec3> = (0..count)
            .map(|k| walked(rest, closed, s + k as f64 * chord).into_iter().map(|(v, share)| share * p[v]).sum())
            .collect();
        let e: Vec<DVec3> = points.windows(2).map(|w| (w[1] - w[0]).normalize()).collect();
        if count == 3 {
            return [-e[0].dot(e[1]), 0.0];
        }
        let (forth, back) = (project(e[2], e[1]), project(-e[0], e[1]));
        [forth.dot(back), forth.cross(back).dot(e[1])]
    };
    [3, 4].map(|count| {
        let last = if closed { length } else { length - (count - 1) as f64 * chord };
        let steps = 20_000;
        let step = last / f64::from(steps);
        (0..steps)
            .map(|k| {
                let s = (f64::from(k) + 0.5) * step;
                let [a, b] = [quantities(rest, s, count), quantities(x, s, count)];
                step * ((a[0] - b[0]).powi(2) + (a[1] - b[1]).powi(2))
            })
            .sum()
    })
}

/// A V with a round back in a plane, n uneven edges; and the same opened, its sides and back bent out of the plane.
fn neckline(n: u32, open: f64) -> Vec<DVec3> {
    let at = |k: u32| {
        // Uneven: edges differ by up to a factor of two.
        let u = f64::from(k) / f64::from(n);
        let u = u + 0.05 * (std::f64::consts::TAU * 3.0 * u).sin();
        let flat = match u {
            _ if u < 0.3 => DVec3::new(u / 0.3 * 0.15, u / 0.3 * 0.34, 0.0),
            _ if u > 0.7 => DVec3::new((u - 1.0) / 0.3 * 0.15, (1.0 - u) / 0.3 * 0.34, 0.0),
            _ => {
                let angle = std::f64::consts::PI * (u - 0.3) / 0.4;
                DVec3::new(0.15 * angle.cos(), 0.34 + 0.1 * angle.sin(), 0.0)
            }
        };
        let bent = open * (flat.y / 0.34).powi(2);
        DVec3::new(flat.x * (1.0 + bent), flat.y, 0.2 * bent * (6.0 * flat.y).sin())
    };
    (0..n).map(at).collect()
}

#[test]
fn chords_agree_with_the_integral() {
    for closed in [true, false] {
        let (rest, x) = (neckline(160, 0.0), neckline(160, 0.6));
        let vertices: Vec<u32> = (0..160).collect();
        let curve = [Polyline { vertices: &vertices, closed, weight: 1.0 }];
        let [c, t] = by_integration(&rest, &x, closed, 0.06);
        let (curvature, torsion) = (Curvature::new(&rest, curve, 0.06), Torsion::new(&rest, curve, 0.06));
        assert!((value(&curvature, &x) / c - 1.0).abs() < 0.02, "{} {c}", value(&curvature, &x));
        assert!((value(&torsion, &x) / t - 1.0).abs() < 0.02, "{} {t}", value(&torsion, &x));
    }
}

#[test]
fn chords_cost_the_same_at_every_resolution() {
    let cost = |n: u32, chord: f64| {
        let (rest, x) = (neckline(n, 0.0), neckline(n, 0.6));
        let loops = [boundary(n)];
        [value(&Curvature::new(&rest, &loops, chord), &x), value(&Torsion::new(&rest, &loops, chord), &x)]
    };
    // From edges of a third of a chord to a sixteenth of that. Of longer ones the curve itself is another.
    let costs = [48, 96, 192, 768].map(|n| cost(n, 0.08));
    for term in 0..2 {
        let [least, most] = [f64::min, f64::max].map(|of| costs.iter().map(|c| c[term]).reduce(of).unwrap());
        assert!(most < 1.1 * least, "{term}: {costs:?}");
    }
    // As printed the cost of such a bend vanishes.
    assert!(cost(768, 0.0)[0] < 0.02 * cost(48, 0.0)[0]);
}

#[test]
fn chords_have_exact_derivatives_and_cost_similarities_nothing() {
    let mut random = Random::new(18);
    for (n, closed) in [(3, true), (5, true), (14, true), (40, true), (14, false)] {
        for scale in [1e-2, 1.0, 1e2] {
            let rest: Vec<DVec3> = ring(n, &mut random).iter().map(|&p| p * scale).collect();
            let vertices: Vec<u32> = (0..n).collect();
            let curve = [Polyline { vertices: &vertices, closed, weight: 1.0 }];
            let x = shaken(&rest, 0.1 * scale, &mut random);
            let alike = similar(&rest, 3.0, &mut random);
            for chord in [0.2 * scale, 0.7 * scale] {
                let terms = [&Curvature::new(&rest, curve, chord) as &dyn Energy, &Torsion::new(&rest, curve, chord)];
                for energy in terms {
                    assert!(!energy.is_empty());
                    check_gradient(energy, &x, 0.0, 1e-5 * scale, 1e-6);
                    check_semidefinite(energy, &x, 0.0, &mut || random.signed());
                    assert!(value(energy, &alike) < 1e-18 * scale);
                    energy.stencils(&mut |v| {
                        let distinct: std::collections::BTreeSet<_> = v.iter().collect();
                        assert_eq!(distinct.len(), v.len());
                    });
                }
            }
        }
    }
    let rest = ring(14, &mut random);
    let loops = [boundary(14)];
    let x = similar(&rest, 2.0, &mut random);
    check_hessian(&Curvature::new(&rest, &loops, 0.7), &x, 0.0, 1e-4, 1e-6);
    check_hessian(&Torsion::new(&rest, &loops, 0.7), &x, 0.0, 1e-4, 1e-6);
}

#[test]
fn chords_far_shorter_than_the_edges_cost_no_memory() {
    let mut random = Random::new(20);
    let rest = ring(12, &mut random);
    let loops = [boundary(12)];
    for chord in [1e-3, 1e-12, f64::MIN_POSITIVE] {
        let (curvature, torsion) = (Curvature::new(&rest, &loops, chord), Torsion::new(&rest, &loops, chord));
        assert!(curvature.len() <= 12 * 32 && torsion.len() <= 12 * 32);
        let x = shaken(&rest, 0.1, &mut random);
        assert!(value(&curvature, &x).is_finite() && value(&torsion, &x).is_finite());
    }
}

/// Both sides of a slit without width, up to rounding: directions between points that coincide would be noise, and stiff.
#[test]
fn chords_leave_out_where_a_curve_turns_back_on_itself() {
    let mut random = Random::new(21);
    let n = 12;
    let there = |k: u32| DVec3::new(0.1 * f64::from(k), 0.3, 0.7) + 1e-16 * random.vector();
    let mut rest: Vec<DVec3> = (0..=n).map(there).collect();
    rest.extend((1..n).rev().map(|k| DVec3::new(0.1 * f64::from(k) + 0.05, 0.3, 0.7)));
    let loops = [boundary(rest.len() as u32)];
    for energy in [&Curvature::new(&rest, &loops, 0.05) as &dyn Energy, &Torsion::new(&rest, &loops, 0.05)] {
        assert!(!energy.is_empty());
        let stiffest = dense(energy, &rest, 0.0).hessian.iter().flatten().fold(0.0_f64, |most, v| most.max(v.abs()));
        assert!(stiffest < 1e10, "{stiffest:e}");
    }
}

#[test]
fn chords_on_degenerate_curves_are_finite() {
    let mut random = Random::new(19);
    let mut rest = ring(12, &mut random);
    // Edges without length, a curve of one point, and one that goes there and back.
    rest[3] = rest[2];
    rest[11] = rest[0];
    let points = vec![DVec3::ONE; 12];
    for (rest, vertices) in
        [(&rest, (0..12).collect::<Vec<u32>>()), (&points, (0..12).collect()), (&rest, vec![0, 5, 7, 5])]
    {
        for closed in [true, false] {
            let curve = [Polyline { vertices: &vertices, closed, weight: 1.0 }];
            for energy in [&Curvature::new(rest, curve, 0.3) as &dyn Energy, &Torsion::new(rest, curve, 0.3)] {
                let d = dense(energy, rest, 0.0);
                assert!(value(energy, rest) < 1e-20);
                assert!(d.gradient.iter().chain(d.hessian.iter().flatten()).all(|v| v.is_finite()));
            }
        }
    }
}
