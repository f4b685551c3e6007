//! What exists between `prepare` and `reset`: the problem, its present state, and the stage under way.

use std::sync::Arc;
use std::time::Instant;

use glam::{DAffine3, DVec3};

use super::context::Context;
use super::fault::Fault;
use super::field_task::FieldTask;
use super::inputs::{Inputs, Posed, Setting};
use super::other_pose::{FirstPose, OtherPose};
use super::reposing::Reposing;
use crate::control::{Cancel, Stage};
use crate::error::{Error, ErrorKind, Result};
use crate::input::body::Body;
use crate::input::coordinate_system::CoordinateSystem;
use crate::input::diagnostic::Diagnostic;
use crate::memory::{MemoryLimit, Part, Sizes};
use crate::options::Options;
use crate::report::{Report, StageReport, TermReport};
use crate::sdf::Field;
use crate::solver::newton::{Model, Newton, State};
use crate::stage::attempts::Attempts;
use crate::stage::blockage;
use crate::stage::finish;
use crate::stage::fit::{End, FitStage};
use crate::stage::inflate::{Inflation, stalled_message};
use crate::stage::objective::Objective;
use crate::stage::setup::problem::Problem;

/// Where these many iterations of two runs end alike, to the bit, all do.
const OPENING: u32 = 4;

/// How often the fit goes on with wider contact distances where rounding has made its result intersect.
const MAX_DISTANCE_DOUBLINGS: u32 = 2;

/// What exists between `prepare` and `reset`.
pub(super) struct Run {
    pub(super) options: Options,
    pub(super) problem: Arc<Problem>,
    /// The body to dress with its layers, as the caller gave them.
    pub(super) body: Arc<Body>,
    /// In which they are read: the caller's, turned where the target faces another way than the source.
    pub(super) target_coordinate_system: CoordinateSystem,
    pub(super) state: State,
    pub(super) objective: Objective,
    pub(super) newton: Newton,
    pub(super) step: Step,
    /// What was tried where the inflation stalled.
    pub(super) attempts: Attempts,
    /// The way to the target's own pose, where that begins after the inflation.
    pub(super) reposing: Option<Box<Reposing>>,
    /// What the target's own pose can be exchanged for.
    pub(super) other_pose: Option<Box<OtherPose>>,
    /// What came of the pose that was tried first, once it was exchanged.
    pub(super) first_pose: Option<Box<FirstPose>>,
    /// What closed that way, and how each joint of the target rig moves into the pose in which the garment stays.
    pub(super) blocked: Option<(Diagnostic, Vec<DAffine3>)>,
    /// The first steps of the first attempt, once they are done.
    pub(super) opening: Option<Box<State>>,
    /// Where an earlier attempt came farthest.
    pub(super) farthest: Option<Box<(Objective, State)>>,
    pub(super) field: FieldTask,
    /// The garment as the fit began: the measure of the fit term is taken there.
    pub(super) fit_began_at: Vec<DVec3>,
    /// Pairs of garment triangles that intersected at the start.
    pub(super) initial_intersections: Arc<[[u32; 2]]>,
    /// How often the contact distances were doubled.
    doublings: u32,
    /// They are to be doubled before the next iteration.
    must_widen: bool,
    /// What was measured so far.
    pub(super) report: Report,
    /// When `prepare` began.
    pub(super) begun: Instant,
    /// The inflation came to the limit of its iterations.
    pub(super) is_limited: bool,
    /// Triangles of the avatar without which the caller will try, too.
    pub(super) dispensable: Option<Arc<[bool]>>,
    /// Such a part holds the garment against one that it touches.
    pub(super) is_left: bool,
    /// Bytes of the inputs and the problem.
    pub(super) held: u64,
    /// Bytes of the distance field, as estimated.
    expected: u64,
    /// The distance field and the seconds that it took, once it was waited for.
    pub(super) distance: Option<(Arc<Field>, f64)>,
    /// The weights of the avatar's morphs in the shape that it has; none in its own.
    pub(super) shape: Vec<f64>,
    /// The body in its own shape, once it has had another.
    pub(super) own_shape: Option<Arc<Body>>,
    /// What the result falls short of, or what holds the garment where there is none.
    pub(super) shortfalls: Vec<Diagnostic>,
    pub(super) context: Context,
}

