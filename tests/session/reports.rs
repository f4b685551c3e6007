//! What reports of other tools are about, from the inputs to a result, each with a measure of its fault: seams that open, hands that
//! stay in their sleeves, refusals that take longer than results, garments that pass through themselves.

use bespoke::control::Stage;
use bespoke::error::ErrorKind;
use bespoke::geometry::closest_point::ClosestPoint;
use bespoke::geometry::cover::cover;
use bespoke::geometry::mesh::TriangleMesh;
use bespoke::input::diagnostic::{Diagnostic, DiagnosticKind, Element, LimbPlace, Severity, Subject};
use bespoke::input::skeleton::Skeleton;
use bespoke::options::Options;
use bespoke::session::{Precision, Session};
use bespoke::verify::intersections;
use closet::Sample;
use closet::avatars::{Avatar, avatar};
use closet::garments::{Garment, garment};
use closet::skeleton::{ARMS, BONES};
use glam::{DQuat, DVec3};
use testing::Random;

use crate::blocked::two_boxes;
use crate::small::{session, tube};

fn kinds(session: &Session) -> Vec<DiagnosticKind> {
    session.diagnostics().iter().map(|d| d.kind()).collect()
}

const RINGS: u32 = 40;
const SIDES: u32 = 48;

/// A sleeve with a seam along it, whose one side is `apart` from the other; the vertices of both sides.
fn with_seam(apart: f64) -> (TriangleMesh, Vec<[usize; 2]>) {
    let mut sleeve = tube(-0.6, 0.7, |z, _| 0.3 + 0.03 * (12.0 * z).sin(), RINGS, SIDES, false);
    let mut random = Random::new(12);
    let first = sleeve.positions.len() as u32;
    let seam: Vec<[usize; 2]> = (0..=RINGS).map(|r| [(r * SIDES) as usize, (first + r) as usize]).collect();
    for &[own, _] in &seam {
        sleeve.positions.push(sleeve.positions[own] + apart * random.vector().normalize());
    }
    // What comes to the seam from the one side has the copies.
    for t in &mut sleeve.triangles {
        if t.iter().any(|v| v % SIDES > SIDES / 2) {
            t.iter_mut().filter(|v| v.is_multiple_of(SIDES)).for_each(|v| *v = first + *v / SIDES);
        }
    }
    (sleeve, seam)
}

/// Seams whose sides are 20 micrometres apart are no borders: they stay closed, to the bit, and what was done is said. Without that
/// the garment comes apart there.
#[test]
fn a_seam_that_is_apart_by_a_hair_stays_closed() {
    const APART: f64 = 20e-6;
    let (garment, seam) = with_seam(APART);
    let dressed = |weld_distance: f64| {
        let mut session = session(1.0, DVec3::ZERO);
        session.set_garment(garment.clone(), Precision::F64).unwrap();
        session.set_options(Options { weld_distance, ..Options::default() }).unwrap();
        assert_eq!(session.run().unwrap(), Stage::Done);
        assert!(session.verify(Precision::F64).unwrap().is_clean());
        let x = session.garment_positions().unwrap();
        assert_eq!(x.len(), garment.positions.len());
        let widest = seam.iter().map(|&[a, b]| x[a].distance(x[b])).fold(0.0, f64::max);
        (session, widest)
    };
    let (closed, widest) = dressed(Options::default().weld_distance);
    let found = closed.diagnostics().iter().find(|d| d.kind() == DiagnosticKind::WeldedNear).expect("it is said");
    let own = seam.iter().flatten().map(|&v| Element::vertex(Subject::Garment, v as u32)).collect::<Vec<_>>();
    assert!(!found.elements().is_empty() && found.elements().iter().all(|e| own.contains(e)), "{found:?}");
    assert_eq!((found.severity(), widest), (Severity::Note, 0.0));
    let (open, apart) = dressed(0.0);
    println!("a seam of {APART}: {widest} where it is closed, {apart} where it is not");
    assert!(apart > 50.0 * APART && !kinds(&open).contains(&DiagnosticKind::WeldedNear), "{apart}");
}

