//! The way of a rig into a pose.

use bespoke::input::rig::{Rig, RigJoint};
use bespoke::rig::pose_path::PosePath;
use glam::{DAffine3, DMat4, DQuat, DVec3};

/// A chain of three joints a unit apart, the last before its parents.
fn chain() -> Rig {
    let joint = |x: f64, parent: Option<u32>| RigJoint {
        name: String::new(),
        parent,
        bind: DMat4::from_translation(DVec3::new(x, 0.0, 0.0)),
    };
    Rig { joints: vec![joint(2.0, Some(1)), joint(1.0, Some(2)), joint(0.0, None)] }
}

fn about(place: DVec3, turn: DQuat) -> DAffine3 {
    DAffine3::from_translation(place) * DAffine3::from_quat(turn) * DAffine3::from_translation(-place)
}

#[test]
fn joints_turn_evenly_and_end_where_they_were_told() {
    let quarter = |share: f64| DQuat::from_rotation_z(share * std::f64::consts::FRAC_PI_2);
    let pose = |share: f64| {
        let middle = about(DVec3::X, quarter(share));
        vec![middle * about(2.0 * DVec3::X, quarter(share)), middle, DAffine3::IDENTITY]
    };
    let path = PosePath::new(&chain(), pose(1.0)).unwrap();
    // The last one turns by half a turn in all.
    assert_eq!(path.pieces(), 15);
    assert_eq!(path.motions(1.0), pose(1.0));
    for share in [0.0, 0.25, 0.7] {
        for (found, wanted) in path.motions(share).into_iter().zip(pose(share)) {
            let p = DVec3::new(2.5, 0.3, -0.2);
            assert!(found.transform_point3(p).distance(wanted.transform_point3(p)) < 1e-12, "{share}");
        }
    }
}

#[test]
fn scale_mirror_and_shift_are_gone_to_straight() {
    let bind = DAffine3::from_scale_rotation_translation(
        DVec3::new(2.0, -1.5, 1.0),
        DQuat::from_rotation_y(0.4),
        DVec3::new(0.0, 3.0, 0.0),
    );
    let path = PosePath::new(&chain(), vec![bind; 3]).unwrap();
    assert_eq!(path.motions(1.0), vec![bind; 3]);
    let p = DVec3::new(0.7, -0.2, 0.4);
    for joint in 0..3 {
        let at = |share: f64| path.motions(share)[joint].transform_point3(p);
        assert!(at(0.0).distance(p) < 1e-12 && at(1.0 - 1e-9).distance(bind.transform_point3(p)) < 1e-7);
    }
}
