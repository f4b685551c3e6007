//! Random garments on random bodies, all the way.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    testing::fuzz::meshes(bytes);
});
