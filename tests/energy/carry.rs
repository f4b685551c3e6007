//! Term of the carried pieces.

use bespoke::energy::pin::{Pin, Pins};
use bespoke::energy::{Configuration, Energy};
use glam::DVec3;

use crate::harness::{check_gradient, check_hessian, check_semidefinite};
use testing::Random;

fn sample(random: &mut Random) -> (Vec<DVec3>, Vec<Pin>) {
    let rest: Vec<DVec3> = (0..5).map(|_| 2.0 * random.vector()).collect();
    let carried = [0, 2, 3].map(|vertex: u32| Pin {
        vertex,
        start: rest[vertex as usize],
        end: 2.0 * random.vector(),
        weight: 0.1 + random.signed().abs(),
    });
    (rest, carried.to_vec())
}

#[test]
fn agrees_with_the_definition() {
    let mut random = Random::new(91);
    let (rest, carried) = sample(&mut random);
    let energy = Pins::carrying(carried.clone());
    let value = |x: &[DVec3], t: f64| energy.value(Configuration { x, t }, 0..energy.len());
    assert_eq!(value(&rest, 0.0), 0.0);
    let mut there = rest.clone();
    carried.iter().for_each(|k| there[k.vertex as usize] = k.end);
    assert_eq!(value(&there, 1.0), 0.0);
    let cost = |k: &Pin| k.weight * (rest[k.vertex as usize] - (0.7 * k.start + 0.3 * k.end)).length_squared();
    let expected: f64 = carried.iter().map(cost).sum();
    assert!((value(&rest, 0.3) / expected - 1.0).abs() < 1e-12);
}

#[test]
fn derivatives_are_exact() {
    let mut random = Random::new(92);
    for t in [0.0, 0.4, 1.0] {
        let (rest, carried) = sample(&mut random);
        let energy = Pins::carrying(carried);
        let x: Vec<DVec3> = rest.iter().map(|&p| p + random.vector()).collect();
        check_gradient(&energy, &x, t, 1e-3, 1e-9);
        // Quadratic, so that Gauss-Newton's Hessian is the whole one.
        check_hessian(&energy, &x, t, 1e-3, 1e-8);
        check_semidefinite(&energy, &x, t, &mut || random.signed());
    }
}
