//! A result is fitted again on an avatar in another shape: morph weights as a wish.

use bespoke::control::Stage;
use bespoke::error::ErrorKind;
use bespoke::session::{Budget, Options, Precision, Session};
use bespoke::verify::intersections;
use glam::DVec3;

use crate::morphs::{body, moved, on, radius, thicker, two_arms_apart};
use crate::small::tube;

/// To the end, clean as it is read and on the body as it is read.
fn ends(session: &mut Session) -> Vec<DVec3> {
    assert_eq!(session.run().unwrap(), Stage::Done);
    let report = session.report();
    assert!(report.converged && report.verification.unwrap().is_clean());
    let garment = session.garment_positions().unwrap();
    let mut avatar = body(0.36);
    avatar.positions = session.avatar_positions().unwrap();
    assert_eq!(intersections(&moved(&garment, &vec![DVec3::ZERO; garment.len()]), Some(&avatar), 0).unwrap().count, 0);
    garment
}

fn farthest(a: &[DVec3], b: &[DVec3]) -> f64 {
    a.iter().zip(b).map(|(p, q)| p.distance(*q)).fold(0.0, f64::max)
}

#[test]
fn the_garment_follows_the_body_there_and_back() {
    let options = Options::default();
    let mut session = on(0.36);
    session.add_target_morph(thicker(0.36, 0.46)).unwrap();
    session.add_target_morph(thicker(0.36, 0.3)).unwrap();
    let first = ends(&mut session);
    let own = session.avatar_positions().unwrap();
    for (weights, expected) in
        [([0.5, 0.0], 0.41), ([1.0, 0.0], 0.46), ([1.0, 1.0], 0.4), ([0.0, 1.0], 0.3), ([0.0, 0.0], 0.36)]
    {
        for (morph, weight) in weights.into_iter().enumerate() {
            session.set_target_morph_weight(morph, weight).unwrap();
        }
        session.refit(options.clone()).unwrap();
        let mut avatar = body(0.36);
        avatar.positions = session.avatar_positions().unwrap();
        // Before the first step of the fit, the garment can be seen on the body in its new shape, which it has come along with.
        assert_eq!(session.stage(), Stage::Fit);
        let carried = session.garment_positions().unwrap();
        let count = carried.len();
        assert_eq!(intersections(&moved(&carried, &vec![DVec3::ZERO; count]), Some(&avatar), 0).unwrap().count, 0);
        let off = (radius(&carried) - expected).abs();
        assert!(off < 0.05, "{weights:?}: carried to a radius of {}", radius(&carried));
        // From the beginning on that body, and no farther from the minimum.
        let mut scratch = on(0.36);
        scratch.set_target_avatar(avatar.clone()).unwrap();
        let garment = ends(&mut session);
        assert_eq!(session.avatar_positions().unwrap(), avatar.positions);
        let from_the_beginning = ends(&mut scratch);
        let [now, scratch] = [&garment, &from_the_beginning].map(|x| radius(x));
        assert!((now - scratch).abs() < 0.003 && now > expected - 0.01, "{weights:?}: {now} and {scratch}");
    }
    // The body is back to the bit, and the garment nearly: after five fits, each near to the one before, it may have slid along a body
    // that is as wide everywhere, by 0.011 of a width of 0.72.
    assert_eq!(session.avatar_positions().unwrap(), own);
    let off = farthest(&first, &session.garment_positions().unwrap());
    assert!(off < 0.02, "{off}");
}

#[test]
fn layers_go_along_and_other_wishes_count() {
    let mut session = on(0.34);
    session.add_layer(tube(-0.5, 0.4, |_, _| 0.36, 6, 18, false)).unwrap();
    session.add_target_morph(thicker(0.34, 0.42)).unwrap();
    session.run().unwrap();
    session.set_target_morph_weight(0, 1.0).unwrap();
    session.refit(Options { offset: 0.01, ..Options::default() }).unwrap();
    session.run().unwrap();
    let garment =
        moved(&session.garment_positions().unwrap(), &vec![DVec3::ZERO; session.garment_vertex_count().unwrap()]);
    let layer = tube(-0.5, 0.4, |_, _| 0.435, 6, 18, false);
    assert_eq!(intersections(&garment, Some(&layer), 0).unwrap().count, 0);
    // The same wishes in the same order give the same bits, with other threads and in steps.
    let mut other = on(0.34);
    other.crowd();
    let options = Options { threads: 3, ..Options::default() };
    other.set_options(options.clone()).unwrap();
    other.add_layer(tube(-0.5, 0.4, |_, _| 0.36, 6, 18, false)).unwrap();
    other.add_target_morph(thicker(0.34, 0.42)).unwrap();
    other.run().unwrap();
    other.set_target_morph_weight(0, 1.0).unwrap();
    other.refit(Options { offset: 0.01, ..options }).unwrap();
    while other.step(Budget { iterations: 1, milliseconds: 0 }).unwrap() != Stage::Done {}
    assert_eq!(other.garment_positions().unwrap(), session.garment_positions().unwrap());
    assert!(other.verify(Precision::F32).unwrap().is_clean());
}

/// The other arm cannot come to where the sleeve is: the result stays, and another wish is answered.
#[test]
fn what_the_garment_does_not_let_pass_leaves_the_result() {
    let (mut session, nearer) = two_arms_apart();
    session.add_target_morph(nearer(-2.0)).unwrap();
    session.add_target_morph(nearer(-0.4)).unwrap();
    session.run().unwrap();
    let (before, body) = (session.garment_positions().unwrap(), session.avatar_positions().unwrap());
    session.set_target_morph_weight(0, 1.0).unwrap();
    let error = session.refit(Options::default()).unwrap_err();
    assert_eq!((error.kind, session.stage()), (ErrorKind::InflationStalled, Stage::Done));
    assert!(error.message.contains("% of the way"), "{}", error.message);
    assert_eq!((session.garment_positions().unwrap(), session.avatar_positions().unwrap()), (before, body));
    session.set_target_morph_weight(0, 0.0).unwrap();
    session.set_target_morph_weight(1, 1.0).unwrap();
    session.refit(Options::default()).unwrap();
    assert_eq!(session.run().unwrap(), Stage::Done);
    assert!(session.report().verification.unwrap().is_clean());
}

#[test]
fn weights_that_mean_nothing_are_refused() {
    let mut session = on(0.34);
    session.add_target_morph(thicker(0.34, 0.42)).unwrap();
    let kind = |outcome: Result<(), bespoke::error::Error>| outcome.unwrap_err().kind;
    assert_eq!(kind(session.set_target_morph_weight(0, 1.0)), ErrorKind::InvalidState);
    session.run().unwrap();
    let before = session.garment_positions().unwrap();
    assert_eq!(kind(session.set_target_morph_weight(1, 1.0)), ErrorKind::InvalidArgument);
    assert_eq!(kind(session.set_target_morph_weight(0, f64::NAN)), ErrorKind::InvalidArgument);
    session.set_target_morph_weight(0, 1e6).unwrap();
    assert_eq!(kind(session.refit(Options::default())), ErrorKind::InvalidArgument);
    assert_eq!((session.stage(), session.garment_positions().unwrap()), (Stage::Done, before.clone()));
    // As it was set, after reset.
    session.set_target_morph_weight(0, 1.0).unwrap();
    session.reset();
    session.run().unwrap();
    assert_eq!(session.garment_positions().unwrap(), before);
}
