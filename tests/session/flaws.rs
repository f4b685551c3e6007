//! Garments with flaws: faces that are missing, and T-junctions. They take little more than what is whole.

use bespoke::control::Stage;
use bespoke::geometry::closest_point::closest_on_segment;
use bespoke::geometry::mesh::TriangleMesh;
use bespoke::input::diagnostic::DiagnosticKind;
use bespoke::session::{Precision, Session};
use glam::DVec3;
use testing::Random;

use crate::small::{session, tube};

fn fine() -> TriangleMesh {
    tube(-0.6, 0.7, |z, _| 0.3 + 0.03 * (12.0 * z).sin(), 40, 48, false)
}

/// Without a share of its faces.
fn net(share: f64) -> TriangleMesh {
    let mut random = Random::new(5);
    let mut garment = fine();
    garment.triangles.retain(|_| random.unit() >= share);
    garment
}

/// With `count` faces split at the middle of a side, and not those beside them. The new vertices and the ends of their sides.
fn split(count: usize) -> (TriangleMesh, Vec<(u32, [u32; 2])>) {
    let mut random = Random::new(7);
    let mut garment = fine();
    let whole = garment.triangles.clone();
    let mut is_taken = vec![false; whole.len()];
    let mut junctions = Vec::new();
    while junctions.len() < count {
        let t = ((random.unit() * whole.len() as f64) as usize).min(whole.len() - 1);
        let [a, b, c] = whole[t];
        let beside = whole.iter().position(|other| *other != whole[t] && other.contains(&a) && other.contains(&b));
        let Some(beside) = beside.filter(|&beside| !is_taken[t] && !is_taken[beside]) else { continue };
        (is_taken[t], is_taken[beside]) = (true, true);
        let m = garment.positions.len() as u32;
        // As a file of eight digits has it.
        let middle: DVec3 = 0.5 * (garment.positions[a as usize] + garment.positions[b as usize]);
        garment.positions.push((middle * 1e8).round() / 1e8);
        garment.triangles[t] = [a, m, c];
        garment.triangles.push([m, b, c]);
        junctions.push((m, [a, b]));
    }
    (garment, junctions)
}

fn dressed(garment: &TriangleMesh) -> (Session, Vec<DVec3>) {
    let mut session = session(1.0, DVec3::ZERO);
    session.set_garment(garment.clone(), Precision::F64).unwrap();
    assert_eq!(session.run().unwrap(), Stage::Done);
    let x = session.garment_positions().unwrap();
    (session, x)
}

fn iterations(session: &Session) -> u32 {
    session.report().inflate.iterations + session.report().fit.iterations
}

fn is_adjusted(session: &Session) -> bool {
    session.diagnostics().iter().any(|diagnostic| diagnostic.kind() == DiagnosticKind::SettingsAdjusted)
}

#[test]
fn a_net_takes_little_more_than_what_is_whole() {
    let whole = iterations(&dressed(&fine()).0);
    for share in [0.06, 0.12] {
        let (session, _) = dressed(&net(share));
        println!("{share} {} {whole}", iterations(&session));
        assert!(session.verify(Precision::F64).unwrap().is_clean());
        assert!(!is_adjusted(&session) && iterations(&session) <= 3 * whole, "{} {whole}", iterations(&session));
    }
}

#[test]
fn t_junctions_stay_closed_and_hold_nothing() {
    let whole = iterations(&dressed(&fine()).0);
    let (garment, junctions) = split(400);
    let (session, x) = dressed(&garment);
    println!("{} {whole}", iterations(&session));
    assert!(!is_adjusted(&session) && iterations(&session) <= 3 * whole, "{} {whole}", iterations(&session));
    // Nothing intersects but the two sides of an edge, and those hardly.
    let verdict = session.verify(Precision::F64).unwrap();
    println!("{verdict:?}");
    assert_eq!(verdict.garment_avatar, 0);
    assert_eq!(verdict.garment_garment, verdict.initial);
    let [mut widest, mut longest] = [0.0_f64; 2];
    for (m, ends) in junctions {
        let [m, a, b] = [m, ends[0], ends[1]].map(|v| x[v as usize]);
        widest = widest.max(closest_on_segment(m, a, b - a).distance(m));
        longest = longest.max(a.distance(b));
    }
    println!("{widest} {longest}");
    assert!(widest < 0.03 * longest, "{widest} {longest}");
}
