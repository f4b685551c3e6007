//! A result that is fitted again, with other wishes: the fit goes on from it instead of from nothing.

use std::sync::Arc;
use std::time::Instant;

use glam::DVec3;

use super::Session;
use super::field_task::FieldTask;
use super::inputs::Inputs;
use super::morph_solve::{MorphSolve, Reshaped, shaped};
use super::run::{Run, Step};
use super::snapshot::Snapshot;
use crate::control::Stage;
use crate::error::{Error, ErrorKind, Result};
use crate::input::precision::Precision;
use crate::options::Options;
use crate::report::StageReport;
use crate::solver::newton::State;
use crate::stage::fit::FitStage;
use crate::stage::objective::Objective;
use crate::stage::setup::problem::Problem;

impl Session {
    /// How much of a target morph the avatar is to have where the result is fitted again: 0, as it was set, at first and after `reset`.
    /// Morphs add up.
    ///
    /// # Errors
    /// `InvalidState` where there is no result to go on from, `InvalidArgument` where there is no such morph, or for a weight that is
    /// not finite.
    pub fn set_target_morph_weight(&mut self, index: usize, weight: f64) -> Result<()> {
        if !self.may_adjust() {
            return Err(Error::new(
                ErrorKind::InvalidState,
                "the weight of a target morph was set where there is no result to go on from; run the session to its end first",
            ));
        }
        let count = self.inputs.target_morphs.len();
        if index >= count {
            return Err(Error::new(
                ErrorKind::InvalidArgument,
                format!("target morph {index}: there are {count}; they are added before prepare and count from 0"),
            ));
        }
        if !weight.is_finite() {
            return Err(Error::new(
                ErrorKind::InvalidArgument,
                format!("target morph {index}: the weight is {weight}; it must be finite"),
            ));
        }
        self.inputs.morph_weights.resize(count, 0.0);
        self.inputs.morph_weights[index] = weight;
        Ok(())
    }

    /// Fits the result again with other `options`, and with the pins, fit weights and morph weights that were set since. [`Self::step`] and
    /// [`Self::run`] then go on from it, to another result with the same guarantee. What it is: the minimum near to the result,
    /// the same bits for the same wishes in the same order; for the minimum from the beginning, `reset` and `run`.
    ///
    /// Options that are used before the fit have to stay as they were; carried pieces keep their places.
    ///
    /// # Errors
    /// `InflationStalled` where the garment does not let the avatar take the shape that its morph weights ask for, `InvalidState` before a result is there, and where that is not in the avatar's own pose; `InvalidArgument` for an option
    /// that is out of its range or has to stay, and for a pin of a vertex that the garment does not have; `InvalidWeights`. The result then stays. `Cancelled`, `MemoryLimit`.
    pub fn refit(&mut self, options: Options) -> Result<()> {
        self.refusal_to_refit(&options)?;
        let inputs = Inputs { options, ..self.inputs.clone() };
        inputs.check_wishes()?;
        let (Some(mut run), Some(pool)) = (self.run.take(), &self.pool) else {
            return Err(Error::new(ErrorKind::Internal, "there is no run in a session with a result"));
        };
        let stop = run.context.stop.clone();
        let asked = inputs.clone();
        let control = &self.control;
        let job = move || {
            let outcome = run.refit(&asked);
            (run, outcome)
        };
        let outcome = pool.run(|| control.is_cancelled(), &stop, job).and_then(|(run, outcome)| {
            self.run = Some(run);
            outcome
        });
        if let Err(error) = outcome {
            // The garment does not let the avatar take the shape that is asked for.
            if matches!(error.kind, ErrorKind::InflationStalled | ErrorKind::InvalidArgument) {
                return Err(error);
            }
            self.enter(if error.kind == ErrorKind::Cancelled { Stage::Cancelled } else { Stage::Failed });
            return Err(self.answer(error));
        }
        self.inputs = inputs;
        self.forget_result();
        if let (Some(run), Some(snapshot)) = (&self.run, &mut self.snapshot) {
            self.report = run.report.clone();
            snapshot.update(run);
        }
        self.enter(Stage::Fit);
        Ok(())
    }

    fn refusal_to_refit(&self, options: &Options) -> Result<()> {
        let fail = |kind, message: String| Err(Error::new(kind, message));
        if !self.may_adjust() {
            return fail(
                ErrorKind::InvalidState,
                "refit was called where there is no result to go on from; run the session to its end first".into(),
            );
        }
        if self.pose.is_some() {
            return fail(
                ErrorKind::InvalidState,
                "the result is in the pose of the design and not in the avatar's own, so it cannot be fitted again; call \
                 reset, which keeps the inputs, and set other options before prepare"
                    .into(),
            );
        }
        options.check()?;
        match self.inputs.options.set_before_the_fit(options) {
            None => Ok(()),
            Some(name) => fail(
                ErrorKind::InvalidArgument,
                format!(
                    "option {name} differs from the one that the result was made with, and is used before the fit; leave it \
                     as it was, or call reset and begin again"
                ),
            ),
        }
    }
}

