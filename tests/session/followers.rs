//! Meshes that follow the garment: carried, checked, and with skin weights of their own.

use bespoke::control::Stage;
use bespoke::error::ErrorKind;
use bespoke::geometry::mesh::TriangleMesh;
use bespoke::input::diagnostic::{Diagnostic, Subject};
use bespoke::input::morph::Morph;
use bespoke::input::skin::SkinWeights;
use bespoke::session::{Precision, Session};
use glam::{DQuat, DVec3};

use crate::small::{arm, session, sleeve, tube};

/// The sleeve on a thicker arm than it was made for.
fn on_a_thick_arm() -> (Session, usize) {
    let mut session = session(1.0, DVec3::ZERO);
    let body = tube(-1.1, 1.15, |_, _| 0.5, 14, 18, true);
    let vertices = body.positions.len();
    session.set_target_avatar(body).unwrap();
    (session, vertices)
}

fn found(session: &Session) -> Vec<&Diagnostic> {
    session.diagnostics().iter().filter(|d| matches!(d, Diagnostic::FollowerIntersects { .. })).collect()
}

/// A coarse version on the sleeve, a trim around it, and a small badge off it.
fn followers() -> [TriangleMesh; 3] {
    let low = sleeve().positions.iter().map(|p| p.z).fold(f64::INFINITY, f64::min);
    let around = |r: f64| move |_: f64, _: f64| r;
    let widest = sleeve().positions.iter().map(|p| p.truncate().length()).fold(0.0, f64::max);
    let trim = tube(low + 0.05, low + 0.1, around(widest + 0.05), 1, 24, false);
    let mut badge = TriangleMesh { positions: Vec::new(), triangles: vec![[0, 1, 2], [2, 1, 3]] };
    badge.positions = [[0.0, 0.0], [0.04, 0.0], [0.0, 0.04], [0.04, 0.04]]
        .map(|[x, z]| DVec3::new(x, widest + 0.03, low + 0.3 + z))
        .into();
    [sleeve(), trim, badge]
}

#[test]
fn followers_go_along_and_meet_nothing() {
    let (mut session, _) = on_a_thick_arm();
    for mesh in followers() {
        session.add_follower(mesh, Precision::F64).unwrap();
    }
    assert_eq!(session.follower_positions(0).unwrap_err().kind, ErrorKind::InvalidState);
    assert_eq!(session.run().unwrap(), Stage::Done);
    let garment = session.garment_positions().unwrap();
    // What lies on the garment still does.
    for (p, q) in session.follower_positions(0).unwrap().iter().zip(&garment) {
        assert!(p.distance(*q) < 1e-12);
    }
    assert!(found(&session).is_empty(), "{:?}", found(&session));
    // The others keep off it, as in the design, in proportion.
    let [_, trim, badge] = followers();
    for (index, designed) in [(1, trim), (2, badge)] {
        let points = session.follower_positions(index).unwrap();
        let (was, is) = (apart(&designed.positions, &sleeve().positions), apart(&points, &garment));
        assert!(is > 0.6 * was && is < 2.0 * was, "{index}: {was} {is}");
    }
    assert_eq!(session.follower_positions(3).unwrap_err().kind, ErrorKind::InvalidArgument);
    assert!(session.follower_skin(0, 4).unwrap_err().message.contains("skin weights"));
    session.reset();
    session.clear_followers().unwrap();
    session.run().unwrap();
    assert_eq!(session.follower_positions(0).unwrap_err().kind, ErrorKind::InvalidArgument);
}

/// On a target that lies, what lies on the garment does so there.
#[test]
fn followers_turn_with_the_target() {
    let (mut session, _) = on_a_thick_arm();
    let turn = DQuat::from_rotation_x(0.6);
    let (mut body, mut skeleton) = (tube(-1.1, 1.15, |_, _| 0.5, 14, 18, true), arm(1.0, DVec3::ZERO));
    body.positions.iter_mut().chain(&mut skeleton.joints).for_each(|p| *p = turn * *p);
    session.set_target_avatar(body).unwrap();
    session.set_target_skeleton(skeleton).unwrap();
    session.add_follower(sleeve(), Precision::F64).unwrap();
    session.add_garment_morph(Morph { name: "up".into(), offsets: vec![DVec3::Z; sleeve().positions.len()] }).unwrap();
    assert_eq!(session.run().unwrap(), Stage::Done);
    let (garment, axis) = (session.garment_positions().unwrap(), turn * DVec3::Z);
    for (p, q) in session.follower_positions(0).unwrap().iter().zip(&garment) {
        assert!(p.distance(*q) < 1e-12);
    }
    let offsets = session.garment_morph(0).unwrap();
    let mean = offsets.iter().sum::<DVec3>() / offsets.len() as f64;
    assert!(mean.normalize().dot(axis) > 0.98, "{mean} {axis}");
}

