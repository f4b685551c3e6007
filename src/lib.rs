//! Fits a garment that was modelled on one body to another body, with no triangle through another.
//!
//! Follows "Intersection-Free Garment Retargeting" (Huang et al., SIGGRAPH 2025). Data moves one way:
//!
//! ```text
//! caller's buffers -> input -> session -> stage::{start, inflate, fit} -> verify -> caller's buffers
//!                                             |
//!                               energy + contact + sdf, minimised by solver
//! ```
//!
//! The product is the C ABI (`include/bespoke.h`); the Rust modules are public for this repository's tests and tools
//! and may change at any time.

#[cfg(feature = "capi")]
pub mod capi;
pub mod contact;
pub mod control;
pub mod energy;
pub mod error;
pub mod follow;
pub mod geometry;
pub mod input;
pub mod maths;
pub mod memo;
pub mod memory;
pub mod options;
mod panics;
pub mod report;
pub mod rig;
pub mod sdf;
pub mod session;
mod simd;
pub mod solver;
pub mod stage;
pub mod verify;
