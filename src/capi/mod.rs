//! The only `extern "C"`: guards, handles, views of the caller's memory; no mathematics.
//!
//! `include/bespoke.h` is generated from the files of this folder, in the order of the modules below, and is the
//! manual of the C API: the comments on exported items are written for the readers of that header.
#![allow(clippy::missing_safety_doc, reason = "the header's preface says once what every pointer must be")]

pub mod status;
pub mod version;

pub mod view;

pub mod session;

pub mod inputs;

pub mod coordinate_system;

pub mod rigs;

pub mod fit;

pub mod layers;

pub mod outfit;

pub mod avatar_parts;

pub mod morphs;

pub mod followers;

pub mod shared;

pub mod options;

pub mod running;

pub mod control;

pub mod results;

pub mod normals;

pub mod rig_results;

pub mod key_poses;

pub mod covered;

pub mod diagnostics;

mod float_mode;
mod list;
mod sized;
mod stay;
mod text;
