//! One garment on its way to one avatar: the state machine that a caller sees.
//!
//! What takes long is done by jobs in the session's own threads, one after the other, which own what they work on. The
//! snapshot that can be read is kept apart from them: it is replaced after each iteration, and stays when a job is abandoned.

mod aside;
mod body_parts;
mod context;
mod covered;
mod curves;
mod dressed_source;
mod exchange_pose;
mod fault;
mod field_task;
mod fit_controls;
mod followers;
mod garment_normals;
mod garment_skin;
mod inputs;
mod key_poses;
mod morph_solve;
mod morphs;
mod on_the_way;
mod other_attempts;
mod other_pose;
mod outfit;
mod pin;
mod plausibility;
mod pose_solve;
mod refit;
mod reposing;
mod rig_inputs;
mod rigs;
mod run;
mod shared;
mod snapshot;
mod target_morphs;
mod verification;
mod way;
mod worker_pool;

use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex, OnceLock};
use std::time::Instant;

use glam::{DAffine3, DVec3};

pub use crate::control::Stage;
use crate::control::{Cancel, Cancelled, Control, MAX_TERMS, Progress};
use crate::error::{Error, ErrorKind, Result};
pub use crate::geometry::covered::CoveredOptions;
use crate::geometry::mesh::TriangleMesh;
pub use crate::geometry::outfit::{OutfitOrder, WornPair, outfit_order};
pub use crate::input::body::PartRole;
pub use crate::input::curve::Curve;
use crate::input::diagnostic::Diagnostic;
pub use crate::input::key_pose::KeyPose;
pub use crate::input::morph::Morph;
pub use crate::input::precision::Precision;
pub use crate::options::Options;
use crate::panics::PanicLog;
pub use crate::report::{Report, StageReport, TermReport, Verification};
use crate::rig::words::with_names;
use crate::stage::inflate::stalled_message;
use context::Context;
use covered::Covered;
use dressed_source::FirstTry;
#[doc(hidden)]
pub use fault::Fault;
use followers::Follower;
pub use garment_normals::RenderMesh;
pub use garment_skin::GarmentSkin;
use inputs::Inputs;
pub use pin::Pin;
pub use pose_solve::{PoseCorrection, PoseCounts};
use run::Run;
pub use shared::{SharedAvatar, SharedGarment};
use snapshot::Snapshot;
use target_morphs::Answer;
use verification::Verdict;
use worker_pool::WorkerPool;

/// How much a call of [`Session::step`] may do; 0 is no limit. At least one iteration is done.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Budget {
    /// Newton iterations.
    pub iterations: u32,
    /// Wall milliseconds; checked between iterations.
    pub milliseconds: u32,
}

/// One retargeting: inputs, then `prepare`, then `step` or `run`, then results.
///
/// A request to stop (see [`Session::control`]) ends the call that runs at once, whatever it is doing; its job is abandoned
/// and ends in the background. `reset` and dropping the session wait for that.
#[derive(Default)]
pub struct Session {
    inputs: Inputs,
    control: Arc<Control>,
    /// Requests to stop that a call has answered.
    answered: AtomicU64,
    /// Present between two jobs; gone once one was abandoned.
    run: Option<Box<Run>>,
    /// After `run`, which is dropped first.
    pool: Option<WorkerPool>,
    snapshot: Option<Snapshot>,
    stage: Stage,
    report: Report,
    diagnostics: Vec<Diagnostic>,
    /// How many of them are about the inputs: the first.
    said_of_inputs: usize,
    /// There was a result since `prepare`.
    has_ended: bool,
    /// What came of the source avatar as it is, where the run is one with the garment on it.
    first_try: Option<Box<FirstTry>>,
    /// The verification of the result in the precision that is not the garment's own.
    other_precision: Option<(Precision, Verification)>,
    /// The skin weights of the result, once they were asked for.
    skin: OnceLock<Arc<GarmentSkin>>,
    /// What the result covers, as it was asked for last.
    covered: Mutex<Option<Covered>>,
    /// In which order the outfit is worn, and on which body, once it was asked for.
    outfit_order: Option<(Option<Arc<TriangleMesh>>, Arc<OutfitOrder>)>,
    /// The followers at the result.
    followers: Vec<Follower>,
    /// What is known of the garment's answers to the avatar's morphs.
    answers: Vec<Answer>,
    /// The corrections of key poses that are solved, and for how many joints a vertex.
    corrections: Vec<Option<(usize, PoseCorrection)>>,
    /// How each joint of the target rig moves into the pose that the result is in, where that is not its own.
    pose: Option<Vec<DAffine3>>,
    /// The joints of the common skeleton of two rigs, once something is said of them.
    joint_names: OnceLock<Option<Vec<String>>>,
    panics: Arc<PanicLog>,
    fault: Option<Fault>,
    /// For tests: more threads than cores are not refused.
    crowded: bool,
}

