//! What is asked beside the run: it takes a while, and leaves the session as it is.

use super::Session;
use super::worker_pool::WorkerPool;
use crate::control::{Cancel, Cancelled};
use crate::error::{Error, ErrorKind, Result};

impl Session {
    /// Does `work`, which is beside the run, in the session's threads, or in some of its own before there are any. A request to stop
    /// that no call has answered yet ends it, and the stage stays.
    ///
    /// # Errors
    /// Those of `work`, `Cancelled`, `NoThread`.
    pub(super) fn aside<T: Send + 'static>(
        &self,
        work: impl FnOnce(&Cancel) -> Result<T> + Send + 'static,
    ) -> Result<T> {
        let own = match &self.pool {
            Some(_) => None,
            None => Some(WorkerPool::new(self.wanted_threads(), &self.panics)?),
        };
        let Some(pool) = own.as_ref().or(self.pool.as_ref()) else {
            return Err(Error::new(ErrorKind::Internal, "a session without threads"));
        };
        let (answered, stop) = (self.answered(), Cancel::new());
        let should_stop = || self.control.requests() > answered;
        if should_stop() {
            return Err(self.answer(Cancelled.into()));
        }
        let cancel = stop.clone();
        let done = pool.run(should_stop, &stop, move || work(&cancel)).and_then(|done| done);
        done.map_err(|error| self.answer(error))
    }
}
