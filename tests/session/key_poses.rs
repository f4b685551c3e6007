//! Corrections of key poses: what the weights alone let through each other, the offsets keep apart.

use std::collections::HashSet;

use bespoke::control::Stage;
use bespoke::error::ErrorKind;
use bespoke::geometry::mesh::TriangleMesh;
use bespoke::input::rig::{Rig, RigJoint};
use bespoke::input::skin::SkinWeights;
use bespoke::rig::weights::blend::linear_blend;
use bespoke::session::{KeyPose, PoseCounts, Precision, Session};
use bespoke::verify::intersections;
use glam::{DAffine3, DMat4, DQuat, DVec3};

use crate::small::{arm, sleeve, tube};

fn rig() -> Rig {
    let names = ["Hips", "Spine", "Head"];
    let joint = |(k, &place): (usize, &DVec3)| RigJoint {
        name: names[k].into(),
        parent: k.checked_sub(1).map(|parent| parent as u32),
        bind: DMat4::from_translation(place),
    };
    Rig { joints: arm(1.0, DVec3::ZERO).joints.iter().enumerate().map(joint).collect() }
}

fn body() -> TriangleMesh {
    tube(-1.1, 1.15, |_, _| 0.36, 30, 24, true)
}

/// The lower part goes with the first joint, the upper one with the second, and between they are mixed.
fn skin(body: &TriangleMesh) -> SkinWeights {
    let row = |p: &DVec3| {
        let upper = (0.5 + p.z / 0.5).clamp(0.0, 1.0);
        vec![(0, 1.0 - upper), (1, upper)].into_iter().filter(|(_, weight)| *weight > 0.0).collect()
    };
    SkinWeights::from_rows(3, body.positions.iter().map(row))
}

fn session() -> Session {
    let mut session = Session::new();
    session.set_garment(sleeve(), Precision::F32).unwrap();
    session.set_source_rig(rig()).unwrap();
    session.set_target_rig(rig()).unwrap();
    session.set_target_avatar(body()).unwrap();
    session.set_target_skin(skin(&body())).unwrap();
    session
}

/// The upper part bent by so many degrees.
fn bent(degrees: f64) -> KeyPose {
    let turn = DAffine3::from_quat(DQuat::from_rotation_y(degrees.to_radians()));
    KeyPose { name: "bent".into(), motions: vec![DAffine3::IDENTITY, turn, turn] }
}

/// What passes through what with these offsets, counted here.
fn counted(session: &Session, influences: usize, pose: &KeyPose, offsets: &[DVec3]) -> PoseCounts {
    let read = |p: DVec3| Precision::F32.round(p);
    let weights = session.garment_skin(influences).unwrap();
    let fitted = session.garment_positions().unwrap();
    let moved: Vec<DVec3> = fitted.iter().zip(offsets).map(|(&p, &d)| read(p) + d).collect();
    let cloth = TriangleMesh {
        positions: linear_blend(&moved, &weights, &pose.motions).into_iter().map(read).collect(),
        triangles: sleeve().triangles,
    };
    let under = TriangleMesh {
        positions: linear_blend(&body().positions, &skin(&body()), &pose.motions),
        triangles: body().triangles,
    };
    let pairs = |a: &TriangleMesh, b: Option<&TriangleMesh>| intersections(a, b, usize::MAX).unwrap().pairs;
    let folded: HashSet<u32> = pairs(&under, None).into_iter().flatten().collect();
    let with_body = pairs(&cloth, Some(&under));
    let folds = with_body.iter().filter(|pair| folded.contains(&pair[1])).count();
    PoseCounts {
        garment: pairs(&cloth, None).len() as u64,
        body: (with_body.len() - folds) as u64,
        folds: folds as u64,
    }
}

#[test]
fn offsets_keep_the_garment_out_of_the_body_in_the_pose() {
    let mut session = session();
    session.add_key_pose(bent(35.0)).unwrap();
    assert!(session.solve_pose_corrections(1).unwrap_err().message.contains("run"));
    assert_eq!(session.run().unwrap(), Stage::Done);
    // Added after the end.
    session.add_key_pose(bent(-20.0)).unwrap();
    let fitted = session.garment_positions().unwrap();
    assert!(session.pose_correction(0).unwrap_err().message.contains("solve_pose_corrections"));
    // With one joint a vertex the garment breaks where the body bends.
    session.solve_pose_corrections(1).unwrap();
    assert_eq!((session.stage(), session.garment_positions().unwrap()), (Stage::Done, fitted.clone()));
    for (index, degrees) in [(0, 35.0), (1, -20.0)] {
        let correction = session.pose_correction(index).unwrap().clone();
        let still = vec![DVec3::ZERO; fitted.len()];
        assert_eq!(correction.before, counted(&session, 1, &bent(degrees), &still));
        assert_eq!(correction.after, counted(&session, 1, &bent(degrees), &correction.offsets));
        let [before, after] = [correction.before, correction.after].map(|counts| counts.avoidable());
        assert!(before > 0, "without offsets nothing passes through anything at {degrees} degrees");
        assert_eq!(after, 0, "of {before} at {degrees} degrees");
        // Where the garment does not bend it stays as it is.
        let far = fitted.iter().zip(&correction.offsets).filter(|(p, _)| p.z < -0.45);
        assert!(far.clone().count() > 20 && far.map(|(_, d)| d.length()).all(|d| d < 5e-3));
    }
    assert_eq!(session.pose_correction(2).unwrap_err().kind, ErrorKind::InvalidArgument);
    session.clear_key_poses().unwrap();
    assert_eq!(session.pose_correction(0).unwrap_err().kind, ErrorKind::InvalidArgument);
}

#[test]
fn a_pose_in_which_nothing_passes_through_anything_needs_no_offsets() {
    let mut session = session();
    session.add_key_pose(bent(0.0)).unwrap();
    // The whole of it turned and moved.
    let turn = DAffine3::from_rotation_translation(DQuat::from_rotation_x(2.0), DVec3::new(3.0, -1.0, 2.0));
    session.add_key_pose(KeyPose { name: String::new(), motions: vec![turn; 3] }).unwrap();
    session.run().unwrap();
    session.solve_pose_corrections(4).unwrap();
    for index in 0..2 {
        let correction = session.pose_correction(index).unwrap();
        assert_eq!((correction.before, correction.after), Default::default());
        assert!(correction.offsets.iter().all(|&offset| offset == DVec3::ZERO));
    }
}

#[test]
fn poses_that_are_none_are_refused() {
    let mut session = session();
    let mut refused = |motions: Vec<DAffine3>, words: &[&str]| {
        let error = session.add_key_pose(KeyPose { name: "crouch".into(), motions }).unwrap_err();
        assert_eq!(error.kind, ErrorKind::InvalidArgument);
        words.iter().for_each(|word| assert!(error.message.contains(word), "{error}"));
    };
    refused(vec![DAffine3::IDENTITY; 2], &["key pose 0 (\"crouch\")", "2 joints", "has 3"]);
    let flat = DAffine3::from_scale(DVec3::new(1.0, 0.0, 1.0));
    refused(vec![DAffine3::IDENTITY, flat, flat], &["joint 1 (\"Spine\")", "inverse"]);
    let lost = DAffine3::from_translation(DVec3::new(f64::NAN, 0.0, 0.0));
    refused(vec![DAffine3::IDENTITY, DAffine3::IDENTITY, lost], &["joint 2", "finite"]);
    let mut other = Session::new();
    let error = other.add_key_pose(bent(1.0)).unwrap_err();
    assert!(error.kind == ErrorKind::InvalidState && error.message.contains("target rig"));
}