impl Session {
    /// A session without inputs.
    pub fn new() -> Self {
        Self::default()
    }

    /// Lets the session have as many threads as its options say, beyond the cores: for tests that look whether the number
    /// of threads makes a difference. The C API has no way to ask for it.
    #[doc(hidden)]
    pub fn crowd(&mut self) {
        self.crowded = true;
    }

    /// Stage PREPARE: checks the inputs against each other, projects the avatar onto the skeleton, begins to build the distance
    /// field.
    ///
    /// # Errors
    /// `InvalidState` where an input is missing or the session is past this, `InvalidSkeleton`, `InvalidWeights`,
    /// `NotEnclosed`, `Cancelled`. The session then still takes inputs.
    pub fn prepare(&mut self) -> Result<()> {
        self.setting("prepare was called already: the inputs")?;
        if self.control.is_cancelled() {
            return Err(self.answer(Cancelled.into()));
        }
        self.joint_names = OnceLock::new();
        self.first_try = None;
        self.pool = Some(WorkerPool::new(self.wanted_threads(), &self.panics)?);
        let outcome = self.prepare_run(self.inputs.clone());
        let run = match outcome.or_else(|refused| self.prepare_dressed(refused)) {
            Ok(run) => run,
            Err(error) if error.kind == ErrorKind::Cancelled => return Err(self.answer(error)),
            Err(error) => {
                self.pool = None;
                return Err(self.worded(error));
            }
        };
        self.said_of_inputs = self.diagnostics.len();
        self.has_ended = false;
        self.report = run.report.clone();
        self.snapshot = Some(Snapshot::of(&run));
        self.run = Some(run);
        self.enter(Stage::Prepared);
        Ok(())
    }

    /// The run of `inputs` at its beginning, and what there is to say of them.
    fn prepare_run(&mut self, inputs: Inputs) -> Result<Box<Run>> {
        let Some(pool) = &self.pool else { return Err(Error::new(ErrorKind::Internal, "a session without threads")) };
        let (panics, shared) = (self.panics.clone(), inputs.shared.clone());
        let context = Context { stop: Cancel::new(), panics, fault: self.fault, shared };
        let stop = context.stop.clone();
        let control = &self.control;
        let threads = pool.size();
        let job = move || {
            let mut diagnostics = Vec::new();
            let run = Run::prepare(&inputs, threads, context, &mut diagnostics).map(Box::new);
            (run, diagnostics)
        };
        let (run, diagnostics) = pool.run(|| control.is_cancelled(), &stop, job)?;
        self.diagnostics = diagnostics;
        run
    }

    /// As many threads as the options say. More than cores would wait for each other at every loop.
    fn wanted_threads(&self) -> usize {
        let cores = std::thread::available_parallelism().map_or(1, usize::from);
        match self.inputs.options.threads as usize {
            0 => cores,
            wanted if self.crowded => wanted,
            wanted => wanted.min(cores),
        }
    }

    /// Requests to stop that a call has answered.
    fn answered(&self) -> u64 {
        self.answered.load(Ordering::Relaxed)
    }

    /// Records that a request to stop was answered, where `error` is that answer.
    fn answer(&self, error: Error) -> Error {
        if error.kind == ErrorKind::Cancelled {
            self.answered.store(self.control.requests(), Ordering::Relaxed);
        }
        error
    }

