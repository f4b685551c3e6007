//! Bespoke in Godot: the class [`retarget::BespokeRetarget`], over the C API of the library.
//!
//! What a script sets (`inputs`) and the meshes and skeletons of a scene become plain arrays (`scene`, `mesh`, `figure`, `painted`), a
//! session works on them in a thread of its own (`session`, `job`, `running`), and its result becomes a mesh with a skin again
//! (`result`), and animations of its blend shapes tracks for it (`tracks`). Classes of the engine that are not compiled in are called
//! by name (`engine`).

#[rustfmt::skip]
mod constants;
mod engine;
mod figure;
mod findings;
mod help;
mod inputs;
mod job;
mod mesh;
#[allow(missing_docs, dead_code)]
#[rustfmt::skip]
mod native;
mod options;
mod painted;
mod result;
mod retarget;
mod running;
mod scene;
mod session;
mod tracks;
mod turned;
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
