//! Garments with flaws: where faces are missing, they take little more than what is whole.

use bespoke::control::Stage;
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

fn dressed(garment: &TriangleMesh) -> Session {
    let mut session = session(1.0, DVec3::ZERO);
    session.set_garment(garment.clone(), Precision::F64).unwrap();
    assert_eq!(session.run().unwrap(), Stage::Done);
    session
}

fn iterations(session: &Session) -> u32 {
    session.report().inflate.iterations + session.report().fit.iterations
}

fn is_adjusted(session: &Session) -> bool {
    session.diagnostics().iter().any(|diagnostic| diagnostic.kind() == DiagnosticKind::SettingsAdjusted)
}

#[test]
fn a_net_takes_little_more_than_what_is_whole() {
    let whole = iterations(&dressed(&fine()));
    for share in [0.06, 0.12] {
        let session = dressed(&net(share));
        println!("{share} {} {whole}", iterations(&session));
        assert!(session.verify(Precision::F64).unwrap().is_clean());
        assert!(!is_adjusted(&session) && iterations(&session) <= 3 * whole, "{} {whole}", iterations(&session));
    }
}
