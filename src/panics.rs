//! Panics in this library: their messages are collected for the error of the call, instead of being written to the
//! host's standard error.

use std::any::Any;
use std::cell::RefCell;
use std::panic::{PanicHookInfo, resume_unwind, set_hook, take_hook};
use std::sync::{Arc, Mutex, Once, PoisonError};

/// Message and location of the first panic in the threads of one session.
#[derive(Debug, Default)]
pub struct PanicLog(Mutex<Option<String>>);

thread_local! {
    /// Where a panic of this thread is recorded; `None` outside of the library.
    static LOG: RefCell<Option<Arc<PanicLog>>> = const { RefCell::new(None) };
}

impl PanicLog {
    /// Takes the message out.
    pub fn take(&self) -> Option<String> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).take()
    }

    fn record(&self, info: &PanicHookInfo<'_>) {
        let place = info.location().map(|l| format!(", at {}:{}", l.file(), l.line())).unwrap_or_default();
        let message = format!("{}{place}", panic_text(info.payload()));
        self.0.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert(message);
    }
}

/// The message of a panic.
fn panic_text(payload: &(dyn Any + Send)) -> &str {
    payload
        .downcast_ref::<&str>()
        .copied()
        .or_else(|| payload.downcast_ref::<String>().map(String::as_str))
        .unwrap_or("no further text")
}

/// Runs `work`. Until it ends, panics of this thread are recorded in `log` and do not reach the process's panic hook.
pub fn with_panic_log<R>(log: &Arc<PanicLog>, work: impl FnOnce() -> R) -> R {
    /// Restores the previous log, also during unwinding.
    struct Restore(Option<Arc<PanicLog>>);
    impl Drop for Restore {
        fn drop(&mut self) {
            LOG.set(self.0.take());
        }
    }
    install_hook();
    let _restore = Restore(LOG.replace(Some(log.clone())));
    work()
}

/// Resumes in this thread a panic that ended another one and that `log` has recorded.
pub fn resume_on_caller(log: &PanicLog, panic: Box<dyn Any + Send>) -> ! {
    if LOG.with_borrow(Option::is_none)
        && let Some(message) = log.take()
    {
        // No log is active in this thread: a new panic passes the message to the process's hook.
        panic!("{message}");
    }
    resume_unwind(panic)
}

/// Installs, in front of the process's panic hook, one that records the panics of threads with a log.
fn install_hook() {
    static ONCE: Once = Once::new();
    // A thread that is panicking may not change the hook.
    if ONCE.is_completed() || std::thread::panicking() {
        return;
    }
    ONCE.call_once(|| {
        let previous = take_hook();
        set_hook(Box::new(move |info| {
            let log = LOG.try_with(|log| log.try_borrow().ok().and_then(|log| log.clone()));
            match log.ok().flatten() {
                Some(log) => log.record(info),
                None => previous(info),
            }
        }));
    });
}
