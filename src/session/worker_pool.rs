//! The session's own threads, in which all jobs run, so that a caller who cancels never waits for a kernel.
//!
//! The caller's thread only waits: for the result, or for a request to stop. In the latter case it abandons the job and
//! returns at once; the job, which owns all that it works on, ends in the background at its next checkpoint. A reset or
//! drop of the session waits for that.

use std::any::Any;
use std::io;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel, sync_channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::JoinHandle;
use std::time::Duration;

use crate::control::{Cancel, Cancelled};
use crate::error::{Error, ErrorKind, Result};
use crate::panics::{PanicLog, resume_on_caller, with_panic_log};

/// How often a waiting caller checks for a request to stop.
const POLL: Duration = Duration::from_millis(2);

type Panic = Box<dyn Any + Send>;

/// Threads of one session. Dropping it joins them, so that none is running when a host unloads the library.
pub(super) struct WorkerPool {
    /// Taken when dropped.
    threads: Option<rayon::ThreadPool>,
    handles: Vec<JoinHandle<()>>,
    /// Abandoned jobs, which end by themselves: each sends the panic that ended it, or disconnects.
    abandoned: Mutex<Vec<Receiver<Panic>>>,
    panics: Arc<PanicLog>,
}

impl WorkerPool {
    /// A pool of `count` threads, whose panic messages `panics` collects; of fewer where the system has no more.
    ///
    /// # Errors
    /// `NoThread` where not even one can be started.
    pub(super) fn new(count: usize, panics: &Arc<PanicLog>) -> Result<Self> {
        // Before there is a pool, whose size is fixed. Each thread waits for its part in it, and ends where none comes.
        let (mut handles, mut parts, mut refused) = (Vec::new(), Vec::new(), None);
        for index in 0..count.max(1) {
            let (part, received) = sync_channel::<rayon::ThreadBuilder>(1);
            let panics = panics.clone();
            let work = move || {
                if let Ok(worker) = received.recv() {
                    with_panic_log(&panics, || worker.run());
                }
            };
            match std::thread::Builder::new().name(format!("bespoke-{index}")).spawn(work) {
                Ok(handle) => handles.push(handle),
                Err(reason) => {
                    refused = Some(reason);
                    break;
                }
            }
            parts.push(part);
        }
        if let (true, Some(reason)) = (handles.is_empty(), refused) {
            return Err(Error::new(
                ErrorKind::NoThread,
                format!(
                    "threads: the session could not start a thread ({reason}): end other threads of the process, or raise \
                     the limit on threads or memory of the process, its user or its container, and call prepare again"
                ),
            ));
        }
        // The parts come in order.
        let mut parts = parts.into_iter();
        let mut pool = Self { threads: None, handles, abandoned: Mutex::default(), panics: panics.clone() };
        let threads = rayon::ThreadPoolBuilder::new()
            .num_threads(pool.handles.len())
            .spawn_handler(|worker| {
                let part = parts.next().ok_or_else(|| io::Error::other("more threads than were asked for"))?;
                part.send(worker).map_err(|_| io::Error::other("a thread has ended too early"))
            })
            .build()
            .map_err(|e| Error::new(ErrorKind::Internal, format!("no thread pool: {e}")));
        // What was not handed out is dropped, so that no thread waits for it.
        drop(parts);
        pool.threads = Some(threads?);
        Ok(pool)
    }

    /// How many threads it has.
    pub(super) fn size(&self) -> usize {
        self.handles.len()
    }

    /// Runs `job` in the pool and returns its result. As soon as `should_stop` is true, `stop`, which the job checks, is set
    /// and the job is abandoned; its result is then dropped where it ran. A panic resumes in the caller.
    ///
    /// # Errors
    /// `Cancelled` where the job was abandoned.
    pub(super) fn run<T: Send + 'static>(
        &self,
        should_stop: impl Fn() -> bool,
        stop: &Cancel,
        job: impl FnOnce() -> T + Send + 'static,
    ) -> Result<T> {
        // Without a buffer: a result that nobody receives is dropped in the job's thread, however long that takes.
        let (sender, receiver) = sync_channel(0);
        let (panic_sender, panic_receiver) = channel::<Panic>();
        let Some(threads) = &self.threads else {
            return Err(Error::new(ErrorKind::Internal, "the session's threads have ended"));
        };
        threads.spawn(move || {
            let done = catch_unwind(AssertUnwindSafe(move || drop(sender.send(job()))));
            if let Err(panic) = done {
                drop(panic_sender.send(panic));
            }
        });
        loop {
            match receiver.recv_timeout(POLL) {
                Ok(value) => return Ok(value),
                Err(RecvTimeoutError::Timeout) if should_stop() => {
                    stop.request();
                    self.abandoned.lock().unwrap_or_else(PoisonError::into_inner).push(panic_receiver);
                    return Err(Cancelled.into());
                }
                Err(RecvTimeoutError::Timeout) => {}
                Err(RecvTimeoutError::Disconnected) => match panic_receiver.recv() {
                    Ok(panic) => resume_on_caller(&self.panics, panic),
                    Err(_) => {
                        return Err(Error::new(ErrorKind::Internal, "a job of the session ended without a result"));
                    }
                },
            }
        }
    }

    /// Waits for the abandoned jobs. The panic that ended one resumes in the caller.
    pub(super) fn drain(&self) {
        let abandoned = std::mem::take(&mut *self.abandoned.lock().unwrap_or_else(PoisonError::into_inner));
        for panic_receiver in abandoned {
            if let Ok(panic) = panic_receiver.recv() {
                resume_on_caller(&self.panics, panic);
            }
        }
    }
}

impl Drop for WorkerPool {
    fn drop(&mut self) {
        // The threads end once all their jobs are done.
        drop(self.threads.take());
        for handle in self.handles.drain(..) {
            // Panics were caught in the jobs.
            drop(handle.join());
        }
    }
}
