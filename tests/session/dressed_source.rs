//! A garment through which the body goes that it was made for, and which is refused with it, is tried with the garment on that body.

use bespoke::control::Stage;
use bespoke::error::ErrorKind;
use bespoke::geometry::mesh::TriangleMesh;
use bespoke::input::diagnostic::{Diagnostic, DiagnosticKind, Severity};
use bespoke::input::skin::SkinWeights;
use bespoke::options::Options;
use bespoke::session::{Precision, Session};
use bespoke::verify::{intersecting, intersections};
use testing::character::{mesh, session, skin};
use testing::pierced_hat::PiercedHat;

use crate::blocked::{block, two_boxes};

fn is_told(found: &&Diagnostic) -> bool {
    found.kind() == DiagnosticKind::SourceDressed
}

/// The hat and its wearer's body, `source` in its place where it is said.
fn hat_session(scene: &PiercedHat, source: Option<(TriangleMesh, SkinWeights)>, strict: bool) -> Session {
    let options = Options { threads: 2, voxel_size: 0.04, strict, ..Options::default() };
    let mut session = session(&scene.hat, &scene.source, &scene.target, options).unwrap();
    session.set_garment_skin(skin(&scene.hat)).unwrap();
    let (body, weights) = source.unwrap_or_else(|| (mesh(&scene.source), skin(&scene.source)));
    session.set_source_avatar(body).unwrap();
    session.set_source_skin(weights).unwrap();
    session
}

/// Two meshes as one.
fn together(a: &TriangleMesh, b: &TriangleMesh) -> TriangleMesh {
    let first = a.positions.len() as u32;
    let mut both = a.clone();
    both.positions.extend(&b.positions);
    both.triangles.extend(b.triangles.iter().map(|t| t.map(|v| v + first)));
    both
}

#[test]
fn a_hat_that_the_head_goes_through_is_dressed_as_with_the_hat_on_the_body() {
    let scene = PiercedHat::new();
    let mut strict = hat_session(&scene, None, true);
    assert_eq!(strict.run().unwrap_err().kind, ErrorKind::NotEnclosed);
    assert!(!strict.diagnostics().iter().any(|found| is_told(&found)));

    let mut dressed = hat_session(&scene, None, false);
    assert_eq!(dressed.run().unwrap(), Stage::Done);
    assert!(dressed.verify(Precision::F32).unwrap().is_clean());
    let told: Vec<&Diagnostic> = dressed.diagnostics().iter().filter(is_told).collect();
    let [&Diagnostic::SourceDressed { pairs, triangles, has_begun: false }] = told[..] else { panic!("{told:?}") };
    assert_eq!(told[0].severity(), Severity::Warning);
    let (body, hat) = (mesh(&scene.source), mesh(&scene.hat));
    assert_eq!(pairs, intersections(&hat, Some(&body), 0).unwrap().count);
    let both = together(&body, &hat);
    let [of_hat, of_body] = triangles;
    let pair = [of_body, of_hat + body.triangles.len() as u32];
    assert_eq!(intersecting(&both, &[pair]).unwrap(), [pair], "the named triangles meet");

    // The same bits as where the caller hands in both as one body.
    let weights = [(&scene.source, body.positions.len()), (&scene.hat, hat.positions.len())];
    let rows = weights.map(|(of, count)| {
        let weights = skin(of);
        (0..count).map(move |v| weights.weights(v).to_vec()).collect::<Vec<_>>()
    });
    let weights = SkinWeights::from_rows(scene.source.joints.len(), rows.into_iter().flatten());
    let mut by_hand = hat_session(&scene, Some((both, weights)), false);
    by_hand.run().unwrap();
    assert!(!by_hand.diagnostics().iter().any(|found| is_told(&found)));
    assert_eq!(dressed.garment_positions().unwrap(), by_hand.garment_positions().unwrap());

    // And once more, after a reset.
    let first = dressed.garment_positions().unwrap();
    dressed.reset();
    assert_eq!(dressed.run().unwrap(), Stage::Done);
    assert_eq!(dressed.garment_positions().unwrap(), first);
    assert_eq!(dressed.diagnostics().iter().filter(is_told).count(), 1);
}

#[test]
fn of_two_refusals_the_first_is_told() {
    let stalled = |source: Option<TriangleMesh>| {
        let mut session = two_boxes(-0.02, Options { threads: 2, ..Options::default() });
        if let Some(source) = source {
            session.set_source_avatar(source).unwrap();
        }
        let error = session.run().unwrap_err();
        assert_eq!((error.kind, session.stage()), (ErrorKind::InflationStalled, Stage::Failed), "{error}");
        let said: Vec<String> = session.diagnostics().iter().map(ToString::to_string).collect();
        (error.message, said, session.garment_positions().unwrap(), session.report().inflate.iterations)
    };
    let alone = stalled(None);
    // Beside the sleeve, and through its wall.
    let apart = stalled(Some(block([-0.05, -0.05, -0.9], [0.05, 0.05, 0.9])));
    let through = stalled(Some(block([-0.35, -0.05, -0.9], [0.35, 0.05, 0.9])));
    for other in [apart, through] {
        assert_eq!(other, alone);
    }
}

#[test]
fn what_ends_by_the_limit_of_iterations_is_not_tried_again() {
    let mut session = two_boxes(-0.02, Options { threads: 2, max_iterations: 2, ..Options::default() });
    session.set_source_avatar(block([-0.35, -0.05, -0.9], [0.35, 0.05, 0.9])).unwrap();
    let error = session.run().unwrap_err();
    assert!(error.kind == ErrorKind::InflationStalled && error.message.contains("max_iterations"), "{error}");
    assert!(session.report().inflate.iterations <= 2);
}
