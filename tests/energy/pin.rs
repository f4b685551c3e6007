//! Pin term.

use bespoke::energy::pin::{Pin, Pins};
use bespoke::energy::{Configuration, Energy};
use glam::DVec3;

use crate::harness::{check_gradient, check_hessian, check_semidefinite};
use testing::Random;

fn sample(random: &mut Random) -> (Vec<DVec3>, Pins) {
    let rest: Vec<DVec3> = (0..5).map(|_| 2.0 * random.vector()).collect();
    let pin = |(vertex, end)| Pin { vertex, start: rest[vertex as usize], end, weight: 1.0 };
    let pins = [0, 1, 4].map(|vertex| pin((vertex, 2.0 * random.vector())));
    (rest.clone(), Pins::new(pins.to_vec()))
}

fn value(energy: &Pins, x: &[DVec3], t: f64) -> f64 {
    energy.value(Configuration { x, t }, 0..energy.len())
}

#[test]
fn agrees_with_the_definition() {
    let mut random = Random::new(81);
    let (rest, energy) = sample(&mut random);
    assert_eq!(value(&energy, &rest, 0.0), 0.0);
    let mut there = rest.clone();
    for pin in energy.pins() {
        there[pin.vertex as usize] = pin.end;
    }
    assert_eq!(value(&energy, &there, 1.0), 0.0);
    let expected: f64 = energy
        .pins()
        .iter()
        .map(|pin| (rest[pin.vertex as usize] - (0.7 * pin.start + 0.3 * pin.end)).length_squared())
        .sum();
    assert!((value(&energy, &rest, 0.3) / expected - 1.0).abs() < 1e-12);
}

#[test]
fn derivatives_are_exact() {
    let mut random = Random::new(82);
    for t in [0.0, 0.4, 1.0] {
        let (rest, energy) = sample(&mut random);
        let x: Vec<DVec3> = rest.iter().map(|&p| p + random.vector()).collect();
        check_gradient(&energy, &x, t, 1e-3, 1e-9);
        // Quadratic, so that Gauss-Newton's Hessian is the whole one.
        check_hessian(&energy, &x, t, 1e-3, 1e-8);
        check_semidefinite(&energy, &x, t, &mut || random.signed());
    }
}
