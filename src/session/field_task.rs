//! The distance field of the avatar, built on a thread of its own while the avatar grows.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use crate::control::Control;
use crate::error::{Error, ErrorKind, Result};
use crate::input::mesh::TriangleMesh;
use crate::sdf::{Field, FieldOptions};

/// The distance field, built beside the inflation. Dropping it stops the build.
pub(super) struct FieldTask {
    handle: Option<JoinHandle<Result<(Field, f64)>>>,
    stop: Arc<AtomicBool>,
}

impl FieldTask {
    pub(super) fn start(avatar: Arc<TriangleMesh>, voxel: f64, threads: usize) -> Result<Self> {
        let stop = Arc::new(AtomicBool::new(false));
        let flag = stop.clone();
        let build = move || {
            let clock = Instant::now();
            let field = Field::build(&avatar, FieldOptions { voxel, threads: threads as u32 }, &flag)?;
            Ok((field, clock.elapsed().as_secs_f64()))
        };
        let handle = std::thread::Builder::new()
            .name("bespoke-field".into())
            .spawn(build)
            .map_err(|e| Error::new(ErrorKind::Internal, format!("no thread for the distance field: {e}")))?;
        Ok(Self { handle: Some(handle), stop })
    }

    /// Waits for the field, or for a cancel.
    pub(super) fn wait(&mut self, control: &Control) -> Result<(Field, f64)> {
        let Some(handle) = self.handle.take() else {
            return Err(Error::new(ErrorKind::Internal, "the distance field was taken twice"));
        };
        while !handle.is_finished() {
            if control.is_cancelled() {
                self.stop.store(true, Ordering::Relaxed);
                break;
            }
            std::thread::sleep(Duration::from_millis(1));
        }
        handle
            .join()
            .unwrap_or_else(|_| Err(Error::new(ErrorKind::Internal, "the thread of the distance field panicked")))
    }
}

impl Drop for FieldTask {
    fn drop(&mut self) {
        self.stop.store(true, Ordering::Relaxed);
        if let Some(handle) = self.handle.take() {
            // Its result is of no use any more, an error neither.
            drop(handle.join());
        }
    }
}
