//! The distance field of the avatar, built on threads of its own while the avatar grows.
//!
//! A session of one thread has no others: it builds the field when it is wanted. So does one that can start no thread.

use std::panic::resume_unwind;
use std::sync::Arc;
use std::thread::JoinHandle;
use std::time::Instant;

use super::context::Context;
use super::fault::Fault;
use crate::control::Cancel;
use crate::error::{Error, ErrorKind, Result};
use crate::geometry::mesh::TriangleMesh;
use crate::panics::with_panic_log;
use crate::sdf::{Field, FieldOptions};

/// The distance field, built beside the inflation. Dropping it stops a build that is under way, with all else of the job.
pub(super) struct FieldTask {
    /// Taken when it is waited for.
    work: Option<Work>,
    stop: Cancel,
}

/// The field, and the seconds that it took.
type Built = Result<(Arc<Field>, f64)>;

enum Work {
    UnderWay(JoinHandle<Built>),
    Later(Box<dyn FnOnce() -> Built + Send>),
}

impl FieldTask {
    /// Begins to build the field with so many threads, where that is more than one.
    pub(super) fn start(avatar: Arc<TriangleMesh>, voxel: f64, threads: usize, context: &Context) -> Self {
        let (stop, panics, fault) = (context.stop.clone(), context.panics.clone(), context.fault);
        let shared = context.shared.clone();
        let cancel = stop.clone();
        let build = move || {
            Fault::Field.at(fault);
            let clock = Instant::now();
            let field = shared.field(&avatar, FieldOptions { voxel, threads: threads as u32 }, &cancel)?;
            Ok((field, clock.elapsed().as_secs_f64()))
        };
        let later = Box::new(build.clone());
        let started = (threads > 1).then(|| {
            let thread = std::thread::Builder::new().name("bespoke-field".into());
            thread.spawn(move || with_panic_log(&panics, build))
        });
        let work = match started {
            Some(Ok(handle)) => Work::UnderWay(handle),
            Some(Err(_)) | None => Work::Later(later),
        };
        Self { work: Some(work), stop }
    }

    /// Waits for the field, or for a cancel, or builds it; returns it with the seconds that it took. A panic of its thread
    /// resumes in the caller.
    pub(super) fn wait(&mut self) -> Built {
        match self.work.take() {
            Some(Work::UnderWay(handle)) => handle.join().unwrap_or_else(|panic| resume_unwind(panic)),
            Some(Work::Later(build)) => build(),
            None => Err(Error::new(ErrorKind::Internal, "the distance field was taken twice")),
        }
    }
}

impl FieldTask {
    /// Does without the field: a build under way ends by itself, and what else the job does goes on.
    pub(super) fn leave(mut self) {
        if let Some(Work::UnderWay(handle)) = self.work.take() {
            drop(handle.join());
        }
    }
}

impl Drop for FieldTask {
    fn drop(&mut self) {
        if let Some(Work::UnderWay(handle)) = self.work.take() {
            self.stop.request();
            // Neither its result nor its error is needed any more.
            drop(handle.join());
        }
    }
}