/// The smallest distance between the points of two sets.
fn apart(a: &[DVec3], b: &[DVec3]) -> f64 {
    a.iter().flat_map(|p| b.iter().map(|q| p.distance(*q))).fold(f64::INFINITY, f64::min)
}

/// A lining well inside the sleeve, where there was air, ends in the thick arm.
#[test]
fn a_follower_in_the_body_is_told() {
    let (mut session, _) = on_a_thick_arm();
    let [coarse, _, badge] = followers();
    session.add_follower(coarse, Precision::F32).unwrap();
    let slim = sleeve().positions.iter().map(|p| p.truncate().length()).fold(f64::INFINITY, f64::min);
    session.add_follower(tube(-0.3, -0.1, |_, _| 0.5 * slim, 1, 12, false), Precision::F32).unwrap();
    session.add_follower(badge, Precision::F32).unwrap();
    session.run().unwrap();
    let found = found(&session);
    let [Diagnostic::FollowerIntersects { follower: 1, body, garment: 0, first }] = found[..] else {
        panic!("{found:?}")
    };
    assert!(*body == 24 && first.len() == 1, "{body} {first:?}");
    assert_eq!(first[0].subject, Subject::Follower(1));
    // Rounded as it is read.
    assert!(session.follower_positions(1).unwrap().iter().all(|p| Precision::F32.round(*p) == *p));
}

/// One that reaches through the skin.
#[test]
fn a_follower_through_the_body_is_told() {
    let (mut session, _) = on_a_thick_arm();
    // From well outside of the sleeve to far inside.
    let spike = tube(-0.3, -0.1, |z, _| if z < -0.2 { 0.6 } else { 0.02 }, 1, 12, false);
    session.add_follower(spike, Precision::F32).unwrap();
    session.run().unwrap();
    let found = found(&session);
    let [Diagnostic::FollowerIntersects { follower: 0, body, garment: 0, first }] = found[..] else {
        panic!("{found:?}")
    };
    assert!(*body > 0 && first[0].subject == Subject::Follower(0) && first[1].subject == Subject::TargetAvatar);
}

/// What passed through the body that the garment was designed on may do so again.
#[test]
fn what_was_in_the_source_body_may_be_in_the_other() {
    let (mut session, _) = on_a_thick_arm();
    session.set_source_avatar(tube(-1.1, 1.15, |_, _| 0.25, 14, 18, true)).unwrap();
    session
        .add_follower(tube(-0.3, -0.1, |z, _| if z < -0.2 { 0.2 } else { 0.3 }, 1, 12, false), Precision::F32)
        .unwrap();
    session.run().unwrap();
    assert!(found(&session).is_empty(), "{:?}", found(&session));
}

#[test]
fn followers_have_the_weights_of_the_garment_beneath() {
    let (mut session, vertices) = on_a_thick_arm();
    let rows = (0..vertices).map(|v| vec![(u32::from(v % 3 == 0), 0.75), (2, 0.25)]);
    session.set_target_skin(SkinWeights::from_rows(3, rows)).unwrap();
    for mesh in followers() {
        session.add_follower(mesh, Precision::F64).unwrap();
    }
    session.run().unwrap();
    let garment = session.garment_skin(4).unwrap();
    let skin = session.follower_skin(0, 4).unwrap();
    assert_eq!(skin.vertex_count(), garment.vertex_count());
    for v in 0..skin.vertex_count() {
        for (a, b) in skin.weights(v).iter().zip(garment.weights(v)) {
            assert!(a.0 == b.0 && (a.1 - b.1).abs() < 1e-9);
        }
    }
    let badge = session.follower_skin(2, 2).unwrap();
    assert_eq!((badge.vertex_count(), badge.joint_count()), (4, 3));
    for v in 0..4 {
        let weights = badge.weights(v);
        assert!(weights.len() <= 2 && (weights.iter().map(|w| w.1).sum::<f64>() - 1.0).abs() < 1e-9);
    }
    assert_eq!(session.follower_skin(0, 0).unwrap_err().kind, ErrorKind::InvalidArgument);
}

#[test]
fn a_follower_that_is_no_mesh_is_refused() {
    let (mut session, _) = on_a_thick_arm();
    let bad = TriangleMesh { positions: vec![DVec3::ZERO], triangles: vec![[0, 0, 1]] };
    let error = session.add_follower(bad, Precision::F32).unwrap_err();
    assert!(error.kind == ErrorKind::InvalidMesh && error.message.contains("follower 0"), "{error}");
    session.prepare().unwrap();
    let [mesh, ..] = followers();
    assert_eq!(session.add_follower(mesh, Precision::F32).unwrap_err().kind, ErrorKind::InvalidState);
    assert_eq!(session.clear_followers().unwrap_err().kind, ErrorKind::InvalidState);
}
