//! Curves that a caller names.

use bespoke::control::Stage;
use bespoke::error::ErrorKind;
use bespoke::geometry::mesh::TriangleMesh;
use bespoke::input::skeleton::Skeleton;
use bespoke::session::{Curve, Precision, Session};
use glam::DVec3;

use crate::small::{arm, session, sleeve, tube};

const SIDES: u32 = 20;
/// The vertices of one ring of the sleeve.
const LOW: std::ops::Range<u32> = 0..SIDES;

fn high() -> std::ops::Range<u32> {
    let count = sleeve().positions.len() as u32;
    count - SIDES..count
}

fn closed(vertices: impl IntoIterator<Item = u32>, curve_weight: f64, position_weight: f64) -> Curve {
    Curve { vertices: vertices.into_iter().collect(), closed: true, curve_weight, position_weight }
}

fn open(vertices: impl IntoIterator<Item = u32>, curve_weight: f64, position_weight: f64) -> Curve {
    Curve { closed: false, ..closed(vertices, curve_weight, position_weight) }
}

/// The arm with a forearm 1.8 times as long, and a body around it.
fn longer() -> (Skeleton, TriangleMesh) {
    let mut skeleton = arm(1.0, DVec3::ZERO);
    skeleton.joints[2] *= 1.8;
    let mut body = tube(-1.1, 1.15, |_, _| 0.36, 14, 18, true);
    for p in body.positions.iter_mut().filter(|p| p.z > 0.0) {
        *p = DVec3::new(p.x + 0.2 * 0.8 * p.z, p.y, 1.8 * p.z);
    }
    (skeleton, body)
}

/// The sleeve on that, with curves named.
fn dressed(curves: &[Curve]) -> Vec<DVec3> {
    let (skeleton, body) = longer();
    let mut session = session(1.0, DVec3::ZERO);
    session.set_target_avatar(body).unwrap();
    session.set_target_skeleton(skeleton).unwrap();
    run(&mut session, curves)
}

fn run(session: &mut Session, curves: &[Curve]) -> Vec<DVec3> {
    curves.iter().for_each(|curve| session.add_curve(curve.clone()).unwrap());
    assert_eq!(session.run().unwrap(), Stage::Done);
    assert!(session.verify(Precision::F32).unwrap().is_clean());
    session.garment_positions().unwrap()
}

/// The mean place of vertices along the forearm, the elbow at 0.
fn place(x: &[DVec3], vertices: impl ExactSizeIterator<Item = u32>, skeleton: &Skeleton) -> f64 {
    let along = skeleton.joints[2];
    let count = vertices.len() as f64;
    vertices.map(|v| x[v as usize].dot(along) / along.length_squared()).sum::<f64>() / count
}

#[test]
fn a_boundary_that_is_named_is_what_it_was() {
    let plain = run(&mut session(1.0, DVec3::ZERO), &[]);
    // Backwards, and from another vertex on.
    let turned = high().rev().map(|v| if v >= high().start + 3 { v - 3 } else { v + SIDES - 3 });
    let named = [closed(LOW, 1.0, 1.0), closed(turned, 1.0, 1.0)];
    assert_eq!(run(&mut session(1.0, DVec3::ZERO), &named), plain);
    let mut session = session(1.0, DVec3::ZERO);
    session.add_curve(closed(LOW, 0.0, 0.0)).unwrap();
    session.clear_curves().unwrap();
    assert_eq!(run(&mut session, &[]), plain);
    assert_eq!(session.add_curve(closed(LOW, 0.0, 0.0)).unwrap_err().kind, ErrorKind::InvalidState);
    assert_eq!(session.clear_curves().unwrap_err().kind, ErrorKind::InvalidState);
}

#[test]
fn one_cuff_is_held_and_the_other_let_go() {
    let (skeleton, _) = longer();
    let designed = place(&sleeve().positions, high(), &arm(1.0, DVec3::ZERO));
    let held = place(&dressed(&[closed(LOW, 1.0, 0.0)]), high(), &skeleton);
    let free = place(&dressed(&[closed(high(), 1.0, 0.0)]), high(), &skeleton);
    assert!((held - designed).abs() < 0.05, "{held}, designed {designed}");
    assert!((free - designed).abs() > 0.1, "{free}, designed {designed}");
}