/// The stage that is under way.
pub(super) enum Step {
    Inflate(Inflation),
    Repose(Box<Reposing>),
    Fit(FitStage),
    /// Nothing, while one of the others goes on, and where a refit waits for the distance to another shape of the avatar.
    Between,
}

impl Run {
    /// Stage PREPARE: poses the problem of `inputs`, begins to build the distance field with so many threads, and sets up the
    /// inflation. Adds to `diagnostics`, also where it fails.
    pub(super) fn prepare(
        inputs: &Inputs,
        threads: usize,
        context: Context,
        diagnostics: &mut Vec<Diagnostic>,
    ) -> Result<Self> {
        let stop = &context.stop;
        Fault::Prepare.at(context.fault);
        let begun = Instant::now();
        let options = inputs.options.clone();
        let limit = MemoryLimit::new(options.memory_limit);
        let (Posed { first, mut own, other, rig_seconds, own_seconds }, expected) =
            pose(inputs, limit, stop, diagnostics)?;
        let Setting { mut problem, body, system: target_coordinate_system, turn } = first;
        let other = other.map(|(design, way)| Box::new(OtherPose { inputs: inputs.clone(), design, way, turn }));
        let fitted = own.as_ref().map_or(&problem, |(own, _)| &own.problem).fitted.clone();
        let mut field = FieldTask::start(fitted, options.voxel_size, threads, &context);
        let mut distance = None;
        if !problem.carried.is_empty() {
            // Where carried pieces go is known with the distance only.
            let (built, seconds) = field.wait()?;
            if let Some((own, _)) = &mut own {
                own.problem.settle_carried(&built);
                let mut posed = FieldTask::start(problem.fitted.clone(), options.voxel_size, threads, &context);
                problem.settle_carried(&posed.wait()?.0);
            } else {
                problem.settle_carried(&built);
            }
            distance = Some((built, seconds));
        }
        let own_memory = own.as_ref().map_or(0, |(own, _)| own.problem.memory());
        let state = State { x: problem.initial_state(false).0.to_vec(), t: 0.0 };
        let mut objective = problem.inflation_objective(&options, stop, diagnostics)?;
        stop.check()?;
        let other_memory = other.as_ref().map_or(0, |other| other.memory());
        let held = inputs.memory() + problem.memory() + own_memory + other_memory;
        let budget = limit.reserving(held + expected + objective.memory());
        let mut newton = Newton::new(state.x.len(), &objective.terms(), budget, stop.clone())?;
        let mut report = initial_report(&problem, &body, &objective, threads);
        report.prepare.collect(&mut newton, &mut objective, begun);
        report.prepare.seconds -= own_seconds;
        report.repose.seconds += own_seconds;
        report.rig_seconds = rig_seconds;
        let mut run = Self {
            options,
            problem: Arc::new(problem),
            body: Arc::new(body),
            target_coordinate_system,
            state,
            initial_intersections: objective.contact.exempt_pairs().triangle_pairs().into(),
            objective,
            newton,
            step: Step::Inflate(Inflation::default()),
            attempts: Attempts::default(),
            blocked: None,
            reposing: own.map(|(own, way)| Box::new(Reposing::new(Arc::new(own.problem), Arc::new(own.body), way))),
            other_pose: other,
            first_pose: None,
            opening: None,
            farthest: None,
            field,
            fit_began_at: Vec::new(),
            held,
            expected,
            distance,
            doublings: 0,
            must_widen: false,
            report,
            begun,
            is_limited: false,
            dispensable: inputs.dispensable.clone(),
            is_left: false,
            shape: Vec::new(),
            own_shape: None,
            shortfalls: Vec::new(),
            context,
        };
        run.check_memory()?;
        Ok(run)
    }

    /// Counts what an earlier try took, of which `report` is, and which began at `begun`.
    pub(super) fn follow(&mut self, report: &Report, begun: Option<Instant>) {
        self.begun = begun.unwrap_or(self.begun);
        let own = &mut self.report;
        own.rig_seconds += report.rig_seconds;
        for (part, earlier) in [
            (&mut own.prepare, &report.prepare),
            (&mut own.inflate, &report.inflate),
            (&mut own.repose, &report.repose),
        ] {
            part.seconds += earlier.seconds;
            part.iterations += earlier.iterations;
            part.factorisations += earlier.factorisations;
            part.analyses += earlier.analyses;
            part.profile += &earlier.profile;
        }
    }

