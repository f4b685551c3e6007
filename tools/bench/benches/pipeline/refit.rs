//! The fourth table: a result that is fitted again with other wishes, beside the whole run.

use std::time::Instant;

use bespoke::control::Stage;
use bespoke::report::Report;
use bespoke::session::{Budget, Options, Session};
use glam::DVec3;
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
    /// Seconds from the wish until there is a preview to look at, after one iteration; the median.
    preview: f64,
    /// How far its farthest vertex still has to go, as a share of the longest way of all; none where nothing moves.
    left: Option<f64>,
    /// Iterations of the fit in both.
    iterations: [u32; 2],
    /// The objective over that of a run from the beginning with the same wish.
    objective: f64,
}

/// A vertex that moves by less, in the target's unit, stays where it is.
const STILL: f64 = 1e-6;

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
        let (mut previews, mut left) = (took.clone(), vec![None; WISHES.len()]);
        let mut reports = Vec::new();
        for _ in 0..runs.max(1) {
            let clock = Instant::now();
            let mut session = inputs.session(options.clone())?;
            finish(&mut session)?;
            whole.push(clock.elapsed().as_secs_f64());
            let first = session.report().fit.iterations;
            reports.clear();
            for (k, (_, wish)) in WISHES.iter().enumerate() {
                let before = session.garment_positions()?;
                let clock = Instant::now();
                session.refit(wish(options.clone()))?;
                session.step(Budget { iterations: 1, milliseconds: 0 })?;
                let preview = session.garment_positions()?;
                previews[k].push(clock.elapsed().as_secs_f64());
                if session.stage() != Stage::Done {
                    finish(&mut session)?;
                }
                took[k].push(clock.elapsed().as_secs_f64());
                let after = session.garment_positions()?;
                left[k] =
                    (farthest(&before, &after) > STILL).then(|| farthest(&preview, &after) / farthest(&before, &after));
                reports.push((first, session.report()));
                session.refit(options.clone())?;
                finish(&mut session)?;
            }
        }
        let seconds = median(&mut whole);
        let measured = (0..WISHES.len()).map(|k| {
            let ((name, wish), (first, report)) = (&WISHES[k], &reports[k]);
            let mut scratch = inputs.session(wish(options.clone()))?;
            finish(&mut scratch)?;
            Ok(Self {
                case: case.name(),
                wish: name,
                seconds: [seconds, median(&mut took[k])],
                preview: median(&mut previews[k]),
                left: left[k],
                iterations: [*first, report.fit.iterations],
                objective: objective(report) / objective(&scratch.report()),
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

/// The longest way of a vertex.
fn farthest(a: &[DVec3], b: &[DVec3]) -> f64 {
    a.iter().zip(b).map(|(p, q)| p.distance(*q)).fold(0.0, f64::max)
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
            format!("{:.0}", 1000.0 * m.preview),
            m.left.map_or("-".into(), |left| format!("{:.0} %", 100.0 * left)),
            m.iterations[0].to_string(),
            m.iterations[1].to_string(),
            format!("{:.4}", m.objective),
        ]
    };
    table::print(
        "Refit: seconds beside the whole run, milliseconds until a preview and what it lacks of the way, iterations of the fit, and the \
         objective over that from the beginning",
        2,
        &["case", "wish", "whole", "refit", "share", "preview", "lacks", "iterations", "again", "objective"],
        &measured.iter().map(row).collect::<Vec<_>>(),
    );
}
