//! Morphs: the garment's own go over to the result, and to the body's it has an answer.

use bespoke::control::Stage;
use bespoke::error::ErrorKind;
use bespoke::geometry::mesh::TriangleMesh;
use bespoke::input::coordinate_system::{Axis, CoordinateSystem};
use bespoke::input::diagnostic::{Diagnostic, DiagnosticKind};
use bespoke::session::{Budget, Morph, Precision, Session};
use bespoke::verify::intersections;
use glam::DVec3;

use crate::small::{arm, session, sleeve, tube};

pub fn body(radius: f64) -> TriangleMesh {
    tube(-1.1, 1.15, |_, _| radius, 14, 18, true)
}

/// The sleeve on an arm of this radius.
pub fn on(radius: f64) -> Session {
    let mut session = session(1.0, DVec3::ZERO);
    session.set_target_avatar(body(radius)).unwrap();
    session
}

pub fn thicker(from: f64, to: f64) -> Morph {
    let (from, to) = (body(from), body(to));
    let offsets = from.positions.iter().zip(&to.positions).map(|(a, b)| b - a).collect();
    Morph { name: "thicker".into(), offsets }
}

pub fn moved(points: &[DVec3], offsets: &[DVec3]) -> TriangleMesh {
    let positions = points.iter().zip(offsets).map(|(p, d)| Precision::F32.round(*p + *d)).collect();
    TriangleMesh { positions, triangles: sleeve().triangles }
}

/// The mean distance from the axis of the lower arm, where that is straight.
pub fn radius(points: &[DVec3]) -> f64 {
    let part: Vec<f64> = points.iter().filter(|p| p.z < -0.05).map(|p| p.truncate().length()).collect();
    part.iter().sum::<f64>() / part.len() as f64
}

#[test]
fn the_garment_answers_to_a_body_that_grows_and_shrinks() {
    let mut session = on(0.36);
    session.add_target_morph(thicker(0.36, 0.46)).unwrap();
    session.add_target_morph(thicker(0.36, 0.3)).unwrap();
    session.add_target_morph(thicker(0.36, 0.36)).unwrap();
    assert_eq!(session.solve_target_morphs().unwrap_err().kind, ErrorKind::InvalidState);
    assert_eq!(session.run().unwrap(), Stage::Done);
    assert!(session.target_morph(0).unwrap_err().message.contains("solve_target_morphs"));
    let (before, report) = (session.garment_positions().unwrap(), session.report());
    session.solve_target_morphs().unwrap();
    // The result stays as it is.
    assert_eq!(session.garment_positions().unwrap(), before);
    assert_eq!((session.stage(), session.control().progress().stage), (Stage::Done, Stage::Done));
    assert_eq!(session.report().fit.iterations, report.fit.iterations);
    assert!(session.verify(Precision::F32).unwrap().is_clean());
    for (index, to) in [(0, 0.46), (1, 0.3)] {
        let answer = session.target_morph(index).unwrap();
        let garment = moved(&before.iter().map(|&p| Precision::F32.round(p)).collect::<Vec<_>>(), &answer);
        assert_eq!(intersections(&garment, None, 0).unwrap().count, 0);
        assert_eq!(intersections(&garment, Some(&body(to)), 0).unwrap().count, 0);
        // As on that body from the beginning.
        let mut other = on(to);
        other.run().unwrap();
        let (found, wanted) = (radius(&garment.positions), radius(&other.garment_positions().unwrap()));
        assert!((found - wanted).abs() < 0.02, "{found} {wanted}, {} before", radius(&before));
    }
    assert!(session.target_morph(2).unwrap().iter().all(|&p| p == DVec3::ZERO));
    assert_eq!(session.target_morph(3).unwrap_err().kind, ErrorKind::InvalidArgument);
    // Once more, nothing is done; and after a reset nothing is known.
    session.solve_target_morphs().unwrap();
    session.reset();
    assert_eq!(session.target_morph(0).unwrap_err().kind, ErrorKind::InvalidState);
}