    /// Iterations of the stage under way.
    pub(super) fn iterations(&self) -> u32 {
        match &self.step {
            Step::Inflate(s) => s.iterations,
            Step::Repose(s) => s.iterations,
            Step::Fit(s) => s.iterations,
            Step::Between => 0,
        }
    }

    /// One iteration, and the passage to the next stage where one has ended. [`Stage::Verify`] when all are.
    pub(super) fn iterate(&mut self) -> Result<Stage> {
        Fault::Iteration.at(self.context.fault);
        Fault::Worker.at(self.context.fault);
        let clock = Instant::now();
        if std::mem::take(&mut self.must_widen) {
            self.objective.contact.double_distances();
            self.newton.forget_values();
            self.step = Step::Fit(FitStage::begin(&mut self.objective, &self.state, &self.options));
        }
        if let Step::Repose(_) = self.step {
            return self.iterate_on_the_way(clock);
        }
        if let Step::Between = self.step {
            self.begin_refit()?;
        }
        let options = &self.options;
        let (stage, ended) = match &mut self.step {
            Step::Repose(_) | Step::Between => {
                return Err(Error::new(ErrorKind::Internal, "no stage is under way"));
            }
            Step::Inflate(inflation) => {
                let limited = check_limit(inflation.attempted(), options, self.state.t);
                self.is_limited = limited.is_err();
                let ended = match limited {
                    Err(error) if self.attempts.settings().is_none() && self.first_pose.is_none() => {
                        return Err(self.explained(error));
                    }
                    limited => {
                        limited.and_then(|()| inflation.iterate(&mut self.objective, &mut self.newton, &mut self.state))
                    }
                };
                let wedged = if matches!(ended, Ok(false)) { inflation.is_wedged() } else { [false; 2] };
                let ended = match self.is_held(wedged) {
                    true => Err(Error::new(ErrorKind::InflationStalled, stalled_message(self.state.t))),
                    false => ended,
                };
                match ended {
                    Ok(ended) => (Stage::Inflate, ended),
                    Err(error) if error.kind == ErrorKind::InflationStalled => {
                        if !self.try_again()? && (self.is_left || !self.try_other_pose()?) {
                            return Err(self.explained(error));
                        }
                        (Stage::Inflate, false)
                    }
                    Err(error) => return Err(error),
                }
            }
            Step::Fit(fit) => {
                let end = fit.iterate(&mut self.objective, &mut self.newton, &mut self.state, options)?;
                self.report.converged = end == Some(End::Converged);
                self.report.stuck = end == Some(End::Stuck);
                (Stage::Fit, end.is_some() || fit.iterations >= options.max_iterations)
            }
        };
        if stage == Stage::Fit && ended {
            let as_designed = self.attempts.settings().is_some_and(|settings| settings.as_designed);
            let untangling = if as_designed { None } else { self.problem.untangling() };
            // Where the way back is closed, that is told.
            let brought_back = self.first_pose.as_ref().filter(|_| self.blocked.is_none());
            let posed = brought_back.and_then(|first| first.diagnostic());
            self.shortfalls = posed.into_iter().chain(self.attempts.adjustment()).chain(untangling).collect();
            self.shortfalls.extend(finish::finish(&self.problem, &mut self.objective, &mut self.state)?);
            self.newton.forget_values();
        }
        if self.objective.contact.update_exemptions(self.state.configuration())? {
            self.newton.forget_values();
        }
        if stage == Stage::Inflate && self.opening.is_none() && self.iterations() == OPENING {
            self.opening = Some(Box::new(self.state.clone()));
        }
        let part = if stage == Stage::Inflate { &mut self.report.inflate } else { &mut self.report.fit };
        part.iterations += 1;
        part.collect(&mut self.newton, &mut self.objective, clock);
        self.update_report();
        self.check_memory()?;
        match (stage, ended) {
            (_, false) => Ok(stage),
            (Stage::Inflate, true) => {
                if let Some(reposing) = self.reposing.take() {
                    self.begin_repose(reposing)?;
                    return Ok(Stage::Repose);
                }
                self.report.feasible_seconds = self.begun.elapsed().as_secs_f64();
                self.begin_fit()?;
                Ok(Stage::Fit)
            }
            (_, true) => Ok(Stage::Verify),
        }
    }

