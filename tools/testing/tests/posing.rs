//! Poses and counts where the answer is known.

use bespoke::geometry::mesh::TriangleMesh;
use bespoke::input::skeleton::Skeleton;
use bespoke::input::skin::SkinWeights;
use closet::skeleton::{ARMS, BONES, LEGS};
use closet::{Kind, sample};
use glam::{DAffine3, DVec3};
use testing::posing::{Bend, Counts, Puppet, counts, nearest_vertex};

/// Arms in an A come down, forearms and thighs come to the front (-y), shins go back; nothing else moves.
#[test]
fn joints_bend_as_they_do() {
    let joints = sample(Kind::Mannequin).skeleton.joints;
    let skeleton = Skeleton { joints: joints.to_vec(), bones: BONES.to_vec() };
    let puppet = Puppet::new(&skeleton, DVec3::NEG_Y, DVec3::Z);
    let moved = |bend: Bend, joint: usize, by: usize| {
        puppet.moves(&[bend], 45.0)[by].transform_point3(joints[joint]) - joints[joint]
    };
    for ([shoulder, elbow, wrist], [hip, knee, ankle]) in ARMS.into_iter().zip(LEGS) {
        let raised = (joints[elbow] - joints[shoulder]).normalize().z < -0.6;
        assert_eq!(moved(Bend::Shoulder, wrist, elbow).z > 0.1, raised);
        assert!(moved(Bend::Shoulder, wrist, elbow).z.abs() > 0.1);
        assert!(moved(Bend::Elbow, wrist, elbow).y < -0.1);
        assert!(moved(Bend::Elbow, elbow, shoulder).length() < 1e-12);
        assert!(moved(Bend::Hip, knee, hip).y < -0.1);
        assert!(moved(Bend::Knee, ankle, knee).y > 0.1);
        assert!(moved(Bend::Knee, wrist, wrist).length() < 1e-12);
    }
}

/// A triangle above another one that goes down through it, beside one that it always passes through.
#[test]
fn pairs_of_the_bind_pose_do_not_count() {
    let triangle = |z: f64, tilt: f64| [DVec3::Z * z, DVec3::new(1.0, 0.0, z + tilt), DVec3::new(0.0, 1.0, z)];
    let garment = TriangleMesh::from_corners([triangle(0.5, -0.1)]);
    let mut body = TriangleMesh::from_corners([triangle(0.0, 0.1)]);
    body.positions.extend([DVec3::new(0.2, 0.2, -1.0), DVec3::new(0.3, 0.2, 1.0), DVec3::new(0.2, 0.3, 1.0)]);
    body.triangles.push([3, 4, 5]);
    let rows = |joint: u32, count: usize| SkinWeights::from_rows(2, vec![vec![(joint, 1.0)]; count]);
    let (worn, skin) = (rows(1, 3), rows(0, 6));
    let at = |move_by: DVec3| {
        let moves = [DAffine3::IDENTITY, DAffine3::from_translation(move_by)];
        counts(&garment, &worn, &body, &skin, &moves)
    };
    assert_eq!(at(DVec3::ZERO), Counts::default());
    assert_eq!(at(-0.45 * DVec3::Z), Counts { own: 0, body: 1, folds: 0 });
    assert_eq!(nearest_vertex(&garment, &body, &skin), rows(0, 3));
}
