//! Morphs of the target avatar, such as "heavier", and what the garment answers to each with: a morph of its own.

use std::sync::{Arc, Mutex, PoisonError};

use glam::DVec3;

use super::Session;
use super::inputs::Inputs;
use super::morph_solve::{MorphSolve, Outcome};
use super::morphs::check_size;
use crate::control::{Cancel, Cancelled, Stage};
use crate::error::{Error, ErrorKind, Result};
use crate::input::diagnostic::Diagnostic;
use crate::input::morph::Morph;
use crate::input::precision::Precision;

const TARGET_MORPH: &str = "target morph";

/// What is known of the garment's answer to a morph of the avatar.
#[derive(Clone, Debug, Default)]
pub(super) enum Answer {
    /// Not yet asked for.
    #[default]
    Open,
    /// Offsets of the caller's garment vertices.
    Solved(Vec<DVec3>),
    /// There is none; a diagnostic says why.
    Failed,
}

impl Session {
    /// A morph of the target avatar, in its coordinate system; one more. They are numbered from 0.
    ///
    /// # Errors
    /// `InvalidArgument` for an offset that is not finite, `InvalidState`. The number of offsets is compared with the avatar's
    /// vertices by `prepare`.
    pub fn add_target_morph(&mut self, morph: Morph) -> Result<()> {
        self.setting("a target morph")?;
        morph.check(TARGET_MORPH, self.inputs.target_morphs.len())?;
        self.inputs.target_morphs.push(Arc::new(morph));
        Ok(())
    }

    /// Removes all morphs of the target avatar.
    ///
    /// # Errors
    /// `InvalidState`.
    pub fn clear_target_morphs(&mut self) -> Result<()> {
        self.setting("the target morphs")?;
        self.inputs.target_morphs.clear();
        Ok(())
    }

    /// Finds what the garment answers to each morph of the avatar with: from the result on, the body goes to weight 1 and takes
    /// the garment along, which never passes through it, and is then fitted to it. The result stays as it is. Answers that are
    /// there already are not sought again. Where there is none, a diagnostic says why.
    ///
    /// # Errors
    /// `InvalidState` before the end, and where the result is not in the avatar's own pose; `Cancelled`, after which what was
    /// found is kept and the stage is [`Stage::Done`]; `InvalidArgument` for a morph that is far larger than the body;
    /// `MemoryLimit`, `Internal`.
    pub fn solve_target_morphs(&mut self) -> Result<()> {
        if self.stage != Stage::Done {
            return Err(no_result(TARGET_MORPH));
        }
        if self.pose.is_some() {
            return Err(Error::new(
                ErrorKind::InvalidState,
                "target morphs: the result is not in the avatar's own pose, so its morphs cannot be applied",
            ));
        }
        self.answers.resize_with(self.inputs.target_morphs.len(), Answer::default);
        for index in 0..self.answers.len() {
            if !matches!(self.answers[index], Answer::Open) {
                continue;
            }
            let outcome = self.solve_morph(index);
            self.enter(Stage::Done);
            let name = self.inputs.target_morphs[index].name.clone();
            let title = self.inputs.target_morphs[index].title(TARGET_MORPH, index);
            let outcome = outcome.map_err(|error| match error.kind {
                ErrorKind::Cancelled => self.answer(error),
                kind => Error::new(kind, format!("{title}: {}", error.message)),
            });
            self.answers[index] = match outcome? {
                Outcome::Solved { offsets, between } => {
                    if let Some((pairs, first)) = between {
                        self.diagnostics.push(Diagnostic::MorphIntersects { morph: index, name, pairs, first });
                    }
                    Answer::Solved(offsets)
                }
                Outcome::Stalled { weight } => {
                    self.diagnostics.push(Diagnostic::MorphNotSolved { morph: index, name, weight });
                    Answer::Failed
                }
            };
        }
        Ok(())
    }

    /// The garment's answer to a morph of the avatar: offsets from the result, in the target coordinate system. At weight 1 the
    /// garment with them is verified on the body with its morph, in the garment's precision.
    ///
    /// # Errors
    /// `InvalidState` where [`Self::solve_target_morphs`] was not called, or has found none, `InvalidArgument` where there is no
    /// such morph.
    pub fn target_morph(&self, index: usize) -> Result<Vec<DVec3>> {
        let Some(morph) = self.inputs.target_morphs.get(index) else {
            let count = self.inputs.target_morphs.len();
            return Err(Error::new(
                ErrorKind::InvalidArgument,
                format!("{TARGET_MORPH} {index}: there are {count}; they are added before prepare and count from 0"),
            ));
        };
        let title = morph.title(TARGET_MORPH, index);
        match self.answers.get(index) {
            Some(Answer::Solved(offsets)) if self.stage == Stage::Done => Ok(offsets.clone()),
            Some(Answer::Failed) => Err(Error::new(
                ErrorKind::InvalidState,
                format!("{title}: the garment has no answer to it; the diagnostics say why"),
            )),
            _ if self.stage == Stage::Done => Err(Error::new(
                ErrorKind::InvalidState,
                format!("{title}: it is not solved yet; call solve_target_morphs"),
            )),
            _ => Err(no_result(&title)),
        }
    }

    fn solve_morph(&self, index: usize) -> Result<Outcome> {
        let morph = self.inputs.target_morphs[index].clone();
        self.beside_the_run(move |solve| solve.run(&morph.offsets))
    }

    /// Does `work` from the result on, which stays as it is, in the session's threads and with progress.
    pub(super) fn beside_the_run<T: Send + 'static>(
        &self,
        work: impl FnOnce(MorphSolve) -> Result<T> + Send + 'static,
    ) -> Result<T> {
        let (Some(snapshot), Some(pool), Some(run)) = (&self.snapshot, &self.pool, &self.run) else {
            return Err(Error::new(ErrorKind::Internal, "there is no run in a session that has ended"));
        };
        let (answered, control) = (self.answered(), &self.control);
        if control.requests() > answered {
            return Err(Cancelled.into());
        }
        let progress = Arc::new(Mutex::new(control.progress()));
        let stop = Cancel::new();
        let solve = MorphSolve {
            snapshot: snapshot.clone(),
            options: run.options.clone(),
            distances: run.objective.contact.distances(),
            exempt: run.objective.contact.exempt_pairs().triangle_pairs().to_vec(),
            precision: self.inputs.garment.as_ref().map_or(Precision::F32, |garment| garment.1),
            threads: pool.size(),
            held: self.report.memory,
            cancel: stop.clone(),
            shared: run.context.shared.clone(),
            progress: progress.clone(),
        };
        // This thread alone publishes; the job says what.
        let should_stop = || {
            let now = *progress.lock().unwrap_or_else(PoisonError::into_inner);
            if now != control.progress() {
                control.publish(&now);
            }
            control.requests() > answered
        };
        pool.run(should_stop, &stop, move || work(solve))?
    }
}

impl Inputs {
    /// Compares the morphs with an avatar of so many vertices.
    pub(super) fn check_target_morphs(&self, count: usize) -> Result<()> {
        for (index, morph) in self.target_morphs.iter().enumerate() {
            check_size(morph, TARGET_MORPH, index, "target avatar", count)?;
        }
        Ok(())
    }
}

fn no_result(what: &str) -> Error {
    let message = format!("{what}: there is no result yet; run the session to its end first");
    Error::new(ErrorKind::InvalidState, message)
}
