//! Position term.

use bespoke::energy::position::{MovingAxis, Position};
use bespoke::energy::{Configuration, Energy};
use glam::DVec3;

use crate::harness::{check_gradient, check_hessian, check_semidefinite, dense};
use crate::patch::{rotation, shaken};
use testing::Random;

fn value(energy: &Position, x: &[DVec3], t: f64) -> f64 {
    energy.value(Configuration { x, t }, 0..energy.len())
}

/// Two axes that turn, move and grow between t = 0 and t = 1.
fn axes(random: &mut Random) -> Vec<MovingAxis> {
    let mut moving = |axis: DVec3| {
        let start = [random.vector(), random.vector() + 3.0 * axis];
        MovingAxis { start, end: start.map(|p| 1.4 * p + 0.5 * random.vector()) }
    };
    vec![moving(DVec3::X), moving(DVec3::Z)]
}

fn sample(random: &mut Random) -> (Vec<DVec3>, Position, Vec<MovingAxis>) {
    let rest: Vec<DVec3> = (0..6).map(|_| 2.0 * random.vector()).collect();
    let weights: Vec<f64> = rest.iter().map(|_| 0.1 + random.unit()).collect();
    let axes = axes(random);
    let constraints = [(0, 0), (1, 1), (3, 0), (3, 1), (5, 1)];
    let energy = Position::new(&rest, &constraints, axes.clone(), &weights);
    (rest, energy, axes)
}

#[test]
fn agrees_with_the_definition() {
    let mut random = Random::new(21);
    let moving = axes(&mut random)[0];
    let (rest, x, t) = ([random.vector()], [random.vector()], 0.35);
    let energy = Position::new(&rest, &[(0, 0)], vec![moving], &[0.7]);
    let coordinate = |p: DVec3, [a, b]: [DVec3; 2]| (p - a).dot(b - a) / (b - a).dot(b - a);
    let now = [0, 1].map(|k| (1.0 - t) * moving.start[k] + t * moving.end[k]);
    let expected = 0.7 * (coordinate(x[0], now) - coordinate(rest[0], moving.start)).powi(2);
    assert!((value(&energy, &x, t) - expected).abs() <= 1e-12 * expected);
}

#[test]
fn a_factor_multiplies_the_cost_of_its_constraint() {
    let mut random = Random::new(27);
    let rest: Vec<DVec3> = (0..2).map(|_| random.vector()).collect();
    let x = shaken(&rest, 0.5, &mut random);
    let axes = axes(&mut random);
    let of = |factors: [f64; 2]| {
        let constraints = [(0, 0, factors[0]), (1, 1, factors[1])];
        value(&Position::weighted(&rest, &constraints, axes.clone(), &[0.7, 0.4]), &x, 0.3)
    };
    let [first, second] = [of([1.0, 0.0]), of([0.0, 1.0])];
    assert!(first > 0.0 && second > 0.0);
    assert!((of([2.5, 0.1]) - (2.5 * first + 0.1 * second)).abs() < 1e-12);
    let plain = Position::new(&rest, &[(0, 0), (1, 1)], axes.clone(), &[0.7, 0.4]);
    assert_eq!(value(&plain, &x, 0.3), of([1.0, 1.0]));
}

#[test]
fn gradient_is_exact_and_hessian_semidefinite() {
    let mut random = Random::new(22);
    for _ in 0..10 {
        let (rest, energy, _) = sample(&mut random);
        let x = shaken(&rest, 0.5, &mut random);
        for t in [0.0, 0.4, 1.0] {
            check_gradient(&energy, &x, t, 1e-4, 1e-8);
            check_semidefinite(&energy, &x, t, &mut || random.signed());
        }
    }
}

#[test]
fn the_rest_shape_costs_nothing_and_its_hessian_is_exact() {
    let mut random = Random::new(23);
    let (rest, energy, _) = sample(&mut random);
    assert!(value(&energy, &rest, 0.0) < 1e-28);
    check_hessian(&energy, &rest, 0.0, 1e-4, 1e-8);
}

#[test]
fn moving_with_the_axis_costs_nothing() {
    let mut random = Random::new(24);
    for _ in 0..10 {
        let rest: Vec<DVec3> = (0..5).map(|_| random.vector()).collect();
        let start = [random.vector(), random.vector() + 3.0 * DVec3::X];
        let (turn, shift, scale) = (rotation(&mut random), random.vector(), 0.5 + random.unit());
        let carry = |p: DVec3| turn * (scale * p) + shift;
        let constraints: Vec<(u32, u32)> = (0..5).map(|v| (v, 0)).collect();
        let moving = MovingAxis { start, end: start.map(carry) };
        let energy = Position::new(&rest, &constraints, vec![moving], &[1.0; 5]);
        let carried: Vec<DVec3> = rest.iter().copied().map(carry).collect();
        assert!(value(&energy, &carried, 1.0) < 1e-24);
        // Motion across the axis costs nothing, along it it does.
        let axis = (moving.end[1] - moving.end[0]).normalize();
        let moved = |by: DVec3| carried.iter().map(|&p| p + by).collect::<Vec<_>>();
        assert!(value(&energy, &moved(axis.any_orthonormal_vector()), 1.0) < 1e-24);
        assert!(value(&energy, &moved(axis), 1.0) > 1e-2);
    }
}

#[test]
fn an_axis_without_length_is_ignored() {
    let point = [DVec3::ONE; 2];
    let rest = [DVec3::ZERO];
    let nothing = Position::new(&rest, &[(0, 0)], vec![MovingAxis { start: point, end: point }], &[1.0]);
    assert!(nothing.is_empty());
    // An axis that reverses has no length half-way.
    let start = [-DVec3::X, DVec3::X];
    let turned = Position::new(&rest, &[(0, 0)], vec![MovingAxis { start, end: [DVec3::X, -DVec3::X] }], &[1.0]);
    assert_eq!(value(&turned, &[DVec3::ONE], 0.5), 0.0);
    assert!(dense(&turned, &[DVec3::ONE], 0.5).gradient.iter().all(|&g| g == 0.0));
    assert!(value(&turned, &[DVec3::ONE], 0.4) > 0.0);
}
