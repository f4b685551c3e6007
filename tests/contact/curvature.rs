//! The curvature of the distance against second differences of the distance itself.

use bespoke::contact::PairType;
use bespoke::contact::curvature::{Bend, Form, bends};
use bespoke::contact::distance::Separation;
use glam::DVec3;
use testing::Random;

use crate::pairs::PAIR_TYPES;

type Pair = [DVec3; 4];

fn along(form: &Form, motion: &Pair) -> f64 {
    form.iter().zip(motion).map(|(a, v)| a.dot(*v)).sum()
}

/// Half the difference of the squared forms: what the rows say of the second derivative along `motion`.
fn from_rows(pair_type: PairType, x: &Pair, motion: &Pair) -> f64 {
    let rows = bends(pair_type, x, &pair_type.separation(x));
    let row = |bend: &Bend| along(&bend.opening, motion).powi(2) - along(&bend.closing, motion).powi(2);
    0.5 * rows.iter().flatten().map(row).sum::<f64>()
}

/// The second derivative of the distance along `motion`, by differences of fourth order.
fn from_differences(pair_type: PairType, x: &Pair, motion: &Pair, step: f64) -> f64 {
    let d = |k: f64| {
        let moved: Pair = std::array::from_fn(|i| x[i] + k * step * motion[i]);
        pair_type.separation(&moved).squared.sqrt()
    };
    (16.0 * (d(1.0) + d(-1.0)) - (d(2.0) + d(-2.0)) - 30.0 * d(0.0)) / (12.0 * step * step)
}

/// How many of the weights are not zero, and the smallest of these.
fn taking_part(separation: &Separation) -> (usize, f64) {
    let sizes = separation.weights.iter().map(|w| w.abs()).filter(|&w| w > 0.0);
    (sizes.clone().count(), sizes.fold(1.0, f64::min))
}

/// Pairs whose closest points stay in their feature under small motions, and that are far from parallel.
fn steady(random: &mut Random, mut visit: impl FnMut(PairType, &Pair, usize, &mut Random)) {
    for pair_type in PAIR_TYPES {
        for _ in 0..3000 {
            let x: Pair = std::array::from_fn(|_| random.vector());
            let separation = pair_type.separation(&x);
            let sides = match pair_type {
                PairType::PointTriangle => [x[2] - x[1], x[3] - x[1]],
                PairType::EdgeEdge => [x[1] - x[0], x[3] - x[2]],
            };
            let sine = sides[0].normalize().cross(sides[1].normalize()).length();
            let moved = |k: f64| {
                let aside = [DVec3::X, DVec3::Y, DVec3::Z, DVec3::ONE];
                let x: Pair = std::array::from_fn(|i| x[i] + k * 1e-3 * aside[i]);
                taking_part(&pair_type.separation(&x)).0
            };
            let (count, least) = taking_part(&separation);
            let is_steady = moved(1.0) == count && moved(-1.0) == count;
            if sine > 0.2 && least > 0.05 && is_steady && separation.squared.sqrt() > 0.05 {
                visit(pair_type, &x, count, random);
            }
        }
    }
}

#[test]
fn rows_are_the_second_derivative_where_both_parameters_are_free() {
    let (mut random, mut seen) = (Random::new(21), [0; 2]);
    steady(&mut random, |pair_type, x, count, random| {
        if count < 4 {
            return;
        }
        seen[pair_type as usize] += 1;
        let motion: Pair = std::array::from_fn(|_| random.vector());
        let (rows, differences) = (from_rows(pair_type, x, &motion), from_differences(pair_type, x, &motion, 1e-4));
        assert!(
            (rows - differences).abs() < 1e-4 * (1.0 + differences.abs()),
            "{pair_type:?} {x:?}: {rows} {differences}"
        );
    });
    assert!(seen.iter().all(|&n| n > 50), "{seen:?}");
}

#[test]
fn on_borders_the_distance_closes_no_faster_than_the_rows_say() {
    let (mut random, mut seen) = (Random::new(22), 0);
    steady(&mut random, |pair_type, x, count, random| {
        if count != 3 {
            return;
        }
        seen += 1;
        let motion: Pair = std::array::from_fn(|_| random.vector());
        let (rows, differences) = (from_rows(pair_type, x, &motion), from_differences(pair_type, x, &motion, 1e-4));
        assert!(differences >= rows - 1e-4 * (1.0 + rows.abs()), "{pair_type:?} {x:?}: {rows} {differences}");
    });
    assert!(seen > 50, "{seen}");
}

#[test]
fn points_have_no_rows() {
    let (mut random, mut seen) = (Random::new(23), 0);
    steady(&mut random, |pair_type, x, count, _| {
        if count == 2 {
            seen += 1;
            assert!(bends(pair_type, x, &pair_type.separation(x)).iter().all(Option::is_none));
        }
    });
    assert!(seen > 50, "{seen}");
}

#[test]
fn parallel_edges_have_none() {
    let x = [DVec3::ZERO, DVec3::X, DVec3::new(0.0, 0.0, 0.1), DVec3::new(1.0, 0.0, 0.1)];
    let inner = Separation { weights: [0.5, 0.5, -0.5, -0.5], vector: -0.1 * DVec3::Z, squared: 0.01 };
    assert!(bends(PairType::EdgeEdge, &x, &inner).iter().all(Option::is_none));
}