    /// One iteration of the way to the target's own pose.
    fn iterate_on_the_way(&mut self, clock: Instant) -> Result<Stage> {
        let Step::Repose(reposing) = std::mem::replace(&mut self.step, Step::Between) else {
            return Err(Error::new(ErrorKind::Internal, "the body is not on its way"));
        };
        let ended = self.iterate_repose(reposing)?;
        if self.objective.contact.update_exemptions(self.state.configuration())? {
            self.newton.forget_values();
        }
        self.report.repose.iterations += 1;
        self.report.repose.collect(&mut self.newton, &mut self.objective, clock);
        self.update_report();
        self.check_memory()?;
        if ended {
            self.report.feasible_seconds = self.begun.elapsed().as_secs_f64();
            self.begin_fit()?;
            return Ok(Stage::Fit);
        }
        Ok(Stage::Repose)
    }

    /// Where the inflation has stalled, finds what holds the garment, and points to the diagnostics in the message.
    fn explained(&mut self, mut error: Error) -> Error {
        if error.kind == ErrorKind::InflationStalled {
            if let Some(farthest) = self.farthest.take()
                && farthest.1.t > self.state.t
            {
                (self.objective, self.state) = *farthest;
            }
            if let Some((t, other)) = self.return_to_first_pose() {
                error.message = stalled_message(t) + &format!("; {other} did not help");
            } else if self.attempts.settings().is_some() {
                // Not the attempt that tells what holds the garment need have come farthest.
                let farthest = self.attempts.places().iter().copied().fold(self.state.t, f64::max);
                error.message = stalled_message(farthest);
            }
            self.initial_intersections = self.objective.contact.exempt_pairs().triangle_pairs().into();
            let at = self.state.configuration();
            self.shortfalls = blockage::find(&self.problem, &self.body, &mut self.objective, at);
            if !self.shortfalls.is_empty() {
                error.message += "; the diagnostics name what holds the garment";
            }
            if !self.problem.has_skin {
                error.message +=
                    "; the avatar has no skin weights, which would say to which bone each part of it belongs";
            }
        }
        error
    }

    /// Makes the fit go on with wider contact distances. False where that was done often enough.
    pub(super) fn widen(&mut self) -> bool {
        self.must_widen = self.doublings < MAX_DISTANCE_DOUBLINGS;
        self.doublings += 1;
        self.must_widen
    }

    fn begin_fit(&mut self) -> Result<()> {
        if let Some(settings) = self.attempts.settings() {
            self.options.inflation_barrier_weight = settings.inflation_barrier_weight;
        }
        let clock = Instant::now();
        let field = self.wait_for_field()?;
        let options = &self.options;
        let stop = &self.context.stop;
        self.fit_began_at.clone_from(&self.state.x);
        let mut objective = self.problem.fit_objective(field, &self.state.x, options, stop)?;
        if let Some(settings) = self.attempts.settings() {
            objective.contact.set_inflation_dhat(settings.inflation_dhat);
        }
        self.farthest = None;
        self.first_pose.iter_mut().for_each(|first| first.forget_stalled());
        self.take_up(objective)?;
        self.step = Step::Fit(FitStage::begin(&mut self.objective, &self.state, &self.options));
        self.report.fit.collect(&mut self.newton, &mut self.objective, clock);
        Ok(())
    }

    /// The distance field, once it is there.
    pub(super) fn wait_for_field(&mut self) -> Result<Arc<Field>> {
        let clock = Instant::now();
        let (field, seconds) = match &self.distance {
            Some(known) => known.clone(),
            None => self.distance.insert(self.field.wait()?).clone(),
        };
        self.report.field_seconds = seconds;
        self.report.field_wait_seconds = clock.elapsed().as_secs_f64();
        Ok(field)
    }

    /// Goes on with `objective` in place of the one before, in whose contacts the garment is.
    pub(super) fn take_up(&mut self, mut objective: Objective) -> Result<()> {
        objective.contact.inherit_state(&self.objective.contact);
        self.objective = objective;
        self.context.stop.check()?;
        let budget = self.remaining_budget().reserving(self.objective.memory());
        // Two linear systems at once would be most of the memory.
        self.newton.release();
        self.newton = Newton::new(self.state.x.len(), &self.objective.terms(), budget, self.context.stop.clone())?;
        self.objective.contact.limit_pairs(self.remaining_budget().reserving(self.newton.memory()));
        Ok(())
    }

