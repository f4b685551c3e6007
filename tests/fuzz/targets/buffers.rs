//! Arbitrary memory, sizes and structs.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| testing::fuzz::buffers(bytes));
