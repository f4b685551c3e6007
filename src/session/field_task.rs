//! The distance field of the avatar, built on a thread of its own while the avatar grows.

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

/// The distance field, built beside the inflation. Dropping it stops the build.
pub(super) struct FieldTask {
    handle: Option<JoinHandle<Result<(Field, f64)>>>,
    stop: Cancel,
}

impl FieldTask {
    /// Begins to build the field.
    pub(super) fn start(avatar: Arc<TriangleMesh>, voxel: f64, threads: usize, context: &Context) -> Result<Self> {
        let (stop, panics, fault) = (context.stop.clone(), context.panics.clone(), context.fault);
        let cancel = stop.clone();
        let build = move || {
            Fault::Field.at(fault);
            let clock = Instant::now();
            let field = Field::build(&avatar, FieldOptions { voxel, threads: threads as u32 }, &cancel)?;
            Ok((field, clock.elapsed().as_secs_f64()))
        };
        let handle = std::thread::Builder::new()
            .name("bespoke-field".into())
            .spawn(move || with_panic_log(&panics, build))
            .map_err(|e| Error::new(ErrorKind::Internal, format!("no thread for the distance field: {e}")))?;
        Ok(Self { handle: Some(handle), stop })
    }

    /// Waits for the field, or for a cancel; returns it with the seconds that it took. A panic of its thread resumes in the
    /// caller.
    pub(super) fn wait(&mut self) -> Result<(Field, f64)> {
        let Some(handle) = self.handle.take() else {
            return Err(Error::new(ErrorKind::Internal, "the distance field was taken twice"));
        };
        handle.join().unwrap_or_else(|panic| resume_unwind(panic))
    }
}

impl Drop for FieldTask {
    fn drop(&mut self) {
        self.stop.request();
        if let Some(handle) = self.handle.take() {
            // Neither its result nor its error is needed any more.
            drop(handle.join());
        }
    }
}
