//! A verified result that nobody would wear, and one that is not converged.

use bespoke::control::Stage;
use bespoke::error::ErrorKind;
use bespoke::geometry::mesh::TriangleMesh;
use bespoke::input::diagnostic::{DiagnosticKind, Element, Severity, Subject};
use bespoke::input::skeleton::Skeleton;
use bespoke::options::Options;
use bespoke::session::{PartRole, Pin, Precision, Session};
use closet::avatars::{Avatar, avatar};
use closet::garments::{Garment, garment};
use closet::skeleton::BONES;
use closet::{Kind, Sample, sample};
use glam::DVec3;

use crate::small::{session, sleeve};

/// The sleeve with a pouch at its side: a square of 32 triangles, whose first vertex and triangle are returned.
fn with_pouch() -> (TriangleMesh, [u32; 2]) {
    let mut mesh = sleeve();
    let [v, t] = [mesh.positions.len() as u32, mesh.triangles.len() as u32];
    let side = |k: u32| 0.05 * f64::from(k) - 0.1;
    for (i, j) in (0..5).flat_map(|i| (0..5).map(move |j| (i, j))) {
        mesh.positions.push(DVec3::new(0.6, side(i), side(j)));
    }
    for (i, j) in (0..4).flat_map(|i| (0..4).map(move |j| (i, j))) {
        let a = v + 5 * i + j;
        mesh.triangles.extend([[a, a + 5, a + 1], [a + 1, a + 5, a + 6]]);
    }
    (mesh, [v, t])
}

/// The sleeve with the pouch, whose vertices are pinned around one point at `scale` times their distance.
fn pinned(scale: f64) -> (Session, u32) {
    let (garment, [v, t]) = with_pouch();
    let middle = DVec3::new(0.9, 0.0, 0.0);
    let target = |v: u32| {
        let p = garment.positions[v as usize];
        middle + scale * (p - DVec3::new(0.6, 0.0, 0.0))
    };
    let pins = (v..v + 25).map(|v| Pin { vertex: v, target: Some(target(v)) }).collect();
    let mut session = session(1.0, DVec3::ZERO);
    session.set_garment(garment.clone(), Precision::F32).unwrap();
    session.set_pins(pins).unwrap();
    session.set_options(Options { pin_weight: 1e5, ..Options::default() }).unwrap();
    (session, t)
}

#[test]
fn an_implausible_result_has_a_status_of_its_own_and_can_be_read() {
    let (mut session, triangle) = pinned(0.06);
    let error = session.run().unwrap_err();
    assert_eq!(error.kind, ErrorKind::ImplausibleResult, "{error}");
    assert_eq!(session.stage(), Stage::Done);
    let found = session.diagnostics();
    let resized: Vec<_> = found.iter().filter(|d| d.kind() == DiagnosticKind::PieceResized).collect();
    assert_eq!(resized.len(), 1, "{found:?}");
    assert_eq!(resized[0].elements(), [Element::triangle(Subject::Garment, triangle)]);
    assert_eq!(resized[0].severity(), Severity::Error);
    assert!(error.message.ends_with(&resized[0].to_string()), "{error}");

    let x = session.garment_as_read(Precision::F32).unwrap();
    assert!(session.verify(Precision::F32).unwrap().is_clean());
    assert_eq!(session.step(Default::default()).unwrap_err().kind, ErrorKind::InvalidState, "it has ended");
    session.reset();
    session.set_pins(Vec::new()).unwrap();
    assert_eq!(session.run().unwrap(), Stage::Done, "without the pins nothing is wrong");
    assert_ne!(session.garment_positions().unwrap(), x);
}

#[test]
fn a_piece_that_is_somewhat_small_is_a_finding_only() {
    let (mut session, _) = pinned(0.35);
    assert_eq!(session.run().unwrap(), Stage::Done);
    let resized = session.diagnostics().iter().find(|d| d.kind() == DiagnosticKind::PieceResized);
    assert_eq!(resized.map(|d| d.severity()), Some(Severity::Warning));
}

