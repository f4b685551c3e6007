//! A result is fitted again with other wishes: as from the beginning, but from the result.

use bespoke::control::Stage;
use bespoke::error::ErrorKind;
use bespoke::report::Report;
use bespoke::session::{Budget, Options, Pin, Precision, Session};
use glam::DVec3;

use crate::assets::load;
use crate::small::session;

fn objective(report: &Report) -> f64 {
    report.terms.iter().map(|term| term.weight * term.value).sum()
}

/// To the end; the result is clean, also as it is read, and no farther from the minimum than another run with the same wishes.
fn ends_as(session: &mut Session, scratch: &Session) -> Report {
    assert_eq!(session.run().unwrap(), Stage::Done);
    assert!(session.verify(Precision::F32).unwrap().is_clean());
    let (report, other) = (session.report(), scratch.report());
    assert!(report.converged && report.verification.unwrap().is_clean());
    let (own, others) = (objective(&report), objective(&other));
    assert!(own < 1.01 * others, "{own} instead of {others}");
    report
}

fn done(options: &Options) -> Session {
    let mut session = session(1.0, DVec3::ZERO);
    session.set_options(options.clone()).unwrap();
    assert_eq!(session.run().unwrap(), Stage::Done);
    session
}

#[test]
fn it_ends_where_the_wishes_lead_from_the_beginning() {
    let options = Options::default();
    let mut dressed = done(&options);
    let first = dressed.report().fit.iterations;
    let as_it_was = dressed.garment_positions().unwrap();
    for (changed, is_small) in [
        (options.clone(), true),
        (Options { fit_weight: 2.1, ..options.clone() }, true),
        (Options { offset: 0.005, ..options.clone() }, true),
        (Options { fit_weight: 20.0, curvature_weight: 0.5, ..options.clone() }, false),
        (options.clone(), false),
    ] {
        dressed.refit(changed.clone()).unwrap();
        assert_eq!(dressed.stage(), Stage::Fit);
        let report = ends_as(&mut dressed, &done(&changed));
        assert!(!is_small || 3 * report.fit.iterations <= first, "{} of {first} iterations", report.fit.iterations);
    }
    // There and back again.
    let now = dressed.garment_positions().unwrap();
    let farthest = now.iter().zip(&as_it_was).map(|(a, b)| a.distance(*b)).fold(0.0, f64::max);
    assert!(farthest < 0.01, "{farthest}");
}

#[test]
fn pins_and_fit_weights_count_that_were_set_since() {
    let options = Options::default();
    let mut dressed = done(&options);
    let before = dressed.garment_positions().unwrap();
    let count = before.len();
    let weights: Vec<f64> = (0..count).map(|v| if v < count / 2 { 0.0 } else { 1.0 }).collect();
    let away = before[count - 1] + DVec3::new(0.03, 0.0, 0.0);
    let pin = Pin { vertex: count as u32 - 1, target: Some(away) };
    dressed.set_vertex_fit_weights(weights.clone()).unwrap();
    dressed.set_pins(vec![pin]).unwrap();
    dressed.refit(options.clone()).unwrap();
    let mut scratch = session(1.0, DVec3::ZERO);
    scratch.set_vertex_fit_weights(weights).unwrap();
    scratch.set_pins(vec![pin]).unwrap();
    scratch.run().unwrap();
    ends_as(&mut dressed, &scratch);
    let after = dressed.garment_positions().unwrap();
    assert!(after[count - 1].distance(away) < 0.01, "the pin is not reached");
}

#[test]
fn the_same_wishes_give_the_same_bits_whatever_is_read_between() {
    let wishes = [Options { fit_weight: 3.0, ..Options::default() }, Options { offset: 0.004, ..Options::default() }];
    let result = |threads: u32, step: bool| {
        let with = |options: &Options| Options { threads, ..options.clone() };
        let mut session = session(1.0, DVec3::ZERO);
        session.crowd();
        session.set_options(with(&Options::default())).unwrap();
        session.run().unwrap();
        for options in &wishes {
            session.refit(with(options)).unwrap();
            while step && session.step(Budget { iterations: 1, milliseconds: 0 }).unwrap() != Stage::Done {
                session.garment_positions().unwrap();
                session.distortion().unwrap();
            }
            if !step {
                session.run().unwrap();
            }
        }
        session.garment_positions().unwrap()
    };
    let first = result(1, false);
    assert_eq!(result(1, true), first);
    assert_eq!(result(3, false), first);
}

