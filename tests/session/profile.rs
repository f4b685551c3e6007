//! The times that a session measures add up.

use std::time::Duration;

use bespoke::control::Stage;
use bespoke::session::{Options, StageReport};
use bespoke::solver::profile::Profile;
use glam::DVec3;

use super::small::session;

/// Wall time in all kernels together.
fn kernels(p: &Profile) -> Duration {
    p.assembly + p.analysis + p.factorisation + p.solve + p.broad_phase + p.ccd + p.line_search
}

#[test]
fn kernels_and_terms_share_the_seconds_of_their_stage() {
    let mut session = session(1.0, DVec3::ZERO);
    session.set_options(Options { threads: 1, ..Options::default() }).unwrap();
    assert_eq!(session.run().unwrap(), Stage::Done);
    let report = session.report();
    let stages = [&report.prepare, &report.inflate, &report.fit];
    for StageReport { seconds, profile, .. } in stages {
        let kernels = kernels(profile).as_secs_f64();
        assert!(kernels > 0.0 && kernels <= *seconds, "{kernels} of {seconds}");
        // With one thread, the time of a term is a part of the wall time of its kernel.
        let derivatives = profile.terms.iter().map(|t| t.derivatives).sum();
        assert!(profile.assembly >= derivatives, "{profile:?}");
    }
    assert!(report.fit.profile.terms.iter().any(|t| t.name == "fit" && !t.values.is_zero()), "{report:?}");
    for term in report.fit.profile.terms.iter().filter(|t| ["surface", "barrier", "fit"].contains(&t.name)) {
        assert!(!term.derivatives.is_zero() && !term.values.is_zero(), "{term:?}");
    }

    // Both objectives were analysed, and what contact added later; each iteration factorises at least once.
    assert!(report.prepare.analyses == 1 && report.fit.analyses >= 1, "{report:?}");
    assert!(stages.iter().all(|s| s.factorisations >= s.iterations), "{report:?}");

    let whole = stages.iter().map(|s| s.seconds).sum::<f64>();
    let first = report.prepare.seconds + report.inflate.seconds;
    assert!(report.feasible_seconds >= first && report.field_wait_seconds <= report.fit.seconds, "{report:?}");
    assert!(report.feasible_seconds < whole, "{report:?}");
}

#[test]
fn before_the_end_of_the_inflation_there_is_no_feasible_result() {
    let mut session = session(1.0, DVec3::ZERO);
    session.prepare().unwrap();
    assert_eq!(session.report().feasible_seconds, 0.0);
}