/// An arm whose hand goes on beyond the wrist, and a sleeve to the wrist that turns aside from `from` on.
fn turned_sleeve(aside: f64, from: f64) -> (Session, TriangleMesh, TriangleMesh) {
    let joints = [DVec3::new(0.0, 0.0, -1.0), DVec3::ZERO, DVec3::new(0.0, 0.0, 0.6)];
    let skeleton = Skeleton { joints: joints.to_vec(), bones: vec![[0, 1], [1, 2]] };
    let straight = |p: &mut DVec3| p.x -= 0.2 * p.z.max(0.0);
    let mut garment = tube(-0.7, 0.75, |_, _| 0.16, 32, 18, false);
    garment.positions.iter_mut().for_each(|p| {
        straight(p);
        p.x += aside * (p.z - from).max(0.0);
    });
    let mut body = tube(-1.1, 1.2, |_, _| 0.12, 36, 16, true);
    body.positions.iter_mut().for_each(straight);
    let mut session = Session::new();
    session.set_garment(garment.clone(), Precision::F64).unwrap();
    session.set_source_skeleton(skeleton.clone()).unwrap();
    session.set_target_avatar(body.clone()).unwrap();
    session.set_target_skeleton(skeleton).unwrap();
    (session, garment, body)
}

/// Of the hand beyond the cuff, the share that is out of the sleeve.
fn out_of_sleeve(session: &Session, garment: &TriangleMesh, body: &TriangleMesh) -> f64 {
    let x = session.garment_positions().unwrap();
    let sleeve = TriangleMesh { positions: x, triangles: garment.triangles.clone() };
    let tree = ClosestPoint::new(&sleeve);
    let hand: Vec<DVec3> = body.positions.iter().copied().filter(|p| p.z > 0.85).collect();
    hand.iter().filter(|&&p| cover(&tree, p) < 0.5).count() as f64 / hand.len() as f64
}

/// What a sleeve that turns aside leads the arm through is pulled back before the work, and comes out of the cuff as the arm grows;
/// where it stays in, that is no success.
#[test]
fn a_hand_that_is_pulled_back_comes_out_of_its_sleeve_or_is_said() {
    let (mut straight, garment, body) = turned_sleeve(0.0, 0.3);
    assert_eq!(straight.run().unwrap(), Stage::Done);
    assert_eq!((kinds(&straight), out_of_sleeve(&straight, &garment, &body)), (Vec::new(), 1.0));
    for aside in [0.5, 0.9] {
        let (mut session, garment, body) = turned_sleeve(aside, 0.3);
        assert_eq!(session.run().unwrap(), Stage::Done);
        assert!(session.verify(Precision::F64).unwrap().is_clean());
        assert!(kinds(&session).contains(&DiagnosticKind::AvatarPenetrates), "{:?}", session.diagnostics());
        let out = out_of_sleeve(&session, &garment, &body);
        assert!(out == 1.0, "{aside}: {out} of the hand is out of the sleeve");
    }
    let (mut shut, garment, body) = turned_sleeve(1.2, 0.0);
    assert_eq!(shut.run().unwrap_err().kind, ErrorKind::ImplausibleResult);
    assert!(shut.verify(Precision::F64).unwrap().is_clean());
    let is_hand = |d: &Diagnostic| matches!(d, Diagnostic::LimbMisplaced { bone, .. } if bone.index == 1);
    assert!(shut.diagnostics().iter().any(is_hand), "{:?}", shut.diagnostics());
    assert_eq!(out_of_sleeve(&shut, &garment, &body), 0.0);
}

/// A sweater whose skeleton's arms are lowered by so many degrees beside its sleeves, on the slim body.
fn with_lowered_arms(degrees: f64) -> Session {
    let (sweater, body) = (garment(Garment::Sweater), avatar(Avatar::Slim));
    let mut joints = sweater.skeleton.joints.to_vec();
    for [shoulder, elbow, wrist] in ARMS {
        let at = joints[shoulder];
        let turn = DQuat::from_axis_angle(DVec3::Y, at.x.signum() * degrees.to_radians());
        for j in [elbow, wrist] {
            joints[j] = at + turn * (joints[j] - at);
        }
    }
    let mesh = |sample: &Sample| TriangleMesh {
        positions: sample.mesh.positions.clone(),
        triangles: sample.mesh.triangles.clone(),
    };
    let mut session = Session::new();
    session.set_garment(mesh(&sweater), Precision::F64).unwrap();
    session.set_source_skeleton(Skeleton { joints, bones: BONES.to_vec() }).unwrap();
    session.set_target_avatar(mesh(&body)).unwrap();
    let target = Skeleton { joints: body.skeleton.joints.to_vec(), bones: BONES.to_vec() };
    session.set_target_skeleton(target).unwrap();
    session
}