/// A seam line along the forearm, whose cuff is let go: each vertex keeps its place along its bone.
#[test]
fn a_seam_line_keeps_its_place() {
    let (skeleton, _) = longer();
    let rest = sleeve().positions;
    // One vertex a ring, from the elbow on.
    let seam: Vec<u32> = (8..=16).map(|ring| ring * SIDES).collect();
    let off = |x: &[DVec3]| {
        let at = |v: u32| {
            let one = || std::iter::once(v);
            (place(x, one(), &skeleton) - place(&rest, one(), &arm(1.0, DVec3::ZERO))).abs()
        };
        seam.iter().map(|&v| at(v)).fold(0.0, f64::max)
    };
    let cuff = closed(high(), 1.0, 0.0);
    let free = off(&dressed(std::slice::from_ref(&cuff)));
    let held = off(&dressed(&[cuff, open(seam.iter().copied(), 0.0, 30.0)]));
    assert!(held < 0.3 * free && free > 0.1, "{held}, without it {free}");
}

/// On an arm with three bulges a cuff stays the rounder, the more its shape weighs.
#[test]
fn a_curve_keeps_its_shape_as_much_as_it_weighs() {
    let out_of_round = |weight: f64| {
        let x = run(&mut session(1.0, DVec3::ZERO), &[closed(high(), weight, 1.0)]);
        let ring: Vec<DVec3> = high().map(|v| x[v as usize]).collect();
        let centre = ring.iter().sum::<DVec3>() / f64::from(SIDES);
        let radii: Vec<f64> = ring.iter().map(|p| p.distance(centre)).collect();
        let mean = radii.iter().sum::<f64>() / f64::from(SIDES);
        radii.iter().map(|r| (r / mean - 1.0).abs()).fold(0.0, f64::max)
    };
    let [none, much] = [0.0, 50.0].map(out_of_round);
    assert!(much < 0.7 * none, "{much}, without the term {none}");
}

#[test]
fn bad_curves_are_refused() {
    let mut session = session(1.0, DVec3::ZERO);
    let mut refused = |curve: Curve, words: &[&str]| {
        let error = session.add_curve(curve).unwrap_err();
        assert_eq!(error.kind, ErrorKind::InvalidArgument);
        assert!(words.iter().all(|word| error.message.contains(word)), "{}", error.message);
    };
    refused(closed([0, 1], 1.0, 1.0), &["curve 0", "2 places", "closed", "3"]);
    refused(open([7], 1.0, 1.0), &["curve 0", "1 places", "open", "2"]);
    refused(open([], 1.0, 1.0), &["curve 0", "0 places"]);
    refused(open([0, 1, 0], 1.0, 1.0), &["vertex 0 is listed twice"]);
    refused(open([0, 1], -1.0, 1.0), &["curve weight is -1"]);
    refused(open([0, 1], 1.0, f64::NAN), &["position weight is NaN"]);
    refused(open([0, 1], 1.0, 1e7), &["position weight is 10000000", "1e6"]);
    let count = sleeve().positions.len() as u32;
    let bad: [(&[Curve], &[&str]); 4] = [
        (&[open([0, count], 1.0, 1.0)], &["curve 0: lists vertex", &count.to_string()]),
        (&[open([0, 1], 1.0, 1.0), open([2, 3, 5], 1.0, 1.0)], &["curve 1: no edge", "vertices 3 and 5"]),
        (&[closed(0..SIDES - 1, 1.0, 1.0)], &["curve 0: no edge", "vertices 18 and 0"]),
        (&[open([0, 1, 2], 1.0, 1.0), open([2, 1, 0], 2.0, 1.0)], &["curve 1", "curve 0"]),
    ];
    for (curves, words) in bad {
        session.clear_curves().unwrap();
        curves.iter().for_each(|curve| session.add_curve(curve.clone()).unwrap());
        let error = session.prepare().unwrap_err();
        assert_eq!(error.kind, ErrorKind::InvalidArgument);
        assert!(words.iter().all(|word| error.message.contains(word)), "{}", error.message);
    }
    session.clear_curves().unwrap();
    session.prepare().unwrap();
}
