//! The Unreal plugin as far as it goes without Unreal: the script for the editor's Python runs over a module that stands for the
//! editor's, the engine-free core is compiled as the engine compiles and gives the bits of Rust, and the rest compiles against stubs of
//! the types that it uses (tests/unreal/stubs).

mod plugin;
mod script;
mod sources;
