//! A target that faces the other way: the result is that of the target as it was, turned, whether it is told or found.

use bespoke::control::Stage;
use bespoke::error::ErrorKind;
use bespoke::geometry::mesh::TriangleMesh;
use bespoke::input::coordinate_system::{Axis, CoordinateSystem};
use bespoke::input::diagnostic::DiagnosticKind;
use bespoke::input::skeleton::Skeleton;
use bespoke::options::Options;
use bespoke::session::{Precision, Session};
use glam::DVec3;

use crate::small::{arm, session, sleeve, thick_arm};

fn about(p: DVec3) -> DVec3 {
    DVec3::new(-p.x, p.y, -p.z)
}

/// The sleeve on its way to the thick arm, which is turned by half.
fn turned() -> Session {
    let (arm, source) = (thick_arm(), arm(1.0, DVec3::ZERO));
    let mut session = Session::new();
    session.set_garment(sleeve(), Precision::F32).unwrap();
    let positions = arm.positions.iter().map(|&p| about(p)).collect();
    session.set_target_avatar(TriangleMesh { positions, ..arm }).unwrap();
    let joints = source.joints.iter().map(|&p| about(p)).collect();
    session.set_target_skeleton(Skeleton { joints, bones: source.bones.clone() }).unwrap();
    session.set_source_skeleton(source).unwrap();
    session
}

fn is_found(session: &Session) -> bool {
    session.diagnostics().iter().any(|d| d.kind() == DiagnosticKind::FacingMismatch)
}

#[test]
fn a_turned_target_is_dressed_like_the_other() {
    let mut plain = session(1.0, DVec3::ZERO);
    assert_eq!(plain.run().unwrap(), Stage::Done);
    assert!(!is_found(&plain));
    let expected: Vec<DVec3> = plain.garment_positions().unwrap().into_iter().map(about).collect();

    let mut found = turned();
    assert_eq!(found.run().unwrap(), Stage::Done);
    assert!(is_found(&found));
    assert_eq!(found.garment_positions().unwrap(), expected);

    let mut told = turned();
    let system = CoordinateSystem { right: Axis::NegativeX, forward: Axis::PositiveZ, ..CoordinateSystem::default() };
    told.set_target_coordinate_system(system).unwrap();
    assert_eq!(told.run().unwrap(), Stage::Done);
    assert!(!is_found(&told));
    assert_eq!(told.garment_positions().unwrap(), expected);
}

#[test]
fn strict_refuses_it() {
    let mut strict = turned();
    strict.set_options(Options { strict: true, ..Options::default() }).unwrap();
    let error = strict.prepare().unwrap_err();
    assert_eq!(error.kind, ErrorKind::InvalidSkeleton);
    assert!(error.to_string().contains("right -x, up +y, forward +z"), "{error}");
}
