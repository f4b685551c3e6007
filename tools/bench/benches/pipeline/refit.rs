//! The fourth table: a result that is fitted again with other wishes, beside the whole run.

use std::time::Instant;

use bespoke::control::Stage;
use bespoke::report::Report;
use bespoke::session::{Options, Session};
use serde::Serialize;

use crate::case::{Case, Inputs};
use crate::median;
use crate::table;

type Failure = Box<dyn std::error::Error>;

/// One wish on one case.
#[derive(Clone, Debug, Serialize)]
pub struct Refit {
    case: String,
    wish: &'static str,
    /// Seconds of the whole run and of the refit, medians.
    seconds: [f64; 2],
    /// Iterations of the fit in both.
    iterations: [u32; 2],
    /// The objective over that of a run from the beginning with the same wish.
    objective: f64,
}

/// A wish: its name, and the options that it asks for.
type Wish = (&'static str, fn(Options) -> Options);

/// From small to large.
const WISHES: [Wish; 6] = [
    ("nothing", |options| options),
    ("fit weight + 10 %", |options| Options { fit_weight: 1.1 * options.fit_weight, ..options }),
    ("surface weight + 10 %", |options| Options { surface_weight: 1.1 * options.surface_weight, ..options }),
    ("looseness - 10 %", |options| Options { designed_clearance: 0.9 * options.designed_clearance, ..options }),
    ("curve weights x 2", |options| Options {
        curvature_weight: 2.0 * options.curvature_weight,
        torsion_weight: 2.0 * options.torsion_weight,
        ..options
    }),
    ("fit weight x 4", |options| Options { fit_weight: 4.0 * options.fit_weight, ..options }),
];

impl Refit {
    /// Measures all wishes on `case`, each from the result with the defaults.
    pub fn measure(case: &Case, threads: u32, runs: usize) -> Result<Vec<Self>, Failure> {
        let inputs = Inputs::read(case)?;
        let options = Options { threads, ..Options::default() };
        let mut whole = Vec::new();
        let mut took = vec![Vec::new(); WISHES.len()];
        let mut reports = Vec::new();
        for _ in 0..runs.max(1) {
            let clock = Instant::now();
            let mut session = inputs.session(options.clone())?;
            finish(&mut session)?;
            whole.push(clock.elapsed().as_secs_f64());
            let first = session.report().fit.iterations;
            reports.clear();
            for ((_, wish), took) in WISHES.iter().zip(&mut took) {
                let clock = Instant::now();
                session.refit(wish(options.clone()))?;
                finish(&mut session)?;
                took.push(clock.elapsed().as_secs_f64());
                reports.push((first, session.report()));
                session.refit(options.clone())?;
                finish(&mut session)?;
            }
        }
        let seconds = median(&mut whole);
        let measured = WISHES.iter().zip(took).zip(reports).map(|(((name, wish), mut took), (first, report))| {
            let mut scratch = inputs.session(wish(options.clone()))?;
            finish(&mut scratch)?;
            Ok(Self {
                case: case.name(),
                wish: name,
                seconds: [seconds, median(&mut took)],
                iterations: [first, report.fit.iterations],
                objective: objective(&report) / objective(&scratch.report()),
            })
        });
        measured.collect()
    }
}

fn finish(session: &mut Session) -> Result<(), Failure> {
    match session.run()? {
        Stage::Done => Ok(()),
        stage => Err(format!("it ended as {stage:?}").into()),
    }
}

fn objective(report: &Report) -> f64 {
    report.terms.iter().map(|term| term.weight * term.value).sum()
}

/// Prints them.
pub fn print(measured: &[Refit]) {
    let row = |m: &Refit| {
        let [whole, again] = m.seconds;
        vec![
            m.case.clone(),
            m.wish.into(),
            format!("{whole:.2}"),
            format!("{again:.3}"),
            format!("{:.1} %", 100.0 * again / whole),
            m.iterations[0].to_string(),
            m.iterations[1].to_string(),
            format!("{:.4}", m.objective),
        ]
    };
    table::print(
        "Refit: seconds beside the whole run, iterations of the fit, and the objective over that from the beginning",
        2,
        &["case", "wish", "whole", "refit", "share", "iterations", "again", "objective"],
        &measured.iter().map(row).collect::<Vec<_>>(),
    );
}
