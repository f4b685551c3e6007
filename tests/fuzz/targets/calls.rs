//! Arbitrary sequences of calls.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| testing::fuzz::calls(bytes));
