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
        let (curvature, torsion) = (Curvature::new(&rest, &loops), Torsion::new(&rest, &loops));
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
            for energy in [&Curvature::new(&rest, &loops) as &dyn Energy, &Torsion::new(&rest, &loops)] {
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
            check_hessian(&Curvature::new(&rest, &loops), &x, 0.0, 1e-4, 1e-7);
            check_hessian(&Torsion::new(&rest, &loops), &x, 0.0, 1e-4, 1e-7);
        }
    }
}

#[test]
fn similarities_cost_nothing_and_a_mirror_image_does() {
    let mut random = Random::new(14);
    let rest = ring(10, &mut random);
    let loops = [boundary(10)];
    let (curvature, torsion) = (Curvature::new(&rest, &loops), Torsion::new(&rest, &loops));
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
    let open = |n: usize| [Polyline { vertices: &vertices[..n], closed: false }];
    for (n, corners, twists) in [(0, 0, 0), (1, 0, 0), (2, 0, 0), (3, 1, 0), (4, 2, 1), (6, 4, 3)] {
        assert_eq!((Curvature::new(&rest, open(n)).len(), Torsion::new(&rest, open(n)).len()), (corners, twists));
    }
    let x = shaken(&rest, 0.3, &mut random);
    check_gradient(&Curvature::new(&rest, open(6)), &x, 0.0, 1e-4, 1e-7);
    check_gradient(&Torsion::new(&rest, open(6)), &x, 0.0, 1e-4, 1e-7);
}

#[test]
fn short_and_degenerate_curves_are_left_out() {
    let mut random = Random::new(16);
    let mut rest = ring(6, &mut random);
    for n in 0..3 {
        assert_eq!((Curvature::new(&rest, &[boundary(n)]).len(), Torsion::new(&rest, &[boundary(n)]).len()), (0, 0));
    }
    // There and back again, and a triangle: whatever is left has distinct vertices.
    let loops = [BoundaryLoop { vertices: vec![0, 1, 0, 2] }, boundary(3)];
    let (curvature, torsion) = (Curvature::new(&rest, &loops), Torsion::new(&rest, &loops));
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
    assert_eq!((Curvature::new(&rest, &loops).len(), Torsion::new(&rest, &loops).len()), (4, 3));
}

#[test]
fn a_collapsed_edge_gives_finite_derivatives() {
    let mut random = Random::new(17);
    let rest = ring(5, &mut random);
    let loops = [boundary(5)];
    for energy in [&Curvature::new(&rest, &loops) as &dyn Energy, &Torsion::new(&rest, &loops)] {
        for offset in [0.0, 1e-320, 1e-200, 1e-40] {
            let mut x = rest.clone();
            x[2] = x[1] + DVec3::X * offset;
            let d = dense(energy, &x, 0.0);
            assert!(value(energy, &x).is_finite());
            assert!(d.gradient.iter().chain(d.hessian.iter().flatten()).all(|v| v.is_finite()));
        }
    }
}
