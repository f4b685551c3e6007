//! The similarity between two sets of points.

use bespoke::geometry::alignment::Similarity;
use glam::{DQuat, DVec3};
use testing::Random;

fn points(random: &mut Random) -> (Vec<DVec3>, Vec<f64>) {
    let points = (0..12).map(|_| random.vector()).collect();
    (points, (0..12).map(|_| 0.1 + random.signed().abs()).collect())
}

#[test]
fn a_similarity_is_found_however_far_it_turns() {
    let mut random = Random::new(1);
    for round in 0..50 {
        let (from, weights) = points(&mut random);
        let turn = DQuat::from_scaled_axis(random.vector().normalize() * 0.06 * f64::from(round));
        let (scale, shift) = (0.3 + 0.1 * f64::from(round % 9), 3.0 * random.vector());
        let to: Vec<DVec3> = from.iter().map(|&p| shift + scale * (turn * p)).collect();
        let found = Similarity::nearest(&from, &to, &weights, None);
        assert!((found.scale / scale - 1.0).abs() < 1e-9, "{round} {}", found.scale);
        for (&p, q) in from.iter().zip(&to) {
            assert!(found.apply(p).distance(*q) < 1e-9, "{round}");
        }
    }
}

/// Nothing near it is better: the twin is a search around it.
#[test]
fn no_similarity_beside_it_is_nearer() {
    let mut random = Random::new(2);
    for fixed in [None, Some(0.8)] {
        let (from, weights) = points(&mut random);
        let to: Vec<DVec3> = from.iter().map(|&p| 0.9 * p + 0.2 * random.vector()).collect();
        let best = Similarity::nearest(&from, &to, &weights, fixed);
        let cost = |s: &Similarity| -> f64 {
            (0..from.len()).map(|k| weights[k] * s.apply(from[k]).distance_squared(to[k])).sum()
        };
        for _ in 0..300 {
            let mut other = best;
            other.to += 0.01 * random.vector();
            other.rotation = DQuat::from_scaled_axis(0.02 * random.vector()) * best.rotation;
            if fixed.is_none() {
                other.scale *= 1.0 + 0.02 * random.signed();
            }
            assert!(cost(&other) >= cost(&best) - 1e-12);
        }
    }
}

#[test]
fn one_point_and_none_only_move() {
    let one = Similarity::nearest(&[DVec3::X], &[DVec3::Y], &[2.0], None);
    assert_eq!((one.apply(DVec3::X), one.scale, one.rotation), (DVec3::Y, 1.0, DQuat::IDENTITY));
    let none = Similarity::nearest(&[], &[], &[], None);
    assert_eq!(none.apply(DVec3::Z), DVec3::Z);
}
