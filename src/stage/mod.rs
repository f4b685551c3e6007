//! The stages PREPARE, INFLATE and FIT, the three steps of the paper: which energies, which weights, when each is done.

pub mod attempts;
pub mod blockage;
pub mod contact_guard;
pub mod finish;
pub mod fit;
mod fit_start;
pub mod full_size;
pub mod inflate;
mod inflation_start;
pub mod objective;
pub mod plausibility;
pub mod refit_start;
pub mod repose;
pub mod setup;
pub mod start;
