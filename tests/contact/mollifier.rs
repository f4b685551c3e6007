use bespoke::contact::mollifier;
use glam::DVec3;

use crate::pairs::{SIZE, generic, nasty};
use testing::Random;

#[test]
fn is_one_beyond_the_threshold_and_zero_at_parallel() {
    let mut random = Random::new(1);
    let rest = generic(&mut random);
    let eps = mollifier::threshold(&rest);
    let lengths = (rest[1] - rest[0]).length() * (rest[3] - rest[2]).length();
    assert!((eps - 1e-3 * lengths * lengths).abs() < 1e-12 * eps);

    let u = SIZE * DVec3::X;
    // Edges of the rest lengths at an angle whose squared sine is 1e-3 sit exactly on the threshold.
    let at_sine = |sine: f64| {
        let v = SIZE * DVec3::new((1.0 - sine * sine).sqrt(), sine, 0.0);
        [DVec3::ZERO, u, DVec3::Z, DVec3::Z + v]
    };
    let eps = 1e-3 * SIZE.powi(4);
    assert_eq!(mollifier::value(&at_sine(1.0), eps), 1.0);
    assert_eq!(mollifier::value(&at_sine(0.0), eps), 0.0);
    assert!(mollifier::value_and_gradient(&at_sine(0.5), eps).1.is_none());
    let (below, above) = (1e-3_f64.sqrt() * (1.0 - 1e-6), 1e-3_f64.sqrt() * (1.0 + 1e-6));
    assert!((mollifier::value(&at_sine(below), eps) - 1.0).abs() < 1e-10);
    assert_eq!(mollifier::value(&at_sine(above), eps), 1.0);
    // m = (2 - c) c at a quarter of the threshold.
    assert!((mollifier::value(&at_sine(0.5 * 1e-3_f64.sqrt()), eps) - 0.4375).abs() < 1e-12);
}

#[test]
fn zero_rest_length_never_mollifies() {
    let mut random = Random::new(2);
    let mut rest = generic(&mut random);
    rest[1] = rest[0];
    let x = nasty(0, &mut random);
    assert_eq!(mollifier::value_and_gradient(&x, mollifier::threshold(&rest)), (1.0, None));
}

#[test]
fn gradient_is_the_derivative() {
    let mut random = Random::new(3);
    let h = 1e-5 * SIZE;
    let mut mollified = 0;
    for _ in 0..2000 {
        let place = random.vector();
        let u = SIZE * random.vector();
        let v = (0.5 + random.unit()) * u + 0.02 * SIZE * random.vector();
        let mut x = [place, place + u, place + 0.1 * random.vector(), DVec3::ZERO];
        x[3] = x[2] + v;
        let eps = mollifier::threshold(&x);
        let (m, gradient) = mollifier::value_and_gradient(&x, eps);
        assert_eq!(m, mollifier::value(&x, eps));
        let Some(gradient) = gradient else { continue };
        if m > 1.0 - 1e-4 {
            // The second derivative jumps at the threshold.
            continue;
        }
        mollified += 1;
        let scale = gradient.iter().fold(1.0 / SIZE, |s, g| s.max(g.length()));
        for i in 0..4 {
            for axis in 0..3 {
                let keep = x[i][axis];
                let mut at = |k: f64| {
                    x[i][axis] = keep + k * h;
                    mollifier::value(&x, eps)
                };
                let numeric = (8.0 * (at(1.0) - at(-1.0)) - (at(2.0) - at(-2.0))) / (12.0 * h);
                x[i][axis] = keep;
                assert!((numeric - gradient[i][axis]).abs() < 1e-5 * scale, "{numeric} {}", gradient[i][axis]);
            }
        }
    }
    assert!(mollified > 1000);
}
