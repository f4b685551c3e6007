//! The program `bespoke`, in pieces: reads characters and outfits from files (`figure`), sorts what they hold (`parts`),
//! dresses each garment with the library (`fit`), and writes the result into the avatar's file (`output`).

pub mod args;
mod attempts;
pub mod batch;
mod bodies;
mod caps;
pub mod check;
pub mod dress;
pub mod failure;
pub mod figure;
mod file_state;
pub mod fit;
pub mod inspect;
pub mod joint_pairs;
mod known_avatar;
mod known_outfits;
pub mod moments;
pub mod obj;
pub mod outfit;
mod output;
mod own_body;
pub mod parts;
mod progress;
mod report;
mod say;

use args::{Command, CommandLine};
use clap::CommandFactory;
use failure::{Failure, Result};

/// Does what the command line says. The exit code.
///
/// # Errors
/// Where there is no result.
pub fn run(line: &CommandLine) -> Result<u8> {
    match &line.command {
        Command::Dress(args) => {
            progress::listen_to_interrupts()?;
            dress::run(args)
        }
        Command::Batch(args) => {
            progress::listen_to_interrupts()?;
            batch::run(args)
        }
        Command::BatchWorker => {
            progress::listen_to_interrupts()?;
            batch::worker::serve(&mut std::io::stdin().lock(), &mut std::io::stdout())
        }
        Command::Inspect(args) => inspect::run(args),
        Command::Check(args) => check::run(args),
        Command::Completions { shell } => {
            clap_complete::generate(*shell, &mut CommandLine::command(), "bespoke", &mut std::io::stdout());
            Ok(0)
        }
        Command::Man => clap_mangen::Man::new(CommandLine::command())
            .render(&mut std::io::stdout())
            .map(|()| 0)
            .map_err(|e| Failure::no_result(format!("the manual page cannot be written: {e}"))),
    }
}
