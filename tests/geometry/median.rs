//! The median against sorting.

use bespoke::geometry::median::median;

use testing::Random;

#[test]
fn it_is_in_the_middle_of_the_sorted_numbers() {
    let mut random = Random::new(72);
    assert_eq!(median(Vec::new()), None);
    for count in 1..40 {
        let numbers: Vec<f64> = (0..count).map(|_| random.signed()).collect();
        let mut sorted = numbers.clone();
        sorted.sort_by(f64::total_cmp);
        assert_eq!(median(numbers), Some(sorted[count / 2]));
    }
}