    /// Goes on within `budget`. Returns the stage that is reached; at [`Stage::Done`] the result is verified.
    ///
    /// # Errors
    /// `InvalidState` before `prepare` or after the end, `Cancelled`, `InflationStalled`, `NotVerified`, `ImplausibleResult`,
    /// `Internal`; `NotEnclosed` where that was the reason to try it with the garment on the source avatar, in vain. The garment
    /// can still be read; with `ImplausibleResult` it is verified and the stage is [`Stage::Done`].
    pub fn step(&mut self, budget: Budget) -> Result<Stage> {
        if !matches!(self.stage, Stage::Prepared | Stage::Inflate | Stage::Repose | Stage::Fit) {
            return Err(Error::new(
                ErrorKind::InvalidState,
                match self.stage {
                    Stage::Setup => "step was called before prepare",
                    _ => "the session has ended; call reset to begin again with the same inputs",
                },
            ));
        }
        self.iterate(budget).map_err(|error| {
            let error = self.told_of_first(error);
            self.enter(match error.kind {
                ErrorKind::Cancelled => Stage::Cancelled,
                ErrorKind::ImplausibleResult => Stage::Done,
                _ => Stage::Failed,
            });
            let error = self.worded(error);
            self.answer(error)
        })
    }

    fn iterate(&mut self, budget: Budget) -> Result<Stage> {
        let clock = Instant::now();
        let mut iterations = 0;
        loop {
            let mut stage = match self.iterate_once() {
                Err(refused) if refused.kind == ErrorKind::InflationStalled => self.begin_dressed(refused)?,
                outcome => outcome?,
            };
            if stage == Stage::Inflate && self.repeats_first() {
                // The first try's error takes its place.
                return Err(Error::new(ErrorKind::InflationStalled, stalled_message(self.report.t)));
            }
            self.enter(stage);
            if stage == Stage::Verify {
                stage = self.finish()?;
                if stage == Stage::Done {
                    return Ok(stage);
                }
            }
            iterations += 1;
            let spent = clock.elapsed().as_millis() >= u128::from(budget.milliseconds);
            if budget.iterations != 0 && iterations >= budget.iterations || budget.milliseconds != 0 && spent {
                return Ok(stage);
            }
        }
    }

    /// One job: the run is moved to it and comes back.
    fn iterate_once(&mut self) -> Result<Stage> {
        if self.control.is_cancelled() {
            return Err(Cancelled.into());
        }
        let (Some(mut run), Some(pool)) = (self.run.take(), &self.pool) else {
            return Err(Error::new(ErrorKind::Internal, "there is no run in a session under way"));
        };
        let stop = run.context.stop.clone();
        let control = &self.control;
        let (mut run, outcome) = pool.run(
            || control.is_cancelled(),
            &stop,
            move || {
                let outcome = run.iterate();
                (run, outcome)
            },
        )?;
        self.report = run.report.clone();
        if let Some(snapshot) = &mut self.snapshot {
            snapshot.update(&run);
        }
        if let Err(error) = &outcome
            && error.kind == ErrorKind::InflationStalled
        {
            self.diagnostics.append(&mut run.shortfalls);
        }
        self.run = Some(run);
        outcome
    }

    /// The exact verifier decides, on the values as the caller will read them. If it finds an intersection, the fit goes on
    /// with wider contact distances, a few times.
    fn finish(&mut self) -> Result<Stage> {
        let clock = Instant::now();
        let precision = self.inputs.garment.as_ref().map_or(Precision::F32, |g| g.1);
        let control = &self.control;
        let verdict = self.verify_as_read(precision, || control.is_cancelled())?;
        self.report.verify_seconds += clock.elapsed().as_secs_f64();
        let counted = verdict.counted;
        self.report.verification = Some(counted);
        if !counted.is_clean() {
            if let Some(run) = &mut self.run
                && run.widen()
            {
                self.enter(Stage::Fit);
                return Ok(Stage::Fit);
            }
            self.diagnostics.extend(verdict.diagnostics());
            return Err(not_verified(&counted));
        }
        self.diagnostics.extend(self.run.iter_mut().flat_map(|run| std::mem::take(&mut run.shortfalls)));
        let (clock, other) = (Instant::now(), precision.other());
        self.other_precision = Some((other, self.verify_as_read(other, || self.control.is_cancelled())?.counted));
        self.report.verify_seconds += clock.elapsed().as_secs_f64();
        if !self.report.converged {
            let Report { fit, stuck, .. } = &self.report;
            self.diagnostics.push(Diagnostic::NotConverged { iterations: fit.iterations, stuck: *stuck });
        }
        self.has_ended = true;
        self.first_try = None;
        self.carry_followers()?;
        self.compare_with_design()?;
        if let Some((blocked, motions)) = self.run.as_mut().and_then(|run| run.blocked.take()) {
            self.pose = Some(motions);
            let said = blocked.to_string();
            self.diagnostics.push(blocked);
            return Err(Error::new(
                ErrorKind::ImplausibleResult,
                format!("the garment is verified and can be read, but not in the avatar's own pose: {said}"),
            ));
        }
        self.enter(Stage::Done);
        Ok(Stage::Done)
    }

