//! What an artist asks of the fit: clearance, region, pins, rigid groups.

use bespoke::control::Stage;
use bespoke::error::ErrorKind;
use bespoke::geometry::closest_point::ClosestPoint;
use bespoke::geometry::mesh::TriangleMesh;
use bespoke::input::coordinate_system::CoordinateSystem;
use bespoke::input::diagnostic::{DiagnosticKind, Element, Severity, Subject};
use bespoke::options::Options;
use bespoke::session::{Pin, Precision, Session};
use glam::DVec3;

use crate::small::{arm, session, sleeve, thick_arm, tube};

/// A thin arm inside the sleeve.
fn thin_arm() -> TriangleMesh {
    tube(-1.1, 1.15, |_, _| 0.2, 14, 18, true)
}

fn dressed(session: &mut Session) -> Vec<DVec3> {
    assert_eq!(session.run().unwrap(), Stage::Done);
    assert!(session.verify(Precision::F32).unwrap().is_clean());
    session.garment_positions().unwrap()
}

/// Distances of the garment's vertices to the body.
fn clearances(x: &[DVec3], body: &TriangleMesh) -> Vec<f64> {
    let body = ClosestPoint::new(body);
    x.iter().map(|&p| body.distance(p)).collect()
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

/// The sleeve on the thin arm, with these options.
fn on_the_thin_arm(options: Options) -> Session {
    let mut session = session(1.0, DVec3::ZERO);
    session.set_target_avatar(thin_arm()).unwrap();
    session.set_options(options).unwrap();
    session
}

#[test]
fn an_offset_is_kept_from_both_sides() {
    // The sleeve was designed 0.1 off the thin arm: a smaller offset draws it in, a larger one pushes it out.
    for offset in [0.04, 0.2] {
        let x = dressed(&mut on_the_thin_arm(Options { offset, fit_weight: 300.0, ..Options::default() }));
        let away = clearances(&x, &thin_arm());
        assert!((mean(&away) - offset).abs() < 0.1 * offset, "{} instead of {offset}", mean(&away));
    }
}

#[test]
fn an_offset_is_in_the_unit_of_the_target() {
    let space = CoordinateSystem { metres_per_unit: 0.01, ..CoordinateSystem::default() };
    let options = Options { fit_weight: 300.0, ..Options::default() };
    let mut metres = on_the_thin_arm(Options { offset: 0.05, ..options.clone() });
    let mut centimetres = on_the_thin_arm(Options { offset: 5.0, ..options });
    let larger = |p: &DVec3| 100.0 * *p;
    let mut body = thin_arm();
    body.positions = body.positions.iter().map(larger).collect();
    centimetres.set_target_avatar(body).unwrap();
    centimetres.set_target_skeleton(arm(100.0, DVec3::ZERO)).unwrap();
    centimetres.set_target_coordinate_system(space).unwrap();
    let (x, y) = (dressed(&mut metres), dressed(&mut centimetres));
    let apart = x.iter().zip(&y).map(|(p, q)| (100.0 * *p).distance(*q)).fold(0.0, f64::max);
    assert!(apart < 0.1, "{apart}");
}

/// A cuff that fits and a wide bell below it.
fn bell() -> TriangleMesh {
    tube(-0.7, 0.7, |z, _| if z > 0.0 { 0.24 } else { 0.24 - 0.6 * z }, 16, 20, false)
}

#[test]
fn what_was_designed_far_from_the_body_hangs() {
    let target = tube(-1.1, 1.15, |_, _| 0.15, 14, 18, true);
    let bells = |fit_distance: f64, clearance: f64| {
        let mut session = session(1.0, DVec3::ZERO);
        session.set_garment(bell(), Precision::F32).unwrap();
        session.set_source_avatar(thin_arm()).unwrap();
        session.set_target_avatar(target.clone()).unwrap();
        let options = Options { fit_distance, designed_clearance: clearance, fit_weight: 100.0, ..Options::default() };
        session.set_options(options).unwrap();
        clearances(&dressed(&mut session), &target)
    };
    let [region, all] = [0.1, f64::INFINITY].map(|fit_distance| bells(fit_distance, 0.0));
    // The first rings are the bell's rim, the last ones the cuff.
    let (rim, cuff) = (0..60, 280..340);
    assert!(mean(&region[cuff.clone()]) < 0.05, "the cuff stays {} away", mean(&region[cuff]));
    let [hanging, drawn] = [&region, &all].map(|c| mean(&c[rim.clone()]));
    assert!(hanging > 0.1 && drawn < 0.3 * hanging, "the rim is {hanging} away, and {drawn} where all fits");
}

#[test]
fn the_designed_clearance_comes_back_in_proportion_where_the_body_is_thicker() {
    let run = |designed_clearance: f64| {
        let mut session = session(1.0, DVec3::ZERO);
        session.set_source_avatar(thin_arm()).unwrap();
        session.set_options(Options { designed_clearance, fit_weight: 100.0, ..Options::default() }).unwrap();
        mean(&clearances(&dressed(&mut session), &thick_arm()))
    };
    // The thick arm is 0.36 + 0.1 z^2 thick where the thin one is 0.2, and so much looser the sleeve is to be.
    let thicker = |p: &DVec3| (0.36 + 0.1 * p.z * p.z) / 0.2;
    let ratios: Vec<f64> = sleeve().positions.iter().map(thicker).collect();
    let designed = mean(&clearances(&sleeve().positions, &thin_arm())) * mean(&ratios);
    let [tight, half, full] = [0.0, 0.5, 1.0].map(run);
    assert!(tight < 0.3 * designed && tight < half && half < full, "{tight} {half} {full}, designed {designed}");
    assert!((full - designed).abs() < 0.1 * designed, "{full} instead of {designed}");
}

#[test]
fn pins_hold_their_places() {
    let rest = sleeve().positions;
    let last = rest.len() as u32 - 20;
    // One end of the sleeve goes with its bone, and a vertex of the other to a place of its own.
    let place = rest[3] + DVec3::new(0.3, 0.1, -0.1);
    let mut pins: Vec<Pin> = (last..rest.len() as u32).map(|vertex| Pin { vertex, target: None }).collect();
    pins.push(Pin { vertex: 3, target: Some(place) });
    let mut session = session(1.0, DVec3::ZERO);
    session.set_target_avatar(thin_arm()).unwrap();
    let free = dressed(&mut session);
    session.reset();
    session.set_pins(pins).unwrap();
    let x = dressed(&mut session);
    assert!(x[3].distance(place) < 0.004 && free[3].distance(place) > 0.1, "{}", x[3].distance(place));
    for v in last as usize..rest.len() {
        assert!(x[v].distance(rest[v]) < 0.004, "vertex {v} is {} away", x[v].distance(rest[v]));
    }
    assert!(free[last as usize].distance(rest[last as usize]) > 0.02);
    assert!(session.diagnostics().iter().all(|f| f.kind() != DiagnosticKind::PinNotReached));
}

#[test]
fn a_pin_inside_the_body_is_reported() {
    let mut session = session(1.0, DVec3::ZERO);
    let inside = DVec3::new(0.0, 0.0, 0.1);
    session.set_pins(vec![Pin { vertex: 170, target: Some(inside) }]).unwrap();
    let x = dressed(&mut session);
    let diagnostic =
        session.diagnostics().iter().find(|f| f.kind() == DiagnosticKind::PinNotReached).expect("a diagnostic");
    assert_eq!(diagnostic.elements(), [Element::vertex(Subject::Garment, 170)]);
    assert_eq!(diagnostic.severity(), Severity::Warning);
    assert!(
        (diagnostic.distance() - x[170].distance(inside)).abs() < 1e-3 && diagnostic.distance() > 0.2,
        "{diagnostic}"
    );
}

/// The largest change of the distance between two vertices of `group`.
fn strain(x: &[DVec3], rest: &[DVec3], group: &[u32]) -> f64 {
    let pair = |v: u32, w: u32| {
        let [now, was] = [x, rest].map(|p| p[v as usize].distance(p[w as usize]));
        (now - was).abs()
    };
    group.iter().flat_map(|&v| group.iter().map(move |&w| pair(v, w))).fold(0.0, f64::max)
}

#[test]
fn rigid_groups_keep_their_shape() {
    let rest = sleeve().positions;
    // A plate on one side of the sleeve, five rings high, and a small one on the other.
    let patch = |rings: std::ops::Range<u32>, sides: std::ops::Range<u32>| -> Vec<u32> {
        rings.flat_map(|r| sides.clone().map(move |s| 20 * r + s)).collect()
    };
    let groups = [patch(5..10, 0..5), patch(11..13, 11..13)];
    let mut session = session(1.0, DVec3::ZERO);
    let free = dressed(&mut session);
    session.reset();
    for group in &groups {
        session.add_rigid_group(group.clone()).unwrap();
    }
    let x = dressed(&mut session);
    for group in &groups {
        let [bent, kept] = [&free, &x].map(|x| strain(x, &rest, group));
        assert!(bent > 0.01, "without the group it is bent by {bent}");
        assert!(kept < 1e-9, "the group is bent by {kept}");
    }
    assert!(session.diagnostics().iter().all(|f| f.kind() != DiagnosticKind::RigidGroupBent));
    // The rest of the sleeve still gives way.
    assert!(strain(&x, &rest, &patch(0..1, 0..20)) > 0.01);
}

#[test]
fn split_vertices_share_groups_and_pins() {
    let mut garment = sleeve();
    let copy = garment.positions.len() as u32;
    garment.positions.push(garment.positions[7]);
    garment.triangles.iter_mut().take(15).flatten().filter(|v| **v == 7).for_each(|v| *v = copy);
    let with = |change: &dyn Fn(&mut Session)| {
        let mut session = session(1.0, DVec3::ZERO);
        session.set_garment(garment.clone(), Precision::F32).unwrap();
        change(&mut session);
        session.prepare()
    };
    let pin = |vertex: u32, x: f64| Pin { vertex, target: Some(DVec3::new(x, 0.0, 0.0)) };
    assert!(with(&|s| s.set_pins(vec![pin(7, 1.0), pin(copy, 1.0)]).unwrap()).is_ok());
    let error = with(&|s| s.set_pins(vec![pin(7, 1.0), pin(copy, 2.0)]).unwrap()).unwrap_err();
    assert_eq!(error.kind, ErrorKind::InvalidArgument);
    assert!(error.message.contains(&format!("vertices 7 and {copy}")), "{}", error.message);
    assert!(with(&|s| s.add_rigid_group(vec![7, 8, copy]).unwrap()).is_ok());
    let error = with(&|s| {
        s.add_rigid_group(vec![7, 8]).unwrap();
        s.add_rigid_group(vec![30, copy]).unwrap();
    })
    .unwrap_err();
    assert!(error.message.contains("rigid group 1") && error.message.contains("rigid group 0"), "{}", error.message);
}

#[test]
fn bad_requests_are_refused_with_a_sentence() {
    let refused = |change: &dyn Fn(&mut Session) -> bespoke::error::Result<()>, says: &str| {
        let mut session = session(1.0, DVec3::ZERO);
        let error = change(&mut session).and_then(|()| session.prepare()).unwrap_err();
        assert_eq!(error.kind, ErrorKind::InvalidArgument, "{}", error.message);
        assert!(error.message.contains(says), "{}", error.message);
    };
    let pin = |vertex: u32| Pin { vertex, target: None };
    refused(&|s| s.set_pins(vec![pin(1), pin(5), pin(1)]), "vertex 1 is listed twice");
    refused(&|s| s.set_pins(vec![Pin { vertex: 4, target: Some(DVec3::NAN) }]), "vertex 4 is not finite");
    refused(&|s| s.set_pins(vec![pin(100_000)]), "vertex 100000");
    refused(&|s| s.add_rigid_group(Vec::new()), "rigid group 0");
    refused(&|s| s.add_rigid_group(vec![1, 100_000]), "vertex 100000");
    refused(&|s| s.add_rigid_group(vec![1, 2]).and_then(|()| s.add_rigid_group(vec![3, 2])), "vertex 2");
    refused(&|s| s.set_options(Options { offset: -1.0, ..Options::default() }), "offset");
    refused(&|s| s.set_options(Options { offset: 5.0, ..Options::default() }), "offset is 5");
    refused(&|s| s.set_options(Options { fit_distance: 0.0, ..Options::default() }), "fit_distance");
}
