//! Quantiles against the definition, tried on every value.

use bespoke::geometry::median::median;
use bespoke::geometry::quantile::{quantile, quantile_of_sorted};

use testing::Random;

/// The least of the values of which those that are no greater weigh more than the share of all.
fn by_definition(values: &[(f64, f64)], share: f64) -> Option<f64> {
    let up_to = |x: f64| values.iter().filter(|value| value.0 <= x).map(|value| value.1).sum::<f64>();
    let enough = values.iter().map(|value| value.0).filter(|&x| up_to(x) > share * up_to(f64::INFINITY));
    enough.min_by(f64::total_cmp)
}

#[test]
fn it_is_the_least_value_up_to_which_there_is_more_than_the_share() {
    let mut random = Random::new(73);
    assert_eq!(quantile(Vec::new(), 0.5), None);
    for count in 1..40 {
        // Weights in 64ths, whose sums are exact in any order; some values stand more than once.
        let mut part = |n: f64| (n * random.unit()).floor() / 64.0;
        let values: Vec<(f64, f64)> = (0..count).map(|_| (part(64.0), part(8.0) + 1.0 / 64.0)).collect();
        for share in [0.0, 0.05, 0.25, 0.5, 0.9, 0.999] {
            assert_eq!(quantile(values.clone(), share), by_definition(&values, share), "{share} of {values:?}");
        }
        let mut sorted: Vec<f64> = values.iter().map(|value| value.0).collect();
        sorted.sort_by(f64::total_cmp);
        assert_eq!(quantile(values, 1.0), sorted.last().copied());
        assert_eq!(quantile_of_sorted(&sorted, |_| 1.0, 0.5).copied(), median(sorted));
    }
}
