use bespoke::contact::PairType;
use bespoke::contact::distance::Separation;
use glam::DVec3;

use crate::pairs::{FORMS, PAIR_TYPES, SIZE, generic, interior, nasty};
use testing::Random;

/// Squared distance of `p` from the segment.
fn point_segment(p: DVec3, a: DVec3, b: DVec3) -> f64 {
    let u = b - a;
    let s = if u == DVec3::ZERO { 0.0 } else { ((p - a).dot(u) / u.dot(u)).clamp(0.0, 1.0) };
    (p - (a + s * u)).length_squared()
}

/// Squared distance by ternary search over a family of segments or points: a convex function of one parameter.
pub fn searched(pair_type: PairType, x: &[DVec3; 4]) -> f64 {
    let at = |s: f64| match pair_type {
        PairType::PointTriangle => point_segment(x[0], x[1].lerp(x[2], s), x[1].lerp(x[3], s)),
        PairType::EdgeEdge => point_segment(x[0].lerp(x[1], s), x[2], x[3]),
    };
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..90 {
        let (a, b) = (low + (high - low) / 3.0, high - (high - low) / 3.0);
        if at(a) <= at(b) { high = b } else { low = a }
    }
    at(low).min(at(high)).min(at(0.0)).min(at(1.0))
}

/// The largest lower bound on the distance that the separation proves by itself: the gap between the projections onto
/// its direction. Relative to the distance it claims.
fn proven(pair_type: PairType, x: &[DVec3; 4], separation: &Separation) -> f64 {
    let first = pair_type.first_count();
    let mut least = f64::INFINITY;
    for i in 0..first {
        for j in first..4 {
            least = least.min(separation.vector.dot(x[i] - x[j]));
        }
    }
    least / separation.squared
}

/// The weights describe one point of each primitive, and r is the vector between them.
fn check_consistent(pair_type: PairType, x: &[DVec3; 4], s: &Separation) {
    let first = pair_type.first_count();
    assert!(s.squared.is_finite() && s.vector.is_finite());
    assert!((s.weights[..first].iter().sum::<f64>() - 1.0).abs() < 1e-14);
    assert!((s.weights[first..].iter().sum::<f64>() + 1.0).abs() < 1e-14);
    for (i, &w) in s.weights.iter().enumerate() {
        let barycentric = if i < first { w } else { -w };
        assert!((-1e-15..=1.0 + 1e-15).contains(&barycentric), "{pair_type:?} {x:?} {s:?}");
    }
    let r: DVec3 = (0..4).map(|i| s.weights[i] * (x[i] - x[1])).sum();
    assert!((r - s.vector).length() < 1e-15 * (1.0 + SIZE), "{pair_type:?} {x:?} {s:?}");
    assert_eq!(s.squared, s.vector.length_squared());
}

#[test]
fn generic_pairs_are_exact_by_duality() {
    let mut random = Random::new(1);
    for pair_type in PAIR_TYPES {
        for _ in 0..20_000 {
            let x = generic(&mut random);
            let s = pair_type.separation(&x);
            check_consistent(pair_type, &x, &s);
            if s.squared > 1e-8 {
                assert!(proven(pair_type, &x, &s) > 1.0 - 1e-10, "{pair_type:?} {x:?} {s:?}");
            }
            let other = searched(pair_type, &x);
            assert!((s.squared - other).abs() <= 1e-12 * SIZE * SIZE, "{pair_type:?} {x:?} {} {other}", s.squared);
        }
    }
}

#[test]
fn small_gaps_keep_their_digits() {
    let mut random = Random::new(2);
    for pair_type in PAIR_TYPES {
        for k in 0..4000 {
            let gap = 10f64.powi(-2 - k % 6);
            let x = interior(pair_type, gap, &mut random);
            let u = if pair_type == PairType::PointTriangle { x[2] - x[1] } else { x[1] - x[0] };
            let v = if pair_type == PairType::PointTriangle { x[3] - x[1] } else { x[3] - x[2] };
            if u.cross(v).length() < 0.05 * u.length() * v.length() {
                continue;
            }
            let s = pair_type.separation(&x);
            // The construction rounds the coordinates, about 1 in size, in the direction of the gap.
            assert!(
                (s.squared.sqrt() - gap).abs() < 1e-15 + 1e-12 * gap,
                "{pair_type:?} {gap:e} {:e}",
                s.squared.sqrt()
            );
            // What rounding of r in its last digit does to the proof, with the primitive as the lever.
            let lever = 1e-14 * (SIZE / gap).powi(2);
            assert!(
                proven(pair_type, &x, &s) > 1.0 - lever - 1e-10,
                "{pair_type:?} {gap:e} {}",
                proven(pair_type, &x, &s)
            );
        }
    }
}