    /// From wherever the session is to the verified end.
    ///
    /// # Errors
    /// As [`Self::prepare`] and [`Self::step`].
    pub fn run(&mut self) -> Result<Stage> {
        if self.stage == Stage::Setup {
            self.prepare()?;
        }
        self.step(Budget::default())
    }

    /// Diagnostics about the inputs, since prepare, about the result, and about what holds the garment where the inflation
    /// stalled; in the caller's indices.
    pub fn diagnostics(&self) -> &[Diagnostic] {
        &self.diagnostics
    }

    /// A diagnostic in words: of two rigs, it names the joints of their common skeleton.
    pub fn sentence(&self, diagnostic: &Diagnostic) -> String {
        self.in_words(diagnostic.to_string())
    }

    /// A message with the joints of the common skeleton by their names, where rigs were set.
    fn in_words(&self, message: String) -> String {
        match self.joint_names.get_or_init(|| self.inputs.joint_names()) {
            Some(names) => with_names(&message, names),
            None => message,
        }
    }

    /// An error about the skeletons in words.
    fn worded(&self, error: Error) -> Error {
        use ErrorKind::{ImplausibleResult, InflationStalled, NotEnclosed};
        match error.kind {
            NotEnclosed | InflationStalled | ImplausibleResult => {
                Error { message: self.in_words(error.message), ..error }
            }
            _ => error,
        }
    }

    /// Where the session is.
    pub fn stage(&self) -> Stage {
        self.stage
    }

    /// What was measured so far.
    pub fn report(&self) -> Report {
        self.report.clone()
    }

    /// Progress and cancel, for any thread; may outlive the session.
    pub fn control(&self) -> Arc<Control> {
        self.control.clone()
    }

    fn enter(&mut self, stage: Stage) {
        self.stage = stage;
        let mut progress = Progress { stage, ..Progress::default() };
        if let Some(snapshot) = &self.snapshot {
            progress.t = snapshot.t;
            progress.iteration = snapshot.iteration;
            let report = &self.report;
            progress.gradient_norm = report.gradient_norm;
            progress.min_distance = report.min_distance_self.min(report.min_distance_avatar);
            progress.active_contacts = report.active_contacts as u64;
            progress.seconds =
                [report.prepare.seconds, report.inflate.seconds, report.fit.seconds, report.verify_seconds];
            progress.energy_count = report.terms.len().min(MAX_TERMS) as u32;
            for (slot, term) in progress.energies.iter_mut().zip(&report.terms) {
                *slot = term.weight * term.value;
            }
            progress.energy = progress.energies.iter().sum();
        }
        self.control.publish(&progress);
    }

    /// Collects the panic messages of the session's threads.
    #[cfg(feature = "capi")]
    pub(crate) fn panics(&self) -> Arc<PanicLog> {
        self.panics.clone()
    }

    fn readable(&self) -> Result<&Snapshot> {
        self.snapshot.as_ref().ok_or_else(|| {
            Error::new(ErrorKind::InvalidState, "there is nothing to read yet: call prepare first".to_string())
        })
    }

    /// The garment as it is now, in the caller's vertex order and the target coordinate system.
    ///
    /// # Errors
    /// `InvalidState` before `prepare`.
    pub fn garment_positions(&self) -> Result<Vec<DVec3>> {
        Ok(self.readable()?.garment_positions())
    }

