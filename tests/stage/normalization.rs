//! The normalised space.

use bespoke::error::ErrorKind;
use bespoke::input::skeleton::Skeleton;
use bespoke::stage::setup::normalization::{Normalization, SIDE};
use glam::DVec3;

use testing::Random;

#[test]
fn a_skeleton_is_centred_and_its_longest_side_is_two() {
    let mut random = Random::new(4);
    for _ in 0..50 {
        let scale = 10.0_f64.powf(4.0 * random.signed());
        let away = 1e4 * random.vector();
        let joints: Vec<DVec3> = (0..6).map(|_| away + scale * random.vector()).collect();
        let skeleton = Skeleton { joints: joints.clone(), bones: vec![] };
        let frame = Normalization::of(&skeleton, "skeleton").unwrap();
        let normalised: Vec<DVec3> = joints.iter().map(|&p| frame.normalise(p)).collect();
        let mean = normalised.iter().sum::<DVec3>() / 6.0;
        let low = normalised.iter().copied().reduce(DVec3::min).unwrap();
        let high = normalised.iter().copied().reduce(DVec3::max).unwrap();
        assert!(mean.length() < 1e-6 && ((high - low).max_element() - SIDE).abs() < 1e-6);
        for (&p, &q) in joints.iter().zip(&normalised) {
            assert!(frame.restore(q).distance(p) <= 1e-14 * away.length().max(scale));
        }
    }
}

#[test]
fn a_skeleton_without_size_is_refused() {
    let skeleton = Skeleton { joints: vec![DVec3::ONE; 3], bones: vec![[0, 1], [1, 2]] };
    let error = Normalization::of(&skeleton, "target skeleton").unwrap_err();
    assert_eq!(error.kind, ErrorKind::InvalidSkeleton);
    assert!(error.message.starts_with("target skeleton"), "{error}");
}
