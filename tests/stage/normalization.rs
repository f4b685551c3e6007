//! The normalised space.

use bespoke::error::ErrorKind;
use bespoke::input::skeleton::Skeleton;
use bespoke::stage::setup::normalization::{Normalization, SIDE};
use glam::{DQuat, DVec3};

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

#[test]
fn a_turned_skeleton_is_turned_back_and_a_pose_is_no_turn() {
    let joints = [
        [0.0, 1.0, 0.0],
        [0.0, 1.5, 0.0],
        [0.0, 1.8, 0.02],
        [0.2, 1.4, 0.0],
        [0.7, 1.4, 0.0],
        [-0.2, 1.4, 0.0],
        [-0.7, 1.4, 0.0],
        [0.1, 0.1, 0.0],
        [-0.1, 0.1, 0.0],
    ]
    .map(DVec3::from);
    let skeleton = |joints: Vec<DVec3>| Skeleton { joints, bones: vec![] };
    let source = skeleton(joints.to_vec());
    let normalised = skeleton(Normalization::of(&source, "").unwrap().normalise_all(&source.joints));
    let turned_to_source = |target: &Skeleton| Normalization::of(target, "").unwrap().turned_to(&normalised, target);
    for degrees in [-60.0_f64, -30.0, 20.0, 45.0] {
        let about = DQuat::from_rotation_y(degrees.to_radians());
        let target = skeleton(joints.iter().map(|&p| 3.0 * (about * p) + DVec3::X).collect());
        let frame = turned_to_source(&target);
        assert!(frame.turn.is_some(), "{degrees}");
        let scale = normalised.joints[4].distance(normalised.joints[6]) / 1.4 / (frame.scale * 3.0);
        for (&p, q) in target.joints.iter().zip(&normalised.joints) {
            let n = frame.normalise(p);
            assert!((scale * n).distance(*q) < 1e-9, "{degrees}: {n} and {q}");
            assert!(frame.restore(n).distance(p) < 1e-12);
        }
    }
    let mut hanging = joints.to_vec();
    for (joint, side) in [(4, 1.0), (6, -1.0)] {
        hanging[joint] = DVec3::new(0.25 * side, 0.9, 0.1);
    }
    assert_eq!(turned_to_source(&skeleton(hanging)).turn, None);
    assert_eq!(turned_to_source(&source).turn, None);
}
