//! What exists between `prepare` and `reset`: the problem, its present state, and the step of the paper under way.

use std::sync::Arc;
use std::time::{Duration, Instant};

use super::field_task::FieldTask;
use crate::control::{Control, Stage};
use crate::error::{Error, ErrorKind, Result};
use crate::options::Options;
use crate::report::{Report, StageReport, TermReport};
use crate::solver::newton::{Counters, Model, Newton, State};
use crate::stage::fit::Settling;
use crate::stage::inflate::Inflation;
use crate::stage::objective::Objective;
use crate::stage::problem::Problem;

/// What exists between `prepare` and `reset`.
pub(super) struct Work {
    pub(super) pool: Arc<rayon::ThreadPool>,
    /// The caller's, with the separation floor that the problem allows.
    pub(super) options: Options,
    pub(super) problem: Problem,
    pub(super) state: State,
    pub(super) objective: Objective,
    pub(super) newton: Newton,
    pub(super) step: Step,
    pub(super) field: FieldTask,
}

/// The step of the paper that is under way.
pub(super) enum Step {
    Inflate(Inflation),
    Fit(Settling),
}

impl Work {
    /// One iteration, and the passage to the next stage where one has ended. [`Stage::Verify`] when all are.
    pub(super) fn iterate(&mut self, control: &Control, report: &mut Report) -> Result<Stage> {
        let options = &self.options;
        let clock = Instant::now();
        let before = self.newton.counters;
        let (stage, ended) = match &mut self.step {
            Step::Inflate(inflation) => {
                check_limit(inflation.iterations, options, "inflation", self.state.t)?;
                let ended = inflation.iterate(&mut self.objective, &mut self.newton, &mut self.state)?;
                (Stage::Inflate, ended)
            }
            Step::Fit(settling) => {
                let converged = settling.iterate(&mut self.objective, &mut self.newton, &mut self.state, options)?;
                report.converged = converged;
                (Stage::Fit, converged || settling.iterations >= options.max_iterations)
            }
        };
        if self.objective.review(self.state.configuration())? {
            self.newton.forget_values();
        }
        let part = if stage == Stage::Inflate { &mut report.inflate } else { &mut report.fit };
        part.add(&before, &self.newton.counters, clock.elapsed());
        self.describe(report);
        match (stage, ended) {
            (_, false) => Ok(stage),
            (Stage::Inflate, true) => {
                self.begin_fit(control, report)?;
                Ok(Stage::Fit)
            }
            (_, true) => Ok(Stage::Verify),
        }
    }

    fn begin_fit(&mut self, control: &Control, report: &mut Report) -> Result<()> {
        let options = &self.options;
        let clock = Instant::now();
        let (field, seconds) = self.field.wait(control)?;
        report.field_seconds = seconds;
        let mut objective = self.problem.fit_objective(Arc::new(field), &self.state.x, options)?;
        objective.take_over(&self.objective);
        self.objective = objective;
        self.newton = Newton::new(self.state.x.len(), &self.objective.terms())?;
        self.step = Step::Fit(Settling::begin(&mut self.objective, &self.state, options));
        report.fit.seconds += clock.elapsed().as_secs_f64();
        report.fit.analyses += 1;
        Ok(())
    }

    fn describe(&mut self, report: &mut Report) {
        let at = self.state.configuration();
        let contact = self.objective.activity(at);
        report.active_contacts = contact.count;
        report.min_distance_self = contact.min_distance_self;
        report.min_distance_avatar = contact.min_distance_avatar;
        report.gradient_norm = self.newton.gradient_norm();
        report.separation_floor = self.objective.floor();
        report.t = self.state.t;
        let terms = self.objective.terms();
        let values = self.newton.values(&terms, at);
        report.terms = terms
            .iter()
            .zip(values)
            .map(|(term, &value)| TermReport { name: term.energy.name(), value, weight: term.weight })
            .collect();
    }
}

fn check_limit(iterations: u32, options: &Options, what: &str, t: f64) -> Result<()> {
    if iterations < options.max_iterations {
        return Ok(());
    }
    Err(Error::new(
        ErrorKind::InflationStalled,
        format!("the {what} did not end in {iterations} iterations: t is {t:.4}; raise max_iterations"),
    ))
}

impl StageReport {
    fn add(&mut self, before: &Counters, after: &Counters, elapsed: Duration) {
        self.seconds += elapsed.as_secs_f64();
        self.iterations += 1;
        self.factorisations += after.factorisations - before.factorisations;
        self.analyses += after.analyses - before.analyses;
        let parts = |c: &Counters| [c.assembly, c.linear, c.admission, c.line_search];
        for ((slot, a), b) in self.kernels.iter_mut().zip(parts(after)).zip(parts(before)) {
            *slot += (a - b).as_secs_f64();
        }
    }
}
