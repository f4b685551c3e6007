//! Run that is done in threads of the session's own, so that a caller who asks to stop never waits for a kernel.
//!
//! The caller's thread only waits: for the result, or for a request to stop. In the latter case it leaves at once, and
//! the job, which owns all that it works on, ends in the background at its next checkpoint. Whoever goes on with the
//! session, or ends it, waits for that.

use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel, sync_channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::JoinHandle;
use std::time::Duration;

use crate::control::{Cancel, Cancelled};
use crate::error::{Error, ErrorKind, Result};
use crate::panics::{PanicLog, resume_on_caller, with_panic_log};

/// How often a waiting caller looks for a request to stop.
const POLL: Duration = Duration::from_millis(2);

type Panic = Box<dyn Any + Send>;

/// Threads of one session. Dropping it waits for them, so that none is left when a host unloads the library.
pub(super) struct WorkerPool {
    /// Taken when dropped.
    threads: Option<rayon::ThreadPool>,
    handles: Vec<JoinHandle<()>>,
    /// Jobs that were left to end by themselves: each sends the panic that ended it, or hangs up.
    left: Mutex<Vec<Receiver<Panic>>>,
    panics: Arc<PanicLog>,
}

impl WorkerPool {
    /// A pool of `count` threads, of whose panics `panics` hears.
    ///
    /// # Errors
    /// `Internal` where the system has no more threads.
    pub(super) fn new(count: usize, panics: &Arc<PanicLog>) -> Result<Self> {
        let mut handles = Vec::new();
        let threads = rayon::ThreadPoolBuilder::new()
            .num_threads(count)
            .spawn_handler(|worker| {
                let thread = std::thread::Builder::new().name(format!("bespoke-{}", worker.index()));
                let panics = panics.clone();
                handles.push(thread.spawn(move || with_panic_log(&panics, || worker.run()))?);
                Ok(())
            })
            .build()
            .map_err(|e| Error::new(ErrorKind::Internal, format!("no thread pool: {e}")))?;
        Ok(Self { threads: Some(threads), handles, left: Mutex::default(), panics: panics.clone() })
    }

    /// Does `work` in the pool and returns what it gives. As soon as `should_stop` says so, `stop`, which `work` looks at,
    /// is set and the job is left; what it still gives is dropped where it ran. A panic goes on in the caller.
    ///
    /// # Errors
    /// `Cancelled` where the job was left.
    pub(super) fn run<T: Send + 'static>(
        &self,
        should_stop: impl Fn() -> bool,
        stop: &Cancel,
        work: impl FnOnce() -> T + Send + 'static,
    ) -> Result<T> {
        // Without a buffer: what nobody takes goes back to the job, which may take its time to free it.
        let (give, take) = sync_channel(0);
        let (fail, end) = channel::<Panic>();
        let Some(threads) = &self.threads else {
            return Err(Error::new(ErrorKind::Internal, "the session's threads have ended"));
        };
        threads.spawn(move || {
            let done = catch_unwind(AssertUnwindSafe(move || drop(give.send(work()))));
            if let Err(panic) = done {
                drop(fail.send(panic));
            }
        });
        loop {
            match take.recv_timeout(POLL) {
                Ok(value) => return Ok(value),
                Err(RecvTimeoutError::Timeout) if should_stop() => {
                    stop.request();
                    self.left.lock().unwrap_or_else(PoisonError::into_inner).push(end);
                    return Err(Cancelled.into());
                }
                Err(RecvTimeoutError::Timeout) => {}
                Err(RecvTimeoutError::Disconnected) => match end.recv() {
                    Ok(panic) => resume_on_caller(&self.panics, panic),
                    Err(_) => {
                        return Err(Error::new(ErrorKind::Internal, "a job of the session ended without a result"));
                    }
                },
            }
        }
    }

    /// Waits for the jobs that were left. The panic that ended one goes on in the caller.
    pub(super) fn drain(&self) {
        let left = std::mem::take(&mut *self.left.lock().unwrap_or_else(PoisonError::into_inner));
        for job in left {
            if let Ok(panic) = job.recv() {
                resume_on_caller(&self.panics, panic);
            }
        }
    }
}

impl Drop for WorkerPool {
    fn drop(&mut self) {
        // The threads end once all that was given to them is done.
        drop(self.threads.take());
        for handle in self.handles.drain(..) {
            // Panics were handled in the jobs.
            drop(handle.join());
        }
    }
}
