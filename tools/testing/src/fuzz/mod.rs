//! Bytes become programs for the C API, and files: what the fuzz targets run, and what `tests/fuzz_corpus` runs without a fuzzer.
//!
//! Each of the functions takes any bytes and panics where the library breaks a promise. They use the library as a C program
//! does; only the judge of the results, and the reader of files, is called as Rust.

mod array;
mod buffers;
mod caller;
mod calls;
mod files;
mod follow;
mod key_poses;
mod meshes;
mod outfit;
mod reported;
mod rigs;
mod shape;
mod source;

/// A program of calls with up to three sessions and three controls, in any order, with good and bad arguments.
pub fn calls(bytes: &[u8]) {
    calls::run(bytes);
}

/// One session with views of any layout over any bits, structs of any size and content, outputs of any layout.
pub fn buffers(bytes: &[u8]) {
    buffers::run(bytes);
}

/// A garment, two skeletons and a body from bytes, and the whole way; what is called done is judged again.
/// True where there was something to judge.
pub fn meshes(bytes: &[u8]) -> bool {
    meshes::run(bytes)
}

/// A glTF, GLB or VRM file that is read, posed, written and read again; as it is, and with true lengths in its header. How often
/// it was whole.
pub fn files(bytes: &[u8]) -> usize {
    files::run(bytes)
}

pub use files::whole as file;
