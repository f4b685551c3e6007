//! What exists between `prepare` and `reset`: the problem, its present state, and the step of the paper under way.

use std::sync::Arc;
use std::time::{Duration, Instant};

use super::fault::Fault;
use super::field_task::FieldTask;
use super::inputs::Inputs;
use crate::control::{Cancel, Stage};
use crate::error::{Error, ErrorKind, Result};
use crate::input::diagnosis::Finding;
use crate::options::Options;
use crate::panics::PanicLog;
use crate::report::{Report, StageReport, TermReport};
use crate::solver::newton::{Counters, Model, Newton, State};
use crate::stage::fit::Settling;
use crate::stage::inflate::Inflation;
use crate::stage::objective::Objective;
use crate::stage::problem::Problem;

/// How often the fit goes on with wider gaps where rounding has broken its result.
const MOST_WIDENINGS: u32 = 2;

/// What all work of a session has with it.
#[derive(Clone, Default)]
pub(super) struct Context {
    /// Stops it.
    pub(super) stop: Cancel,
    /// Hears of its panics.
    pub(super) panics: Arc<PanicLog>,
    /// Where it is to panic.
    pub(super) fault: Option<Fault>,
}

/// What exists between `prepare` and `reset`.
pub(super) struct Work {
    options: Options,
    pub(super) problem: Arc<Problem>,
    pub(super) state: State,
    objective: Objective,
    newton: Newton,
    step: Step,
    field: FieldTask,
    /// Pairs of garment triangles that intersected at the start.
    pub(super) tangled: Arc<[[u32; 2]]>,
    /// How often the gaps were widened.
    widened: u32,
    /// The gaps are to be widened.
    is_narrow: bool,
    /// What was measured so far.
    pub(super) report: Report,
    pub(super) context: Context,
}

/// The step of the paper that is under way.
enum Step {
    Inflate(Inflation),
    Fit(Settling),
}

impl Work {
    /// Step 1: poses the problem of `inputs`, begins to build the distance field with so many threads, and sets up Step 2.
    /// What is worth knowing goes to `findings`, also where it fails.
    pub(super) fn prepare(
        inputs: &Inputs,
        threads: usize,
        context: Context,
        findings: &mut Vec<Finding>,
    ) -> Result<Self> {
        let stop = &context.stop;
        Fault::Prepare.at(context.fault);
        let clock = Instant::now();
        let problem = inputs.pose_problem(stop, findings)?;
        stop.check()?;
        let field = FieldTask::start(problem.avatar.clone(), inputs.options.voxel, threads, &context)?;
        let state = State { x: problem.rest.clone(), t: 0.0 };
        let mut objective = problem.begin(&inputs.options, findings)?;
        stop.check()?;
        let newton = Newton::new(state.x.len(), &objective.terms())?.watching(stop.clone());
        objective.watch(stop.clone());
        let mut report = Report {
            garment_size: [problem.rest.len(), problem.triangles.len()],
            avatar_size: [problem.avatar.positions.len(), problem.avatar.triangles.len()],
            projected_size: [problem.projected.start.len(), problem.projected.triangles.len()],
            separation_floor: objective.floor(),
            tangled_at_start: objective.tangle().triangle_pairs().len(),
            threads,
            ..Report::default()
        };
        report.prepare.seconds = clock.elapsed().as_secs_f64();
        let (problem, step) = (Arc::new(problem), Step::Inflate(Inflation::default()));
        let tangled = objective.tangle().triangle_pairs().into();
        let options = inputs.options.clone();
        let (widened, is_narrow) = (0, false);
        Ok(Self {
            options,
            problem,
            state,
            objective,
            newton,
            step,
            field,
            tangled,
            widened,
            is_narrow,
            report,
            context,
        })
    }

    /// Iterations of the step under way.
    pub(super) fn iterations(&self) -> u32 {
        match &self.step {
            Step::Inflate(s) => s.iterations,
            Step::Fit(s) => s.iterations,
        }
    }

    /// One iteration, and the passage to the next stage where one has ended. [`Stage::Verify`] when all are.
    pub(super) fn iterate(&mut self) -> Result<Stage> {
        Fault::Iteration.at(self.context.fault);
        Fault::Worker.at(self.context.fault);
        let clock = Instant::now();
        if std::mem::take(&mut self.is_narrow) {
            self.objective.widen();
            self.newton.forget_values();
            self.step = Step::Fit(Settling::begin(&mut self.objective, &self.state, &self.options));
        }
        let options = &self.options;
        let before = self.newton.counters;
        let (stage, ended) = match &mut self.step {
            Step::Inflate(inflation) => {
                check_limit(inflation.iterations, options, "inflation", self.state.t)?;
                let ended = inflation.iterate(&mut self.objective, &mut self.newton, &mut self.state)?;
                (Stage::Inflate, ended)
            }
            Step::Fit(settling) => {
                let converged = settling.iterate(&mut self.objective, &mut self.newton, &mut self.state, options)?;
                self.report.converged = converged;
                (Stage::Fit, converged || settling.iterations >= options.max_iterations)
            }
        };
        if self.objective.review(self.state.configuration())? {
            self.newton.forget_values();
        }
        let part = if stage == Stage::Inflate { &mut self.report.inflate } else { &mut self.report.fit };
        part.add(&before, &self.newton.counters, clock.elapsed());
        self.describe();
        match (stage, ended) {
            (_, false) => Ok(stage),
            (Stage::Inflate, true) => {
                self.begin_fit()?;
                Ok(Stage::Fit)
            }
            (_, true) => Ok(Stage::Verify),
        }
    }

    /// Step 3 is to go on with wider gaps. False where that was done often enough.
    pub(super) fn widen(&mut self) -> bool {
        self.is_narrow = self.widened < MOST_WIDENINGS;
        self.widened += 1;
        self.is_narrow
    }

    fn begin_fit(&mut self) -> Result<()> {
        let options = &self.options;
        let clock = Instant::now();
        let (field, seconds) = self.field.wait()?;
        self.report.field_seconds = seconds;
        let mut objective = self.problem.fit_objective(Arc::new(field), &self.state.x, options)?;
        objective.take_over(&self.objective);
        self.objective = objective;
        self.objective.watch(self.context.stop.clone());
        self.context.stop.check()?;
        self.newton = Newton::new(self.state.x.len(), &self.objective.terms())?.watching(self.context.stop.clone());
        self.step = Step::Fit(Settling::begin(&mut self.objective, &self.state, options));
        self.report.fit.seconds += clock.elapsed().as_secs_f64();
        self.report.fit.analyses += 1;
        Ok(())
    }

    fn describe(&mut self) {
        let report = &mut self.report;
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
