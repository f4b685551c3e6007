//! Writes the files that are made from include/bespoke.h; `make bindings` runs it after the header.

use std::process::ExitCode;

use bespoke_bindgen::{Generated, root};

fn main() -> ExitCode {
    match bespoke_bindgen::generate(&root()).and_then(|files| files.iter().try_for_each(Generated::write)) {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("bindgen: {message}");
            ExitCode::FAILURE
        }
    }
}
