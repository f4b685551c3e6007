//! What every job of a session is given.

use std::sync::Arc;

use super::fault::Fault;
use super::shared::Shared;
use crate::control::Cancel;
use crate::panics::PanicLog;

/// What every job of a session is given.
#[derive(Clone, Default)]
pub(super) struct Context {
    /// Cancels it.
    pub(super) stop: Cancel,
    /// Collects its panic messages.
    pub(super) panics: Arc<PanicLog>,
    /// Where it is to panic, in tests.
    pub(super) fault: Option<Fault>,
    /// What is known from other sessions.
    pub(super) shared: Shared,
}
