//! What every job of a session brings along.

use std::sync::Arc;

use super::fault::Fault;
use crate::control::Cancel;
use crate::panics::PanicLog;

/// What all work of a session has with it.
#[derive(Clone, Default)]
pub(super) struct Context {
    /// Stops it.
    pub(super) stop: Cancel,
    /// Hears of its panics.
    pub(super) panics: Arc<PanicLog>,
    /// Where it is to panic.
    pub(super) fault: Option<Fault>,
}