impl Run {
    /// Takes the avatar to the shape that `inputs` ask for, and the garment along, which never passes through it. False where it has
    /// that shape.
    ///
    /// # Errors
    /// `InflationStalled` where the garment does not let it, and `InvalidArgument` for a shape that is far larger than the avatar; nothing
    /// has changed then. Others of the solver.
    fn take_shape(&mut self, inputs: &Inputs) -> Result<bool> {
        let mut shape = inputs.morph_weights.clone();
        if shape.iter().all(|&weight| weight == 0.0) {
            shape.clear();
        }
        if shape == self.shape {
            return Ok(false);
        }
        let own = self.own_shape.clone().unwrap_or_else(|| self.body.clone());
        let mut offsets = vec![DVec3::ZERO; own.avatar_size()[0]];
        for (morph, &weight) in inputs.target_morphs.iter().zip(&shape) {
            offsets.iter_mut().zip(&morph.offsets).for_each(|(sum, &offset)| *sum += weight * offset);
        }
        // Back to the own shape is to the bit.
        let body = if shape.is_empty() { own.clone() } else { Arc::new(shaped(&own, &offsets, 1.0)) };
        let contact = &self.objective.contact;
        let solve = MorphSolve {
            snapshot: Snapshot::of(self),
            options: self.options.clone(),
            distances: contact.distances(),
            exempt: contact.exempt_pairs().triangle_pairs().to_vec(),
            precision: inputs.garment.as_ref().map_or(Precision::F32, |garment| garment.1),
            threads: self.report.threads,
            held: self.report.memory,
            cancel: self.context.stop.clone(),
            shared: self.context.shared.clone(),
            progress: Arc::default(),
        };
        let too_far = |error: Error| match error.kind {
            ErrorKind::InvalidArgument => {
                Error { message: format!("target morph weights: {}", error.message), ..error }
            }
            _ => error,
        };
        let Reshaped { avatar, fitted } = solve.reshaped(&body).map_err(too_far)?;
        let voxel = self.options.voxel_size;
        let field = FieldTask::start(fitted.clone(), voxel, self.report.threads, &self.context);
        let (state, objective) = match solve.carry(&avatar) {
            Ok(Ok(arrived)) => arrived,
            Ok(Err(share)) => {
                field.leave();
                return Err(Error::new(
                    ErrorKind::InflationStalled,
                    format!(
                        "the garment lets the avatar come to {:.0} % of the way to the shape that its morph weights ask for, and no \
                         farther; the result stays as it was. Ask for less, or call reset and dress that shape from the beginning",
                        100.0 * share
                    ),
                ));
            }
            Err(error) => {
                field.leave();
                return Err(too_far(error));
            }
        };
        self.problem = Arc::new(Problem { avatar: Arc::new(avatar), fitted, ..Problem::clone(&self.problem) });
        self.own_shape = Some(own);
        (self.body, self.shape) = (body, shape);
        self.state = State { x: state.x, t: 1.0 };
        self.objective = objective;
        self.newton.forget_values();
        (self.field, self.distance) = (field, None);
        Ok(true)
    }

    /// Sets up the fit with what `inputs` ask for now, from the present state. Where the avatar takes another shape for it, the fit
    /// itself is set up by [`Self::begin_refit`]: the garment is on the body, and can be seen there, before the distance is known
    /// that it is fitted by.
    fn refit(&mut self, inputs: &Inputs) -> Result<()> {
        let clock = Instant::now();
        self.context.stop.check()?;
        let mut problem = (*self.problem).clone();
        let system = self.target_coordinate_system;
        let weld = problem.weld.clone();
        let weights = inputs.fit_weights.as_ref().map(|weights| weld.gather(weights));
        let offset = system.metres_per_unit * inputs.options.offset;
        problem.ask(&inputs.options, offset, weights.as_deref(), &inputs.welded_pins(&weld, &system)?)?;
        let is_reshaped = self.take_shape(inputs)?;
        (problem.avatar, problem.fitted) = (self.problem.avatar.clone(), self.problem.fitted.clone());
        self.options = Options {
            // As the inflation left it: the fit begins with it where it has to begin anew.
            inflation_barrier_weight: self.options.inflation_barrier_weight,
            ..inputs.options.clone()
        };
        self.problem = Arc::new(problem);
        self.report.fit = StageReport::default();
        if is_reshaped {
            self.step = Step::Between;
            self.report.fit.collect(&mut self.newton, &mut self.objective, clock);
        } else {
            self.fit_again(FitStage::resume, clock)?;
        }
        (self.report.converged, self.report.stuck) = (false, false);
        self.report.verification = None;
        self.report.verify_seconds = 0.0;
        self.update_report();
        Ok(())
    }

    /// Begins the fit of a refit on the shape that the avatar has taken.
    ///
    /// # Errors
    /// As [`Self::iterate`].
    pub(super) fn begin_refit(&mut self) -> Result<()> {
        self.fit_again(FitStage::begin, Instant::now())
    }

    fn fit_again(&mut self, begin: fn(&mut Objective, &State, &Options) -> FitStage, clock: Instant) -> Result<()> {
        let field = self.wait_for_field()?;
        let mut objective = self.problem.fit_objective(field, &self.fit_began_at, &self.options, &self.context.stop)?;
        if !self.shape.is_empty() {
            // Their places are those on the avatar's own shape.
            objective.release_carried();
        }
        objective.contact.inherit_distances(&self.objective.contact);
        self.take_up(objective)?;
        self.step = Step::Fit(begin(&mut self.objective, &self.state, &self.options));
        self.report.fit.collect(&mut self.newton, &mut self.objective, clock);
        Ok(())
    }
}
