//! The three steps of the paper: which energies, which weights, when it is done.

pub mod closing;
pub mod enclosure;
pub mod fit;
pub mod frame;
pub mod inflate;
pub mod initialize;
pub mod lattice;
pub mod layers;
pub mod objective;
pub mod pins;
pub mod problem;
pub mod region;
pub mod retreat;
pub mod rounding;
pub mod route;
pub mod section;
pub mod wire;
