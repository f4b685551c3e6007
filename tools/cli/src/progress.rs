//! What is seen while a garment is dressed, and Ctrl-C.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

use bespoke::control::{Control, Progress, Stage};
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use crate::failure::{Failure, Result};

/// The session that runs, which Ctrl-C stops.
static RUNNING: Mutex<Option<Arc<Control>>> = Mutex::new(None);
static STOPPED: AtomicBool = AtomicBool::new(false);

/// From here on Ctrl-C stops the session that runs, and those that would follow.
///
/// # Errors
/// Where the system does not allow it.
pub fn listen_to_interrupts() -> Result<()> {
    ctrlc::set_handler(|| {
        STOPPED.store(true, Ordering::Relaxed);
        if let Some(control) = RUNNING.lock().unwrap_or_else(PoisonError::into_inner).as_ref() {
            control.cancel();
        }
    })
    .map_err(|e| Failure::no_result(format!("Ctrl-C cannot be listened to: {e}")))
}

/// Whether Ctrl-C was pressed.
pub fn is_stopped() -> bool {
    STOPPED.load(Ordering::Relaxed)
}

/// Does `work` of the session that `control` belongs to, with a line that shows how far it is.
pub fn watched<T>(name: &str, control: &Arc<Control>, quiet: bool, work: impl FnOnce() -> T) -> T {
    *RUNNING.lock().unwrap_or_else(PoisonError::into_inner) = Some(control.clone());
    if is_stopped() {
        control.cancel();
    }
    let outcome = if quiet {
        work()
    } else {
        let bar = ProgressBar::with_draw_target(Some(1000), ProgressDrawTarget::stderr());
        if let Ok(style) = ProgressStyle::with_template("{prefix} {bar:24} {msg}") {
            bar.set_style(style);
        }
        bar.set_prefix(name.to_string());
        std::thread::scope(|scope| {
            let (done, waits) = channel::<()>();
            let bar = &bar;
            scope.spawn(move || {
                while waits.recv_timeout(Duration::from_millis(100)) == Err(RecvTimeoutError::Timeout) {
                    let progress = control.progress();
                    bar.set_position((1000.0 * share(&progress)) as u64);
                    bar.set_message(stage_name(progress.stage));
                }
            });
            let outcome = work();
            drop(done);
            outcome
        })
    };
    *RUNNING.lock().unwrap_or_else(PoisonError::into_inner) = None;
    outcome
}

/// How far a session is, from 0 to 1, by what the stages of a usual run take. The fit has no end that is known before: it
/// comes nearer to its own with each iteration.
fn share(progress: &Progress) -> f64 {
    match progress.stage {
        Stage::Setup | Stage::Failed | Stage::Cancelled => 0.0,
        Stage::Prepared => 0.1,
        Stage::Inflate => 0.1 + 0.3 * progress.t,
        Stage::Repose => 0.4 + 0.2 * progress.t,
        Stage::Fit => 0.6 + 0.35 * (1.0 - (-f64::from(progress.iteration) / 20.0).exp()),
        Stage::Verify => 0.97,
        Stage::Done => 1.0,
    }
}

fn stage_name(stage: Stage) -> &'static str {
    match stage {
        Stage::Setup | Stage::Prepared => "preparing",
        Stage::Inflate => "growing the body inside",
        Stage::Repose => "taking the body to its pose",
        Stage::Fit => "fitting",
        Stage::Verify => "verifying",
        Stage::Done => "done",
        Stage::Failed => "failed",
        Stage::Cancelled => "stopped",
    }
}