/// A layer between goes along.
#[test]
fn layers_go_along_with_the_body() {
    let mut session = on(0.34);
    session.add_layer(tube(-0.5, 0.4, |_, _| 0.36, 6, 18, false)).unwrap();
    session.add_target_morph(thicker(0.34, 0.42)).unwrap();
    session.run().unwrap();
    session.solve_target_morphs().unwrap();
    let garment = moved(&session.garment_positions().unwrap(), &session.target_morph(0).unwrap());
    let layer = tube(-0.5, 0.4, |_, _| 0.435, 6, 18, false);
    assert_eq!(intersections(&garment, Some(&layer), 0).unwrap().count, 0);
}

/// A body of two arms and what joins them, and how many of its vertices come before the second arm.
fn two_arms() -> (TriangleMesh, usize) {
    let mut all = body(0.36);
    let mut add = |mut other: TriangleMesh, place: &dyn Fn(DVec3) -> DVec3| {
        let first = all.positions.len();
        other.positions.iter_mut().for_each(|p| *p = place(*p));
        other.triangles.iter_mut().flatten().for_each(|v| *v += first as u32);
        all.positions.extend(other.positions);
        all.triangles.extend(other.triangles);
        first
    };
    add(tube(-0.1, 2.1, |_, _| 0.2, 12, 12, true), &|p| DVec3::new(p.z, p.y, p.x - 0.2 * p.z.max(0.0) - 1.0));
    let second = add(tube(-1.1, 1.15, |_, _| 0.3, 14, 18, true), &|p| p + 2.0 * DVec3::X);
    (all, second)
}

/// A session with them, and a morph in which the second comes nearer by so much.
pub fn two_arms_apart() -> (Session, impl Fn(f64) -> Morph) {
    let (body, second) = two_arms();
    let mut skeleton = arm(1.0, DVec3::ZERO);
    skeleton.joints.extend([DVec3::new(2.0, 0.0, -1.0), DVec3::new(2.1, 0.0, 1.0)]);
    skeleton.bones.extend([[0, 3], [3, 4]]);
    let mut session = session(1.0, DVec3::ZERO);
    session.set_source_skeleton(skeleton.clone()).unwrap();
    session.set_target_skeleton(skeleton).unwrap();
    let count = body.positions.len();
    session.set_target_avatar(body).unwrap();
    let morph = move |shift: f64| {
        let offsets = (0..count).map(|v| if v < second { DVec3::ZERO } else { shift * DVec3::X }).collect();
        Morph { name: "nearer".into(), offsets }
    };
    (session, morph)
}

/// The other arm comes to where the sleeve is.
#[test]
fn where_the_garment_does_not_give_way_a_diagnostic_says_so() {
    let (mut session, morph) = two_arms_apart();
    session.add_target_morph(morph(-2.0)).unwrap();
    session.add_target_morph(morph(-0.4)).unwrap();
    session.run().unwrap();
    session.solve_target_morphs().unwrap();
    let found: Vec<&Diagnostic> =
        session.diagnostics().iter().filter(|d| d.kind() == DiagnosticKind::MorphNotSolved).collect();
    let [Diagnostic::MorphNotSolved { morph: 0, weight, .. }] = found[..] else { panic!("{found:?}") };
    assert!((0.4..0.8).contains(weight), "{weight}");
    let error = session.target_morph(0).unwrap_err();
    assert!(error.message.contains("\"nearer\"") && error.kind == ErrorKind::InvalidState, "{error}");
    assert!(session.target_morph(1).is_ok());
}

#[test]
fn a_morph_in_another_unit_is_refused() {
    let mut session = on(0.36);
    let mut far = thicker(0.36, 0.46);
    far.offsets.iter_mut().for_each(|p| *p *= 1e3);
    session.add_target_morph(far).unwrap();
    session.run().unwrap();
    let error = session.solve_target_morphs().unwrap_err();
    assert_eq!(error.kind, ErrorKind::InvalidArgument);
    assert!(error.message.contains("target morph 0 (\"thicker\"): it moves a vertex"), "{error}");
    assert_eq!(session.stage(), Stage::Done);
}

