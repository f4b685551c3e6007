//! A joint of the target outside of the body: said in the caller's coordinates, and mended unless the caller is strict.

use bespoke::control::Stage;
use bespoke::geometry::mesh::TriangleMesh;
use bespoke::input::coordinate_system::{Axis, CoordinateSystem};
use bespoke::input::diagnostic::{Diagnostic, Element, JointFault, Subject};
use bespoke::input::skeleton::Skeleton;
use bespoke::options::Options;
use bespoke::session::{Precision, Session};
use glam::DVec3;

use crate::small::{arm, session, thick_arm};

/// The target in centimetres, z up.
fn told(p: DVec3) -> DVec3 {
    100.0 * DVec3::new(p.x, -p.z, p.y)
}

/// The thick arm with all its triangles facing outwards, those of the caps, too.
fn closed_arm() -> TriangleMesh {
    let mut mesh = thick_arm();
    let caps = mesh.triangles.len() - 36;
    for t in &mut mesh.triangles[caps..] {
        let [a, b, c] = t.map(|v| mesh.positions[v as usize]);
        if (b - a).cross(c - a).z * a.z < 0.0 {
            t.swap(0, 1);
        }
    }
    mesh
}

/// The sleeve on its way to the thick arm, whose elbow is `aside`, in metres.
fn with_elbow(aside: DVec3) -> Session {
    let (body, mut skeleton) = (closed_arm(), arm(1.0, DVec3::ZERO));
    skeleton.joints[1] += aside;
    let told_all = |points: &[DVec3]| points.iter().map(|&p| told(p)).collect();
    let mut session = session(1.0, DVec3::ZERO);
    let up =
        CoordinateSystem { up: Axis::PositiveZ, forward: Axis::PositiveY, metres_per_unit: 0.01, ..Default::default() };
    session.set_target_coordinate_system(up).unwrap();
    session.set_target_avatar(TriangleMesh { positions: told_all(&body.positions), ..body }).unwrap();
    session.set_target_skeleton(Skeleton { joints: told_all(&skeleton.joints), ..skeleton }).unwrap();
    session
}

/// The length, place and fate of the only joint that lies wrong.
fn finding(session: &Session) -> (f64, DVec3, bool) {
    let wrong = |d: &&Diagnostic| matches!(d, Diagnostic::JointMisplaced { .. });
    let found: Vec<&Diagnostic> = session.diagnostics().iter().filter(wrong).collect();
    assert_eq!(found.len(), 1, "{found:?}");
    assert_eq!(found[0].elements(), [Element::bone(Subject::TargetSkeleton, 0)]);
    match found[0] {
        &Diagnostic::JointMisplaced {
            fault: JointFault::Outside, bone, length, place: Some(place), mended, ..
        } => {
            assert_eq!(bone.joints, [0, 1]);
            (length, place.into(), mended)
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn an_elbow_beside_the_arm_is_taken_into_its_middle() {
    let aside = DVec3::new(0.0, 0.8, 0.0);
    let mut wrong = with_elbow(aside);
    assert_eq!(wrong.run().unwrap(), Stage::Done);
    assert!(wrong.verify(Precision::F32).unwrap().is_clean());
    let (length, place, mended) = finding(&wrong);
    assert!(mended && (35.0..50.0).contains(&length), "{length}");
    // Within a third of its radius of the middle.
    assert!((place - told(DVec3::ZERO)).length() < 13.0, "{place}");

    // As where the caller puts the joint there.
    let right = |place: DVec3| DVec3::new(place.x, place.z, -place.y) / 100.0;
    let mut there = with_elbow(right(place));
    assert_eq!(there.run().unwrap(), Stage::Done);
    assert!(!there.diagnostics().iter().any(|d| matches!(d, Diagnostic::JointMisplaced { .. })));
    let (mended, put) = (wrong.garment_positions().unwrap(), there.garment_positions().unwrap());
    let apart = mended.iter().zip(&put).map(|(p, q)| p.distance(*q)).fold(0.0, f64::max);
    assert!(apart < 0.1, "{apart} cm");

    let mut strict = with_elbow(aside);
    strict.set_options(Options { strict: true, ..Options::default() }).unwrap();
    // Whatever becomes of it, the joint stays where it is.
    let _ = strict.prepare();
    assert!(!finding(&strict).2);
}