    /// Bytes of the distance field.
    fn field_memory(&self) -> u64 {
        self.distance.as_ref().map_or(self.expected, |(field, _)| field.memory() + field.closest_point().memory())
    }

    /// The memory that is left for objective and solver.
    pub(super) fn remaining_budget(&self) -> MemoryLimit {
        MemoryLimit::new(self.options.memory_limit).reserving(self.held + self.field_memory())
    }

    /// Reports the memory that is held, and refuses to go on beyond the limit.
    fn check_memory(&mut self) -> Result<()> {
        let (contacts, system) = (self.objective.memory(), self.newton.memory());
        let kept = self.farthest.as_ref().map_or(0, |farthest| farthest.0.memory())
            + self.first_pose.as_ref().map_or(0, |first| first.memory());
        self.report.memory = self.held + self.field_memory() + contacts + system + kept;
        let limit = self.remaining_budget();
        let parts = [
            Part { name: "the linear system of the garment", bytes: system },
            Part { name: "contacts of the garment", bytes: contacts },
        ];
        limit.check(&parts)?;
        if self.objective.contact.exceeds_pair_budget() {
            return Err(limit.exceeded_error("contacts of the garment, more pairs than there is budget for"));
        }
        self.objective.contact.limit_pairs(limit.reserving(system));
        Ok(())
    }

    pub(super) fn update_report(&mut self) {
        let report = &mut self.report;
        let at = self.state.configuration();
        let contact = self.objective.contact.activity(at);
        report.active_contacts = contact.count;
        report.min_distance_self = contact.min_distance_self;
        report.min_distance_avatar = contact.min_distance_avatar;
        report.gradient_norm = self.newton.gradient_norm();
        report.min_separation = self.objective.contact.min_separation();
        report.t = self.state.t;
        let terms = self.objective.terms();
        let values = self.newton.values(&terms, at);
        report.terms = terms
            .iter()
            .zip(values)
            // The sum of no elements is -0.
            .map(|(term, &value)| TermReport { name: term.energy.name(), value: value + 0.0, weight: term.weight })
            .collect();
    }
}

/// The problem of `inputs`, and the bytes that the distance field is expected to take. Refuses early what will exceed `limit`.
fn pose(inputs: &Inputs, limit: MemoryLimit, stop: &Cancel, diagnostics: &mut Vec<Diagnostic>) -> Result<(Posed, u64)> {
    let left = limit.reserving(inputs.memory());
    let sizes = inputs.sizes();
    left.check(&sizes.estimate())?;
    let posed = inputs.pose_problem(stop, diagnostics)?;
    stop.check()?;
    let problem = posed.own.as_ref().map_or(&posed.first.problem, |(own, _)| &own.problem);
    let field = Field::estimate(&problem.fitted, inputs.options.voxel_size)?;
    let sizes = Sizes { avatar_triangles: problem.projected.triangles.len(), field, ..sizes };
    left.check(&sizes.estimate())?;
    Ok((posed, field))
}

/// The report before the first iteration.
fn initial_report(problem: &Problem, body: &Body, objective: &Objective, threads: usize) -> Report {
    Report {
        garment_size: [problem.rest.len(), problem.triangles.len()],
        avatar_size: body.avatar_size(),
        projected_size: problem.projected.size_of_first(body.avatar_size()[1]),
        min_separation: objective.contact.min_separation(),
        initial_self_intersections: problem.designed_intersections.len() - problem.initial_state(false).1.len()
            + objective.contact.exempt_pairs().triangle_pairs().len(),
        threads,
        ..Report::default()
    }
}

fn check_limit(iterations: u32, options: &Options, t: f64) -> Result<()> {
    if iterations < options.max_iterations {
        return Ok(());
    }
    Err(Error::new(
        ErrorKind::InflationStalled,
        format!("the inflation did not end in {iterations} iterations: t is {t:.4}; raise max_iterations"),
    ))
}

impl StageReport {
    /// Adds what solver and objective have counted since the last call, and the time since `clock`.
    pub(super) fn collect(&mut self, newton: &mut Newton, objective: &mut Objective, clock: Instant) {
        self.seconds += clock.elapsed().as_secs_f64();
        let counters = std::mem::take(&mut newton.counters);
        self.factorisations += counters.factorisations;
        self.analyses += counters.analyses;
        self.profile += &counters.profile;
        self.profile += &objective.contact.take_profile();
    }
}
