//! Bespoke in Godot: the class [`retarget::BespokeRetarget`], over the C API of the library.
//!
//! Meshes and skeletons of a scene become plain arrays (`scene`, `mesh`), a session works on them in a thread of its own
//! (`session`, `job`), and its result becomes a mesh with a skin again (`result`). Classes of the engine that are not compiled in
//! are called by name (`engine`).

#[rustfmt::skip]
mod constants;
mod engine;
mod figure;
mod findings;
mod help;
mod job;
mod mesh;
#[allow(missing_docs, dead_code)]
#[rustfmt::skip]
mod native;
mod options;
mod result;
mod retarget;
mod scene;
mod session;
#[allow(missing_docs)]
#[rustfmt::skip]
mod words;

use godot::init::InitStage;
use godot::prelude::*;

struct Bespoke;

// SAFETY: no other entry point is in this library.
#[gdextension]
unsafe impl ExtensionLibrary for Bespoke {
    fn on_stage_init(stage: InitStage) {
        if stage == InitStage::Editor {
            help::register();
        }
    }
}