/// Strands of hair as strips that hang from the back of the head to the shoulder blades, close to the body.
fn strands(body: &TriangleMesh) -> TriangleMesh {
    const RINGS: u32 = 26;
    let top = body.positions.iter().map(|p| p.z).fold(f64::NEG_INFINITY, f64::max);
    let mut hair = TriangleMesh::default();
    for strand in 0..7 {
        let x = 0.03 * f64::from(strand) - 0.09;
        let first = hair.positions.len() as u32;
        let mut back = 0.0;
        for k in 0..=RINGS {
            let z = top - 0.06 - 0.56 * f64::from(k) / f64::from(RINGS);
            let near = body.positions.iter().filter(|p| (p.x - x).abs() < 0.05 && (p.z - z).abs() < 0.03);
            back = near.map(|p| p.y).max_by(f64::total_cmp).unwrap_or(back);
            hair.positions.extend([-0.013, 0.013].map(|side| DVec3::new(x + side, back + 0.015, z)));
        }
        for a in (0..RINGS).map(|k| first + 2 * k) {
            hair.triangles.extend([[a, a + 1, a + 3], [a, a + 3, a + 2]]);
        }
    }
    hair
}

#[test]
fn hair_that_ends_under_the_clothes_is_told_and_can_be_left_out() {
    let (cloth, mannequin, heavy) = (garment(Garment::Sweater), sample(Kind::Mannequin), avatar(Avatar::Heavy));
    let mesh = |s: &Sample| TriangleMesh { positions: s.mesh.positions.clone(), triangles: s.mesh.triangles.clone() };
    let skeleton = |s: &Sample| Skeleton { joints: s.skeleton.joints.to_vec(), bones: BONES.to_vec() };
    let bare = mesh(&heavy);
    let (own, hair) = (bare.triangles.len(), strands(&bare));
    let mut body = bare.clone();
    body.positions.extend(&hair.positions);
    body.triangles.extend(hair.triangles.iter().map(|t| t.map(|v| v + bare.positions.len() as u32)));
    let dressed = |role: PartRole| {
        let mut session = Session::new();
        session.set_garment(mesh(&cloth), Precision::F32).unwrap();
        session.set_source_skeleton(skeleton(&cloth)).unwrap();
        session.set_source_avatar(mesh(&mannequin)).unwrap();
        session.set_target_avatar(body.clone()).unwrap();
        session.set_target_skeleton(skeleton(&heavy)).unwrap();
        let mut roles = vec![PartRole::Automatic; own];
        roles.resize(body.triangles.len(), role);
        session.set_avatar_parts(roles).unwrap();
        assert_eq!(session.run().unwrap(), Stage::Done);
        assert!(session.verify(Precision::F32).unwrap().is_clean());
        session
    };
    let told = |session: &Session| -> Vec<(Severity, u32)> {
        let limbs = session.diagnostics().iter().filter(|d| d.kind() == DiagnosticKind::LimbMisplaced);
        limbs.map(|d| (d.severity(), d.elements().iter().map(|e| e.index).max().unwrap())).collect()
    };
    let found = told(&dressed(PartRole::Automatic));
    assert!(matches!(found[..], [(Severity::Warning, triangle)] if triangle as usize >= own), "{found:?}");
    assert!(told(&dressed(PartRole::Ignored)).is_empty());
}

#[test]
fn a_fit_that_ends_by_the_limit_says_so() {
    let mut whole = session(1.0, DVec3::ZERO);
    whole.set_options(Options { tolerance: 1e-6, ..Options::default() }).unwrap();
    assert_eq!(whole.run().unwrap(), Stage::Done);
    let is_limit = |session: &Session| session.diagnostics().iter().any(|d| d.kind() == DiagnosticKind::NotConverged);
    let report = whole.report();
    assert!(report.converged && !is_limit(&whole));
    let limit = report.fit.iterations - 1;
    assert!(limit > report.inflate.iterations, "else the inflation would end by the limit");

    let mut cut = session(1.0, DVec3::ZERO);
    cut.set_options(Options { tolerance: 1e-6, max_iterations: limit, ..Options::default() }).unwrap();
    assert_eq!(cut.run().unwrap(), Stage::Done);
    assert!(!cut.report().converged && is_limit(&cut));
}
