//! Panics of this library: what they say is kept for the message of the call, and not written to the host's standard
//! error.

use std::any::Any;
use std::cell::RefCell;
use std::panic::{PanicHookInfo, resume_unwind, set_hook, take_hook};
use std::sync::{Arc, Mutex, Once, PoisonError};

/// What the first panic in the threads of one session said, and where.
#[derive(Debug, Default)]
pub struct PanicLog(Mutex<Option<String>>);

thread_local! {
    /// Who hears of a panic of this thread; nobody of ours where it is not inside the library.
    static LOG: RefCell<Option<Arc<PanicLog>>> = const { RefCell::new(None) };
}

impl PanicLog {
    /// What was said, once.
    pub fn take(&self) -> Option<String> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).take()
    }

    fn record(&self, info: &PanicHookInfo<'_>) {
        let place = info.location().map(|l| format!(", at {}:{}", l.file(), l.line())).unwrap_or_default();
        let said = format!("{}{place}", panic_text(info.payload()));
        self.0.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert(said);
    }
}

/// What a panic said.
fn panic_text(payload: &(dyn Any + Send)) -> &str {
    payload
        .downcast_ref::<&str>()
        .copied()
        .or_else(|| payload.downcast_ref::<String>().map(String::as_str))
        .unwrap_or("no further text")
}

/// Does `work`. Until it ends, `log` hears of this thread's panics, and the hook of the process does not.
pub fn with_panic_log<R>(log: &Arc<PanicLog>, work: impl FnOnce() -> R) -> R {
    /// Puts back what was there before, also when a panic passes.
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

/// Goes on in this thread with a panic that ended another one, of which `log` has heard.
pub fn resume_on_caller(log: &PanicLog, panic: Box<dyn Any + Send>) -> ! {
    if LOG.with_borrow(Option::is_none)
        && let Some(said) = log.take()
    {
        // Nobody here would tell what was said.
        panic!("{said}");
    }
    resume_unwind(panic)
}

/// Before the hook that the process has, one that keeps the panics of our threads to ourselves.
fn install_hook() {
    static ONCE: Once = Once::new();
    // A thread that is panicking may not change the hook.
    if ONCE.is_completed() || std::thread::panicking() {
        return;
    }
    ONCE.call_once(|| {
        let others = take_hook();
        set_hook(Box::new(move |info| {
            let log = LOG.try_with(|log| log.try_borrow().ok().and_then(|log| log.clone()));
            match log.ok().flatten() {
                Some(log) => log.record(info),
                None => others(info),
            }
        }));
    });
}