    /// [`Self::garment_positions`] for a caller who stores them in `precision`. At [`Stage::Done`] they are good in it.
    ///
    /// # Errors
    /// `InvalidState` before `prepare`, `NotVerified` where the result is good in the garment's own precision only.
    pub fn garment_as_read(&self, precision: Precision) -> Result<Vec<DVec3>> {
        match &self.other_precision {
            Some((other, counted)) if *other == precision && !counted.is_clean() => Err(not_verified(counted)),
            _ => self.garment_positions(),
        }
    }

    /// How each joint of the target rig moves from its bind pose to the pose that the result is in, in the target coordinate
    /// system; none where that is the bind pose, as in all but what the diagnostic `PoseBlocked` is about.
    pub fn pose_transforms(&self) -> Option<&[DAffine3]> {
        self.pose.as_deref()
    }

    /// How much each garment triangle is distorted now, in the caller's order: the mean of Eq. 2 over its hinges, without
    /// their weights, in the form that is free for any similarity, over the ratio of the garment's whole area now to that of
    /// the design. No unit; 0 for any similarity of the garment as a whole. Of triangles in one place, all get the same;
    /// those without a shape get 0.
    ///
    /// # Errors
    /// `InvalidState` before `prepare`.
    pub fn distortion(&self) -> Result<Vec<f64>> {
        Ok(self.readable()?.distortion())
    }

    /// The avatar without its layers, as far as it is inflated now, in the caller's vertex order and the target coordinate system.
    ///
    /// # Errors
    /// `InvalidState` before `prepare`.
    pub fn avatar_positions(&self) -> Result<Vec<DVec3>> {
        Ok(self.readable()?.avatar_positions())
    }

    /// Counts intersections exactly, of the garment as a caller reads it in `precision`, against itself and the avatar with
    /// its layers at full size.
    ///
    /// # Errors
    /// `InvalidState` before `prepare`, `Cancelled` by a request that no call has answered yet; the stage stays.
    pub fn verify(&self, precision: Precision) -> Result<Verification> {
        let answered = self.answered.load(Ordering::Relaxed);
        let verified = self.verify_as_read(precision, || self.control.requests() > answered);
        verified.map(|verdict| verdict.counted).map_err(|error| self.answer(error))
    }

    fn verify_as_read(&self, precision: Precision, should_stop: impl Fn() -> bool) -> Result<Verdict> {
        let (snapshot, Some(pool)) = (self.readable()?, &self.pool) else {
            return Err(Error::new(ErrorKind::Internal, "there are no threads in a prepared session"));
        };
        if should_stop() {
            return Err(Cancelled.into());
        }
        let (snapshot, stop, fault) = (snapshot.clone(), Cancel::new(), self.fault);
        let cancel = stop.clone();
        let job = move || {
            Fault::Verify.at(fault);
            snapshot.verify_as_read(precision, &cancel)
        };
        pool.run(should_stop, &stop, job)?
    }

    /// Back to where inputs can be set; the inputs stay. Waits for a job that a request to stop has abandoned.
    pub fn reset(&mut self) {
        self.run = None;
        if let Some(pool) = self.pool.take() {
            pool.drain();
        }
        self.snapshot = None;
        self.first_try = None;
        self.report = Report::default();
        self.forget_result();
        self.diagnostics.clear();
        self.inputs.morph_weights.clear();
        self.control.clear_cancel();
        self.answered.store(0, Ordering::Relaxed);
        self.enter(Stage::Setup);
    }
}

/// What was said and asked of a result.
impl Session {
    fn forget_result(&mut self) {
        self.diagnostics.truncate(self.said_of_inputs);
        self.other_precision = None;
        self.skin = OnceLock::new();
        self.covered = Mutex::default();
        self.followers.clear();
        self.answers.clear();
        self.corrections.clear();
        self.pose = None;
    }
}

fn not_verified(counted: &Verification) -> Error {
    Error::new(
        ErrorKind::NotVerified,
        format!(
            "the result, in the precision and space in which it would be read, has {} intersecting pairs of garment triangles \
             that did not intersect at the start, and {} of garment triangles and those of the avatar or its layers; it is not \
             handed out as good. Set and read the garment in 64 bits, or move the avatar nearer to the origin",
            counted.new_garment_garment(),
            counted.garment_avatar
        ),
    )
}
