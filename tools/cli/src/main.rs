//! The program `bespoke`.

use std::process::ExitCode;

use bespoke_cli::args::CommandLine;
use clap::Parser;

fn main() -> ExitCode {
    match bespoke_cli::run(&CommandLine::parse()) {
        Ok(exit) => ExitCode::from(exit),
        Err(failure) => {
            eprintln!("bespoke: {failure}");
            ExitCode::from(failure.exit)
        }
    }
}
