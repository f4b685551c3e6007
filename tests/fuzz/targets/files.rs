//! Arbitrary files.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    testing::fuzz::files(bytes);
});