#[test]
fn a_cancel_leaves_the_result() {
    let mut session = on(0.36);
    session.add_target_morph(thicker(0.36, 0.46)).unwrap();
    session.run().unwrap();
    let before = session.garment_positions().unwrap();
    let control = session.control();
    let watcher = std::thread::spawn(move || {
        while control.progress().stage == Stage::Done {
            std::thread::yield_now();
        }
        let stage = control.progress().stage;
        control.cancel();
        stage
    });
    assert_eq!(session.solve_target_morphs().unwrap_err().kind, ErrorKind::Cancelled);
    assert!(matches!(watcher.join().unwrap(), Stage::Repose | Stage::Fit));
    assert_eq!((session.stage(), session.control().progress().stage), (Stage::Done, Stage::Done));
    assert_eq!(session.garment_positions().unwrap(), before);
    // The request is answered, and the next call finds what this one did not.
    session.solve_target_morphs().unwrap();
    assert_eq!(session.target_morph(0).unwrap().len(), before.len());
}

/// A garment that comes out as it was designed keeps its morphs, in whichever coordinates they are read.
#[test]
fn the_garments_morphs_go_over() {
    let designed = sleeve();
    let size = |p: &DVec3| DVec3::new(0.1 * p.x, 0.1 * p.y, 0.02 * p.z.cos());
    let morph = Morph { name: "puffed".into(), offsets: designed.positions.iter().map(size).collect() };
    // Three times as large, in centimetres and with other axes.
    let system = CoordinateSystem {
        right: Axis::PositiveX,
        up: Axis::PositiveZ,
        forward: Axis::PositiveY,
        metres_per_unit: 0.01,
        ..CoordinateSystem::default()
    };
    let to = |p: DVec3| system.position_from_internal(3.0 * p);
    let mut session = session(1.0, DVec3::ZERO);
    session.set_target_coordinate_system(CoordinateSystem { trusted: true, ..system }).unwrap();
    let mut avatar = body(0.3);
    avatar.positions.iter_mut().for_each(|p| *p = to(*p));
    session.set_target_avatar(avatar).unwrap();
    let mut skeleton = arm(1.0, DVec3::ZERO);
    skeleton.joints.iter_mut().for_each(|p| *p = to(*p));
    session.set_target_skeleton(skeleton).unwrap();
    session.add_garment_morph(morph.clone()).unwrap();
    session.prepare().unwrap();
    // At the beginning it is the design, three times as large.
    for (found, &offset) in session.garment_morph(0).unwrap().iter().zip(&morph.offsets) {
        assert!(found.distance(to(offset)) < 1e-9, "{found} {}", to(offset));
    }
    session.step(Budget::default()).unwrap();
    let mean = |offsets: &[DVec3]| offsets.iter().map(|p| p.length()).sum::<f64>() / offsets.len() as f64;
    let (found, was) = (mean(&session.garment_morph(0).unwrap()), 300.0 * mean(&morph.offsets));
    assert!((found / was - 1.0).abs() < 0.35, "{found} {was}");
    assert_eq!(session.garment_morph(1).unwrap_err().kind, ErrorKind::InvalidArgument);
}

#[test]
fn what_does_not_fit_is_refused() {
    let mut session = on(0.36);
    let bad = Morph { name: "bad".into(), offsets: vec![DVec3::ZERO, DVec3::splat(f64::INFINITY)] };
    for error in [session.add_garment_morph(bad.clone()).unwrap_err(), session.add_target_morph(bad).unwrap_err()] {
        assert!(
            error.kind == ErrorKind::InvalidArgument && error.message.contains("(\"bad\"): the offset of vertex 1")
        );
    }
    let short = Morph { name: String::new(), offsets: vec![DVec3::ZERO; 2] };
    session.add_target_morph(short.clone()).unwrap();
    let error = session.prepare().unwrap_err();
    assert!(error.message.contains("target morph 0: there are 2 offsets, the target avatar has"), "{error}");
    session.clear_target_morphs().unwrap();
    session.add_garment_morph(short.clone()).unwrap();
    let error = session.prepare().unwrap_err();
    assert!(error.message.contains("garment morph 0: there are 2 offsets, the garment has"), "{error}");
    session.clear_garment_morphs().unwrap();
    session.prepare().unwrap();
    assert_eq!(session.add_garment_morph(short.clone()).unwrap_err().kind, ErrorKind::InvalidState);
    assert_eq!(session.add_target_morph(short).unwrap_err().kind, ErrorKind::InvalidState);
}
