//! The soak: many random small retargets, each judged, and a table of what became of them.
//!
//!     cargo run --release -p soak -- [--count N] [--first SEED] [--seed SEED]
//!
//! Seeds from `first` on, as many sessions at once as there are cores, one thread each. `--seed` runs one and tells all
//! about it. Fails where anything intersects that did not before, or anything crashes.

mod outcome;
mod table;

use std::process::ExitCode;
use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering};

use outcome::Outcome;
use testing::scene::Recipe;

const USAGE: &str = "usage: soak [--count N] [--first SEED] [--seed SEED]";

fn main() -> ExitCode {
    let (first, count) = match arguments() {
        Ok(range) => range,
        Err(message) => {
            eprintln!("{message}\n{USAGE}");
            return ExitCode::from(2);
        }
    };
    let next = AtomicU64::new(0);
    let outcomes = Mutex::new(Vec::new());
    std::thread::scope(|scope| {
        for _ in 0..std::thread::available_parallelism().map_or(1, usize::from) {
            scope.spawn(|| {
                loop {
                    let k = next.fetch_add(1, Ordering::Relaxed);
                    if k >= count {
                        return;
                    }
                    let outcome = Outcome::of(Recipe::mixed(first.wrapping_add(k)));
                    if count == 1 {
                        println!("{outcome:#?}");
                    }
                    // As it goes, for a soak that somebody watches or stops.
                    eprintln!("{}", outcome.line());
                    outcomes.lock().unwrap_or_else(|e| e.into_inner()).push(outcome);
                }
            });
        }
    });
    let mut outcomes = outcomes.into_inner().unwrap_or_else(|e| e.into_inner());
    outcomes.sort_by_key(|o| o.recipe.seed);
    if table::print(&outcomes) { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

/// The first seed, and how many from there on.
fn arguments() -> Result<(u64, u64), String> {
    let (mut first, mut count) = (1, 300);
    let mut arguments = std::env::args().skip(1);
    while let Some(name) = arguments.next() {
        let value = arguments.next().ok_or_else(|| format!("{name} needs a number"))?;
        let value = value.parse().map_err(|_| format!("{name} {value}: that is no number"))?;
        match name.as_str() {
            "--count" => count = value,
            "--first" => first = value,
            "--seed" => (first, count) = (value, 1),
            _ => return Err(format!("{name} is no option")),
        }
    }
    Ok((first, count))
}
