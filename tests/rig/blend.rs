//! Linear blend skinning: known answers.

use bespoke::input::skin::SkinWeights;
use bespoke::rig::weights::blend::{linear_blend, place};
use glam::{DAffine3, DQuat, DVec3};

const QUARTER: f64 = std::f64::consts::FRAC_PI_2;

/// An arm along x whose last joint is listed first.
#[test]
fn joints_turn_all_that_hang_on_them() {
    let joints = [DVec3::new(2.0, 0.0, 0.0), DVec3::ZERO, DVec3::X];
    let parents = [Some(2), None, Some(1)];
    let mut turns = [DQuat::IDENTITY; 3];
    turns[2] = DQuat::from_rotation_z(QUARTER);
    let moves = place(&joints, &parents, &turns);
    let at = |joint: usize, p: DVec3| moves[joint].transform_point3(p);
    assert!(at(1, DVec3::X).distance(DVec3::X) < 1e-15);
    assert!(at(2, joints[0]).distance(DVec3::new(1.0, 1.0, 0.0)) < 1e-15);
    assert!(at(0, DVec3::new(3.0, 0.0, 0.5)).distance(DVec3::new(1.0, 2.0, 0.5)) < 1e-15);
    turns[0] = DQuat::from_rotation_z(QUARTER);
    let moves = place(&joints, &parents, &turns);
    let tip = moves[0].transform_point3(DVec3::new(3.0, 0.0, 0.0));
    assert!(tip.distance(DVec3::new(0.0, 1.0, 0.0)) < 1e-15, "{tip}");
    // Neither of them is above the other: both are finite, whatever they are.
    let circle = place(&joints, &[Some(1), Some(0), Some(2)], &turns);
    assert!(circle.iter().all(DAffine3::is_finite));
}

#[test]
fn a_vertex_goes_to_the_mean_of_its_joints() {
    let skin = SkinWeights::from_rows(2, [vec![(0, 0.5), (1, 1.5)], vec![], vec![(1, 1.0)]]);
    let moves = [DAffine3::IDENTITY, DAffine3::from_translation(DVec3::Y)];
    let moved = linear_blend(&[DVec3::X, DVec3::X, DVec3::ZERO], &skin, &moves);
    assert_eq!(moved, [DVec3::new(1.0, 0.75, 0.0), DVec3::X, DVec3::Y]);
}
