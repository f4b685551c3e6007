//! Quantiles of numbers that have weights.

/// Of `values` in ascending order, the first up to which the weights are more than `share` of all of them, and the last where they
/// never are; none of none.
pub fn quantile_of_sorted<T>(values: &[T], weight: impl Fn(&T) -> f64, share: f64) -> Option<&T> {
    let whole: f64 = values.iter().map(&weight).sum();
    let mut sum = 0.0;
    let reached = values.iter().find(|value| {
        sum += weight(value);
        sum > share * whole
    });
    reached.or(values.last())
}

/// The same of numbers with their weights, in any order.
pub fn quantile(mut values: Vec<(f64, f64)>, share: f64) -> Option<f64> {
    values.sort_by(|a, b| a.0.total_cmp(&b.0));
    quantile_of_sorted(&values, |value| value.1, share).map(|value| value.0)
}
