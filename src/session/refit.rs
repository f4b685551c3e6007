//! A result that is fitted again, with other wishes: the fit goes on from it instead of from nothing.

use std::sync::Arc;
use std::time::Instant;

use super::Session;
use super::inputs::Inputs;
use super::run::{Run, Step};
use crate::control::Stage;
use crate::error::{Error, ErrorKind, Result};
use crate::options::Options;
use crate::report::StageReport;
use crate::stage::fit::FitStage;

impl Session {
    /// Fits the result again with other `options`, and with the pins and fit weights that were set since. [`Self::step`] and
    /// [`Self::run`] then go on from it, to another result with the same guarantee. What it is: the minimum near to the result,
    /// the same bits for the same wishes in the same order; for the minimum from the beginning, `reset` and `run`.
    ///
    /// Options that are used before the fit have to stay as they were; carried pieces keep their places.
    ///
    /// # Errors
    /// `InvalidState` before a result is there, and where that is not in the avatar's own pose; `InvalidArgument` for an option
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
    /// Sets up the fit with what `inputs` ask for now, from the present state.
    fn refit(&mut self, inputs: &Inputs) -> Result<()> {
        let clock = Instant::now();
        let stop = &self.context.stop;
        stop.check()?;
        let mut problem = (*self.problem).clone();
        let system = self.target_coordinate_system;
        let weld = problem.weld.clone();
        let weights = inputs.fit_weights.as_ref().map(|weights| weld.gather(weights));
        let offset = system.metres_per_unit * inputs.options.offset;
        problem.ask(&inputs.options, offset, weights.as_deref(), &inputs.welded_pins(&weld, &system)?)?;
        let Some((field, _)) = self.distance.clone() else {
            return Err(Error::new(ErrorKind::Internal, "a result without a distance field"));
        };
        self.options = Options {
            // As the inflation left it: the fit begins with it where it has to begin anew.
            inflation_barrier_weight: self.options.inflation_barrier_weight,
            ..inputs.options.clone()
        };
        let mut objective = problem.fit_objective(field, &self.fit_began_at, &self.options, stop)?;
        objective.contact.inherit_distances(&self.objective.contact);
        self.problem = Arc::new(problem);
        self.take_up(objective)?;
        self.step = Step::Fit(FitStage::resume(&mut self.objective, &self.state, &self.options));
        self.report.fit = StageReport::default();
        self.report.fit.collect(&mut self.newton, &mut self.objective, clock);
        (self.report.converged, self.report.stuck) = (false, false);
        self.report.verification = None;
        self.report.verify_seconds = 0.0;
        self.update_report();
        Ok(())
    }
}