/// The dial turns on while the fit is under way.
#[test]
fn it_may_be_asked_again_before_it_has_ended() {
    let options = Options::default();
    let mut dressed = done(&options);
    for k in 1..=5 {
        dressed.refit(Options { fit_weight: 2.0 + 0.2 * f64::from(k), ..options.clone() }).unwrap();
        dressed.step(Budget { iterations: 1, milliseconds: 0 }).unwrap();
        assert!(dressed.verify(Precision::F64).unwrap().is_clean(), "a preview is free of intersections");
    }
    let last = Options { fit_weight: 3.0, ..options };
    ends_as(&mut dressed, &done(&last));
}

#[test]
fn what_cannot_be_is_refused_and_the_result_stays() {
    let options = Options::default();
    let mut early = session(1.0, DVec3::ZERO);
    assert_eq!(early.refit(options.clone()).unwrap_err().kind, ErrorKind::InvalidState);
    early.prepare().unwrap();
    assert_eq!(early.refit(options.clone()).unwrap_err().kind, ErrorKind::InvalidState);
    assert_eq!(early.set_pins(Vec::new()).unwrap_err().kind, ErrorKind::InvalidState);

    let mut dressed = done(&options);
    let result = dressed.garment_positions().unwrap();
    let refused = [
        (Options { voxel_size: 0.02, ..options.clone() }, "voxel_size"),
        (Options { strict: true, ..options.clone() }, "strict"),
        (Options { fit_weight: -1.0, ..options.clone() }, "fit_weight"),
    ];
    for (wish, name) in refused {
        let error = dressed.refit(wish).unwrap_err();
        assert!(error.kind == ErrorKind::InvalidArgument && error.message.contains(name), "{error}");
    }
    dressed.set_vertex_fit_weights(vec![1.0; 3]).unwrap();
    assert_eq!(dressed.refit(options.clone()).unwrap_err().kind, ErrorKind::InvalidWeights);
    dressed.set_vertex_fit_weights(vec![1.0; result.len()]).unwrap();
    dressed.set_pins(vec![Pin { vertex: 1_000_000, target: None }]).unwrap();
    assert_eq!(dressed.refit(options.clone()).unwrap_err().kind, ErrorKind::InvalidArgument);
    assert_eq!((dressed.stage(), dressed.garment_positions().unwrap()), (Stage::Done, result));
    dressed.set_pins(Vec::new()).unwrap();
    dressed.refit(options.clone()).unwrap();
    assert_eq!(dressed.run().unwrap(), Stage::Done);
    // From the beginning, with what was set last.
    dressed.reset();
    assert_eq!(dressed.run().unwrap(), Stage::Done);
}

#[test]
fn a_cancelled_refit_leaves_a_garment_without_intersections() {
    let mut dressed = done(&Options::default());
    dressed.refit(Options { fit_weight: 9.0, ..Options::default() }).unwrap();
    dressed.step(Budget { iterations: 2, milliseconds: 0 }).unwrap();
    dressed.control().cancel();
    assert_eq!(dressed.run().unwrap_err().kind, ErrorKind::Cancelled);
    assert_eq!(dressed.stage(), Stage::Cancelled);
    assert!(dressed.verify(Precision::F64).unwrap().is_clean());
    let error = dressed.refit(Options::default()).unwrap_err();
    assert_eq!(error.kind, ErrorKind::InvalidState, "{error}");
}

/// On real meshes, a small wish takes a small part of the iterations.
#[test]
fn a_real_coat_answers_to_its_dials() {
    let options = Options::default();
    let Some(mut dressed) = load("Puffer_dense", "heavy_adult", options.clone(), |_| {}) else { return };
    dressed.run().unwrap();
    let first = dressed.report().fit.iterations;
    let wish = Options { fit_weight: 2.2, ..options };
    dressed.refit(wish.clone()).unwrap();
    let mut scratch = load("Puffer_dense", "heavy_adult", wish, |_| {}).expect("it was there");
    scratch.run().unwrap();
    let report = ends_as(&mut dressed, &scratch);
    assert!(4 * report.fit.iterations <= first, "{} of {first}", report.fit.iterations);
}
