//! The garment's own joints.

use bespoke::error::ErrorKind;
use bespoke::input::skin::SkinWeights;
use bespoke::rig::weights::own_joints::{AddedJoint, SourceRig, keep_own};
use glam::{DAffine3, DQuat, DVec3};
use testing::Random;

use crate::limbs::assert_weights;

/// Joint 0 is the hip, which the target has as 3; 1 and 2 are a chain of a skirt below a helper, 4; 3 is a finger of the body.
const PARENTS: [Option<u32>; 5] = [None, Some(4), Some(1), Some(0), Some(0)];
const MAP: [Option<u32>; 5] = [Some(3), None, None, None, None];

fn binds() -> Vec<DAffine3> {
    let mut random = Random::new(4);
    let of = |_| DAffine3::from_rotation_translation(DQuat::from_scaled_axis(random.vector()), random.vector());
    (0..5).map(of).collect()
}

fn garment_skin() -> SkinWeights {
    let row = |v: u32| match v {
        0..20 => vec![(0, 1.0)],
        20..40 => vec![(0, 1.0), (1, 3.0)],
        40..60 => vec![(1, 0.5), (2, 0.5)],
        _ => vec![(2, 0.7), (3, 0.3)],
    };
    SkinWeights::from_rows(5, (0..70).map(row))
}

#[test]
fn they_are_what_neither_target_nor_body_has() {
    let binds = binds();
    let rig = SourceRig { parents: &PARENTS, binds: &binds, map: &MAP, target_joints: 7 };
    assert_eq!(rig.own_joints(&garment_skin(), None), [1, 2, 3]);
    let body = SkinWeights::from_rows(5, [vec![(0, 0.5), (3, 0.5)]]);
    assert_eq!(rig.own_joints(&garment_skin(), Some(&body)), [1, 2]);
}

/// A garment that is turned, scaled and moved takes its joints along, whatever the target's axes are.
#[test]
fn they_go_where_the_garment_goes() {
    let binds = binds();
    let rig = SourceRig { parents: &PARENTS, binds: &binds, map: &MAP, target_joints: 7 };
    let mut random = Random::new(8);
    let designed: Vec<DVec3> = (0..70).map(|_| random.vector()).collect();
    let turn = DQuat::from_scaled_axis(DVec3::new(0.3, -1.0, 0.4));
    let place = |p: DVec3| turn * (1.7 * p) + DVec3::new(4.0, 5.0, -6.0);
    let fitted: Vec<DVec3> = designed.iter().map(|&p| place(p)).collect();
    let added = rig.added_joints(&[1, 2], &garment_skin(), &designed, &fitted);
    let order: Vec<_> = added.iter().map(|a| (a.source, a.parent)).collect();
    assert_eq!(order, [(4, Some(3)), (1, Some(7)), (2, Some(8))]);
    for AddedJoint { source, bind, .. } in &added {
        let was = binds[*source as usize];
        assert!(bind.translation.distance(place(was.translation)) < 1e-9);
        for axis in DVec3::AXES {
            assert!(bind.transform_vector3(axis).distance(turn * was.transform_vector3(axis)) < 1e-9);
        }
    }
}

#[test]
fn circles_of_parents_are_cut() {
    let binds = binds();
    let parents = [Some(0), Some(2), Some(1), Some(3), Some(1)];
    let rig = SourceRig { parents: &parents, binds: &binds, map: &[None; 5], target_joints: 2 };
    let points = vec![DVec3::ZERO; 70];
    let added = rig.added_joints(&[0, 1, 2, 3, 4], &garment_skin(), &points, &points);
    let mut sources: Vec<u32> = added.iter().map(|a| a.source).collect();
    sources.sort_unstable();
    assert_eq!(sources, [0, 1, 2, 3, 4]);
    for (k, joint) in added.iter().enumerate() {
        assert!(joint.parent.is_none_or(|p| (2..2 + k as u32).contains(&p)), "{joint:?} is number {}", k + 2);
        assert!(joint.bind.is_finite());
    }
}

#[test]
fn their_weights_are_kept() {
    let transferred = SkinWeights::from_rows(7, (0..70).map(|v| vec![(v % 7, 0.75), ((v + 1) % 7, 0.25)]));
    let binds = binds();
    let rig = SourceRig { parents: &PARENTS, binds: &binds, map: &MAP, target_joints: 7 };
    let points: Vec<DVec3> = (0..70).map(|v| DVec3::splat(f64::from(v))).collect();
    let added = rig.added_joints(&[1, 2], &garment_skin(), &points, &points);
    let result = keep_own(&transferred, &garment_skin(), &added).expect("equal numbers of vertices");
    assert_eq!(result.joint_count(), 10);
    assert_weights(&result, 70, 4);
    assert_eq!(result.weights(5), transferred.weights(5));
    // Joints 1 and 2 of the source are 8 and 9.
    assert_eq!(result.weights(21), [(0, 0.25 * 0.75), (1, 0.25 * 0.25), (8, 0.75)]);
    assert_eq!(result.weights(50), [(8, 0.5), (9, 0.5)]);
    // What was on a finger that the target lacks is shared out as it was transferred.
    let weights = result.weights(69);
    assert!(weights.len() == 3 && weights[2].0 == 9 && (weights[2].1 - 0.7).abs() < 1e-12, "{weights:?}");
    let short = SkinWeights::from_rows(5, [vec![(0, 1.0)]]);
    assert_eq!(keep_own(&transferred, &short, &added).expect_err("too few").kind, ErrorKind::InvalidWeights);
}
