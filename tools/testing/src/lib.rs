//! What the tests and the programs that measure the library share: random numbers and random scenes, OBJ files and rigged
//! characters, also as engines have them, callers of the C API, programs to run and what they are told, the library as others link it, the sample of
//! bindings.

pub mod caller;
pub mod character;
pub mod engine;
pub mod fuzz;
pub mod glb;
pub mod library;
pub mod obj;
pub mod obj_text;
pub mod pairs;
pub mod pierced_hat;
pub mod posing;
pub mod process;
mod random;
pub mod retarget;
pub mod sample;
pub mod scene;

pub use random::Random;
