//! The steps of the method: normalised space, projection, inflation, fit.

mod blockage;
mod frame;
mod initialize;
mod layers;
mod pins;
mod region;
mod retreat;