/// Arms that are a little beside their sleeves find their way into them. By more they do not: that is said of the result, and from
/// where it is sure on before the work.
#[test]
fn arms_beside_their_sleeves_come_into_them_or_it_is_said() {
    let mut near = with_lowered_arms(15.0);
    assert_eq!(near.run().unwrap(), Stage::Done);
    assert!(near.verify(Precision::F64).unwrap().is_clean());

    let mut beside = with_lowered_arms(32.0);
    assert_eq!(beside.run().unwrap_err().kind, ErrorKind::ImplausibleResult);
    assert!(beside.verify(Precision::F64).unwrap().is_clean());
    let misplaced = beside.diagnostics().iter().filter_map(|d| match d {
        Diagnostic::LimbMisplaced { bone, place: LimbPlace::OutOfOpening { .. } } => Some(bone.joints),
        _ => None,
    });
    let misplaced: Vec<[u32; 2]> = misplaced.collect();
    for [shoulder, elbow, _] in ARMS {
        assert!(misplaced.contains(&[shoulder as u32, elbow as u32]), "{misplaced:?}");
    }

    let mut refused = with_lowered_arms(45.0);
    assert_eq!(refused.run().unwrap_err().kind, ErrorKind::NotEnclosed);
    assert_eq!((iterations(&refused), refused.stage()), (0, Stage::Setup));
}

fn iterations(session: &Session) -> u32 {
    session.report().inflate.iterations + session.report().fit.iterations
}

/// What is refused at once takes no iteration, and what is held between two parts of the body no more than a result between parts
/// that leave it a narrow gap: an attempt is over where t comes to a stand between such parts.
#[test]
fn a_refusal_takes_no_more_than_a_result() {
    let mut narrow = two_boxes(0.004, Options::default());
    assert_eq!(narrow.run().unwrap(), Stage::Done);
    let success = iterations(&narrow);
    for gap in [0.0, -0.1, -0.3] {
        let mut held = two_boxes(gap, Options::default());
        assert_eq!(held.run().unwrap_err().kind, ErrorKind::InflationStalled);
        println!("{} iterations for a gap of {gap}, {success} for a narrow one", iterations(&held));
        assert!(iterations(&held) <= success, "{} {success}", iterations(&held));
        assert!(kinds(&held).contains(&DiagnosticKind::InflationBlocked));
    }
    let mut refused = session(1.0, DVec3::ZERO);
    let mut garment = tube(-0.6, 0.7, |_, _| 0.3, 16, 20, false);
    garment.positions.iter_mut().for_each(|p| *p *= 100.0);
    refused.set_garment(garment, Precision::F64).unwrap();
    assert_eq!(refused.run().unwrap_err().kind, ErrorKind::NotEnclosed);
    assert_eq!((iterations(&refused), refused.stage()), (0, Stage::Setup));
    assert!(kinds(&refused).contains(&DiagnosticKind::UnitMismatch), "{:?}", refused.diagnostics());
}

/// A sleeve and its lining whose vertices are off their places, so that the two pass through each other and themselves; at last by as
/// much as their edges are long.
#[test]
fn a_jittered_garment_is_pulled_apart_and_stays_so() {
    for (amount, least) in [(0.005, 50), (0.01, 1000), (0.03, 8000)] {
        let mut random = Random::new(4);
        let mut garment = tube(-0.6, 0.7, |z, _| 0.3 + 0.03 * (12.0 * z).sin(), RINGS, SIDES, false);
        let first = garment.positions.len() as u32;
        let lining = tube(-0.55, 0.65, |z, _| 0.29 + 0.03 * (12.0 * z).sin(), RINGS - 2, SIDES - 3, false);
        garment.positions.extend(lining.positions);
        garment.triangles.extend(lining.triangles.iter().map(|t| t.map(|v| v + first)));
        garment.positions.iter_mut().for_each(|p| *p += amount * random.vector());
        let count = |positions: &[DVec3]| {
            let mesh = TriangleMesh { positions: positions.to_vec(), triangles: garment.triangles.clone() };
            intersections(&mesh, None, 0).unwrap().count
        };
        let before = count(&garment.positions);
        assert!(before > least, "{before}");
        let mut session = session(1.0, DVec3::ZERO);
        session.set_garment(garment.clone(), Precision::F64).unwrap();
        assert_eq!(session.run().unwrap(), Stage::Done);
        let counted = session.verify(Precision::F64).unwrap();
        let after = count(&session.garment_positions().unwrap());
        println!(
            "{amount}: {before} pairs pass through each other in the design, {after} in the result; {} iterations",
            iterations(&session)
        );
        assert_eq!((after, counted.garment_garment, counted.initial, counted.garment_avatar), (0, 0, 0, 0));
        assert!(kinds(&session).contains(&DiagnosticKind::SelfIntersection));
    }
}
