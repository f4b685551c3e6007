//! The steps of the method: normalised space, projection, inflation, fit.

#[path = "../support/mod.rs"]
mod support;

mod frame;
mod initialize;
mod layers;
mod pins;
mod region;
mod retreat;
