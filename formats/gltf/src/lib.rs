//! Reads rigged characters and clothes from glTF 2, GLB and VRM files, and appends to such files with everything else kept.
//!
//! Nothing here knows the library that dresses: what comes out are plain arrays. What a file says is never trusted: counts,
//! offsets, trees and numbers are checked before they are used, what is read takes at most a constant times the file's size,
//! and whatever is wrong is an [`Error`] with the place in the file.
//!
//! ```no_run
//! let document = bespoke_gltf::Document::open("character.vrm".as_ref())?;
//! let scene = document.scene()?;
//! for character in &scene.characters {
//!     println!("{} joints, {} meshes", character.joints.len(), character.meshes.len());
//! }
//! # Ok::<(), bespoke_gltf::Error>(())
//! ```

mod animation;
mod bind;
mod buffers;
mod container;
mod document;
mod edit;
mod error;
mod humanoid;
mod import;
mod json;
mod mesh;
mod nodes;
mod output;
mod posed;
mod reader;
mod scene;
mod skin;
mod text;

pub use animation::{Animation, Channel, Interpolation, Pose, Property, Sampler};
pub use buffers::{Resolver, file_name, files_in, nothing_outside};
pub use container::Form;
pub use document::Document;
pub use edit::{Edit, INDICES, VERTICES};
pub use error::{Error, Place, Result};
pub use humanoid::{Humanoid, Vrm};
pub use import::{Change, Deltas, Import};
pub use mesh::{Mesh, Morph, Primitive};
pub use nodes::{Local, Matrix, Node, Nodes};
pub use output::{Output, replace};
pub use posed::Posable;
pub use scene::{Character, Instance, Joint, Scene};
pub use skin::Skin;
