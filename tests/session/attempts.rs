//! Where the inflation stalls, it is tried again with other settings of the contact.

use bespoke::control::Stage;
use bespoke::error::ErrorKind;
use bespoke::input::diagnostic::{Diagnostic, DiagnosticKind, Severity};
use bespoke::options::Options;
use bespoke::session::{Budget, Session};
use glam::DVec3;

use crate::blocked::two_boxes;
use crate::small::session;

/// A rigid ring around an arm that outgrows it, which stalls with the settings by default.
fn ringed(options: Options) -> Session {
    let mut session = session(1.0, DVec3::ZERO);
    session.add_rigid_group((80..120).collect()).unwrap();
    session.set_options(options).unwrap();
    session
}

fn adjustments(session: &Session) -> Vec<Diagnostic> {
    session.diagnostics().iter().filter(|d| d.kind() == DiagnosticKind::SettingsAdjusted).cloned().collect()
}

#[test]
fn what_stalls_at_first_is_done_with_other_settings_which_are_named() {
    let mut session = ringed(Options::default());
    assert_eq!(session.run().unwrap(), Stage::Done);
    assert!(session.report().verification.unwrap().is_clean());
    let found = adjustments(&session);
    let [Diagnostic::SettingsAdjusted { stalled_at, attempts, inflation_dhat, inflation_barrier_weight }] = found[..]
    else {
        panic!("{found:?}")
    };
    println!("{}", found[0]);
    assert_eq!(found[0].severity(), Severity::Note);
    assert!(stalled_at < 1.0 && attempts >= 2);
    assert_ne!((inflation_dhat, inflation_barrier_weight), (0.01, 1e4));

    // With these settings it is done at once, and step by step it is the same, with iterations that go on counting.
    let mut direct = ringed(Options { inflation_dhat, inflation_barrier_weight, ..Options::default() });
    assert_eq!(direct.run().unwrap(), Stage::Done);
    assert!(adjustments(&direct).is_empty());
    assert!(direct.report().inflate.iterations < session.report().inflate.iterations);
    let mut stepped = ringed(Options { threads: 1, ..Options::default() });
    let mut before = 0;
    while stepped.stage() != Stage::Done {
        let stage = stepped.step_or_prepare();
        let iterations = stepped.report().inflate.iterations;
        assert!(stage != Stage::Inflate || iterations == before + 1);
        before = iterations;
    }
    assert_eq!(stepped.garment_positions().unwrap(), session.garment_positions().unwrap());
    assert_eq!(adjustments(&stepped), found);
}

/// Prepares a session, or does one iteration.
trait StepOrPrepare {
    fn step_or_prepare(&mut self) -> Stage;
}

impl StepOrPrepare for Session {
    fn step_or_prepare(&mut self) -> Stage {
        if self.stage() == Stage::Setup {
            self.prepare().unwrap();
            return self.stage();
        }
        self.step(Budget { iterations: 1, milliseconds: 0 }).unwrap()
    }
}

/// Too few iterations are no stall: the caller is told so, and nothing else is tried.
#[test]
fn an_inflation_that_is_cut_short_is_not_tried_again() {
    let mut session = ringed(Options { max_iterations: 5, ..Options::default() });
    let message = session.run().unwrap_err().message;
    assert!(message.contains("did not end in 5 iterations"), "{message}");
    assert_eq!(session.report().inflate.iterations, 5);
}

/// Two boxes that grow into each other with a sleeve between them. Where the caller will try without one of them, nothing else is tried.
#[test]
fn what_a_dispensable_part_holds_is_left_to_the_caller() {
    let iterations = |dispensable: Vec<bool>| {
        let mut session = two_boxes(-0.1, Options::default());
        session.set_dispensable(dispensable).unwrap();
        assert_eq!(session.run().unwrap_err().kind, ErrorKind::InflationStalled);
        assert!(session.diagnostics().iter().any(|d| d.kind() == DiagnosticKind::InflationBlocked));
        assert_eq!(session.set_dispensable(Vec::new()).unwrap_err().kind, ErrorKind::InvalidState);
        session.report().inflate.iterations
    };
    let all = iterations(Vec::new());
    let second = |t: usize| t >= 12;
    let left = iterations((0..24).map(second).collect());
    println!("{left} iterations, and {all} where nothing is dispensable");
    assert!(2 * left < all, "{left} {all}");
    assert_eq!(iterations(vec![false; 24]), all);
}