#[test]
fn nasty_pairs_agree_with_the_search() {
    let mut random = Random::new(3);
    let mut worst = 0.0_f64;
    for pair_type in PAIR_TYPES {
        for form in 0..FORMS {
            for _ in 0..4000 {
                let x = nasty(form, &mut random);
                let s = pair_type.separation(&x);
                check_consistent(pair_type, &x, &s);
                let other = searched(pair_type, &x);
                let error = (s.squared - other).abs() / (SIZE * SIZE);
                worst = worst.max(error);
                assert!(error <= 1e-12, "{pair_type:?} form {form} {x:?} {:e} {other:e}", s.squared);
                // Relative, where there is a distance to speak of.
                if other > 1e-10 {
                    let ratio = s.squared / other;
                    assert!((ratio - 1.0).abs() < 1e-8, "{pair_type:?} form {form} {x:?} {ratio}");
                }
            }
        }
    }
    assert!(worst < 1e-12);
}

#[test]
fn exactly_known_distances() {
    let p = DVec3::new;
    let cases = [
        // Above the face, beyond an edge, beyond a corner.
        (PairType::PointTriangle, [p(0.2, 0.2, 0.5), p(0., 0., 0.), p(1., 0., 0.), p(0., 1., 0.)], 0.25),
        (PairType::PointTriangle, [p(0.5, -2., 0.), p(0., 0., 0.), p(1., 0., 0.), p(0., 1., 0.)], 4.0),
        (PairType::PointTriangle, [p(4., -4., 0.), p(0., 0., 0.), p(1., 0., 0.), p(0., 1., 0.)], 25.0),
        (PairType::PointTriangle, [p(1., 1., 0.), p(0., 0., 0.), p(1., 0., 0.), p(0., 1., 0.)], 0.5),
        // Crossing, parallel side by side, parallel apart, two points.
        (PairType::EdgeEdge, [p(-1., 0., 1.), p(1., 0., 1.), p(0., -1., 0.), p(0., 1., 0.)], 1.0),
        (PairType::EdgeEdge, [p(0., 0., 0.), p(2., 0., 0.), p(1., 3., 0.), p(5., 3., 0.)], 9.0),
        (PairType::EdgeEdge, [p(0., 0., 0.), p(1., 0., 0.), p(4., 4., 0.), p(6., 4., 0.)], 25.0),
        (PairType::EdgeEdge, [p(1., 1., 1.), p(1., 1., 1.), p(1., 1., 3.), p(1., 1., 3.)], 4.0),
    ];
    for (pair_type, x, squared) in cases {
        assert!((pair_type.separation(&x).squared - squared).abs() < 1e-14, "{pair_type:?} {x:?}");
    }
}

#[test]
fn denormal_sizes_give_no_nan() {
    let mut random = Random::new(4);
    for pair_type in PAIR_TYPES {
        for k in 0..2000 {
            let scale = 10f64.powi(-60 - k % 260);
            let x: [DVec3; 4] = std::array::from_fn(|_| scale * random.vector());
            let s = pair_type.separation(&x);
            assert!(s.squared.is_finite() && s.weights.iter().all(|w| w.is_finite()), "{pair_type:?} {x:?} {s:?}");
        }
    }
}

#[test]
fn twice_weight_times_vector_is_the_gradient() {
    let mut random = Random::new(5);
    let h = 1e-4 * SIZE;
    for pair_type in PAIR_TYPES {
        for _ in 0..2000 {
            let mut x = generic(&mut random).map(|p| p - p.round());
            let s = pair_type.separation(&x);
            for i in 0..4 {
                for axis in 0..3 {
                    let keep = x[i][axis];
                    let mut at = |k: f64| {
                        x[i][axis] = keep + k * h;
                        pair_type.separation(&x).squared
                    };
                    let numeric = (at(1.0) - at(-1.0)) / (2.0 * h);
                    x[i][axis] = keep;
                    // Where the closest feature changes within h, the second derivative jumps.
                    let analytic = 2.0 * s.weights[i] * s.vector[axis];
                    assert!((numeric - analytic).abs() < 10.0 * h, "{pair_type:?} {x:?} {numeric} {analytic}");
                }
            }
        }
    }
}

#[test]
fn boxes_that_are_apart_prove_the_distance() {
    let mut random = Random::new(6);
    let (mut apart, mut close) = (0, 0);
    for pair_type in PAIR_TYPES {
        for _ in 0..5000 {
            let x = generic(&mut random);
            let gap = SIZE * random.unit();
            if pair_type.is_beyond(&x, gap) {
                assert!(pair_type.separation(&x).squared > gap * gap);
                apart += 1;
            } else {
                close += 1;
            }
        }
    }
    assert!(apart > 500 && close > 500);
}
