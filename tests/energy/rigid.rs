//! Rigid groups: what costs nothing, derivatives, and the rigid motion nearest to a bent group.

use bespoke::energy::rigid::Rigid;
use bespoke::energy::{Configuration, Energy};
use glam::DVec3;

use crate::harness::{check_gradient, check_hessian, check_semidefinite};
use crate::patch::{rotation, shaken};
use testing::Random;

fn value(energy: &Rigid, x: &[DVec3]) -> f64 {
    energy.value(Configuration { x, t: 0.5 }, 0..energy.len())
}

/// A cloud, a flat disc, a rod, a pair, a single vertex, and three vertices of no group.
fn sample(random: &mut Random) -> (Vec<DVec3>, Vec<Vec<u32>>) {
    let mut rest = Vec::new();
    let mut groups = Vec::new();
    let mut add = |points: Vec<DVec3>| {
        let first = rest.len() as u32;
        groups.push((first..first + points.len() as u32).collect());
        rest.extend(points);
    };
    add((0..7).map(|_| random.vector()).collect());
    let disc = |k: u32| {
        let angle = f64::from(k) * std::f64::consts::TAU / 6.0;
        DVec3::new(3.0 + 0.2 * angle.cos(), 0.2 * angle.sin(), 0.5)
    };
    add((0..6).map(disc).collect());
    add((0..4).map(|k| DVec3::new(-2.0, 0.3 * f64::from(k), 0.1 * f64::from(k))).collect());
    add(vec![DVec3::new(0.0, 4.0, 0.0), DVec3::new(0.1, 4.2, 0.0)]);
    add(vec![DVec3::new(0.0, -4.0, 0.0)]);
    rest.extend((0..3).map(|_| 5.0 * random.vector()));
    (rest, groups)
}

/// Each group under a rigid motion of its own.
fn moved(rest: &[DVec3], groups: &[Vec<u32>], random: &mut Random) -> Vec<DVec3> {
    let mut x: Vec<DVec3> = rest.iter().map(|&p| p + random.vector()).collect();
    for group in groups {
        let (turn, shift) = (rotation(random), 3.0 * random.vector());
        group.iter().for_each(|&v| x[v as usize] = turn * rest[v as usize] + shift);
    }
    x
}

#[test]
fn rigid_motions_cost_nothing_and_all_else_does() {
    let mut random = Random::new(91);
    let (rest, groups) = sample(&mut random);
    let energy = Rigid::new(&rest, &groups);
    let x = moved(&rest, &groups, &mut random);
    assert!(value(&energy, &rest) < 1e-24 && value(&energy, &x) < 1e-24, "{}", value(&energy, &x));
    // Any single vertex of a group of two or more, and the size of a group.
    for &v in groups.iter().filter(|g| g.len() > 1).flatten() {
        let mut bent = x.clone();
        bent[v as usize] += DVec3::new(0.01, -0.02, 0.03);
        assert!(value(&energy, &bent) > 1e-6, "vertex {v}");
    }
    let grown: Vec<DVec3> = x.iter().map(|p| 1.1 * *p).collect();
    assert!(value(&energy, &grown) > 1e-3);
    // Vertices of no group, and a group of one, are free.
    let mut others = x.clone();
    for p in &mut others[groups[4][0] as usize..] {
        *p += random.vector();
    }
    assert_eq!(value(&energy, &others), value(&energy, &x));
}

#[test]
fn derivatives_agree_with_finite_differences() {
    let mut random = Random::new(92);
    for _ in 0..5 {
        let (rest, groups) = sample(&mut random);
        let energy = Rigid::new(&rest, &groups);
        let still = moved(&rest, &groups, &mut random);
        check_hessian(&energy, &still, 0.0, 1e-5, 1e-6);
        let x = shaken(&still, 0.05, &mut random);
        check_gradient(&energy, &x, 0.0, 1e-5, 1e-8);
        check_semidefinite(&energy, &x, 0.0, &mut || random.signed());
    }
}

#[test]
fn the_motion_nearest_to_a_bent_group_is_rigid_and_near() {
    let mut random = Random::new(93);
    let (rest, groups) = sample(&mut random);
    let energy = Rigid::new(&rest, &groups);
    let still = moved(&rest, &groups, &mut random);
    let x = shaken(&still, 1e-3, &mut random);
    let placed: Vec<Vec<(u32, DVec3)>> = energy.placed(&x).collect();
    assert_eq!(placed.len(), groups.len());
    for (group, places) in groups.iter().zip(&placed) {
        assert!(places.iter().map(|p| p.0).eq(group.iter().copied()));
        for &(v, p) in places {
            assert!(p.distance(x[v as usize]) < 2e-2, "vertex {v} is {} away", p.distance(x[v as usize]));
            for &(w, q) in places {
                let [now, was] = [p.distance(q), rest[v as usize].distance(rest[w as usize])];
                assert!((now - was).abs() < 1e-12, "vertices {v} and {w}: {now} instead of {was}");
            }
        }
        // Orientation as well: no mirror image.
        if let [a, b, c, d, ..] = places[..] {
            let volume = |p: [DVec3; 4]| (p[1] - p[0]).dot((p[2] - p[0]).cross(p[3] - p[0]));
            let was = volume([a, b, c, d].map(|(v, _)| rest[v as usize]));
            assert!((volume([a, b, c, d].map(|p| p.1)) - was).abs() < 1e-12);
        }
    }
}
