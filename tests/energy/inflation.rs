//! Augmented Lagrangian on t.

use bespoke::energy::inflation::Inflation;
use bespoke::energy::{Configuration, Energy};

use crate::harness::{check_gradient, check_hessian, dense};

#[test]
fn derivatives_are_exact() {
    let mut energy = Inflation::new(3.0, -0.5);
    for t in [0.0, 0.3, 1.0] {
        check_gradient(&energy, &[], t, 1e-3, 1e-9);
        check_hessian(&energy, &[], t, 1e-3, 1e-9);
    }
    energy.set_penalty(12.0);
    energy.set_multiplier(2.0);
    assert_eq!((energy.penalty(), energy.multiplier()), (12.0, 2.0));
    check_gradient(&energy, &[], 0.4, 1e-3, 1e-9);
    let at = Configuration { x: &[], t: 0.25 };
    assert_eq!(energy.value(at, 0..1), 6.0 * 0.75 * 0.75 + 2.0 * 0.75);
    assert_eq!(energy.value(at, 0..0), 0.0);
}

#[test]
fn a_negative_penalty_counts_as_none() {
    let mut energy = Inflation::new(-1.0, 1.0);
    assert_eq!(dense(&energy, &[], 0.0).hessian, [[0.0]]);
    energy.set_penalty(-2.0);
    assert_eq!(dense(&energy, &[], 0.0).hessian, [[0.0]]);
    assert_eq!(dense(&energy, &[], 0.0).gradient, [-1.0]);
}
