//! The three steps of the paper: which energies, which weights, when it is done.

pub mod contact_distances;
pub mod finish;
pub mod fit;
pub mod inflate;
pub mod objective;
pub mod setup;
pub mod start;
