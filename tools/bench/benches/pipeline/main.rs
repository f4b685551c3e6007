//! The benchmark: whole retargets, counted in factorisations of the same garment's matrix, for machines are noisy.
//!
//!     cargo bench -p bench --bench pipeline -- [options]
//!
//! Real pairs where there are real meshes (`BESPOKE_ASSETS`, or `../shared/assets`), and always the closet's. Each case
//! is measured in a process of its own. Prints tables; the figures go to `build/bench.json`.

mod arguments;
mod batch;
mod case;
mod child;
mod closet_cases;
mod cpu;
mod growth;
mod measurement;
mod pairs;
mod refit;
mod scaling;
mod sharing;
mod summary;
mod table;
mod unit;

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use arguments::{Arguments, USAGE};
use batch::Batch;
use bespoke::session::Options;
use case::Case;
use child::Setup;
use growth::Growth;
use pairs::Pair;
use refit::Refit;
use scaling::Scaling;
use serde::Serialize;
use sharing::Sharing;
use summary::Goal;

type Failure = Box<dyn std::error::Error>;

/// Iterations of a stage, at most, where a tolerance is given.
const PATIENCE: u32 = 5000;

/// All that was measured.
#[derive(Debug, Serialize)]
struct Figures {
    version: String,
    cores: usize,
    runs: usize,
    threads: u32,
    goals: Vec<Goal>,
    pairs: Vec<Pair>,
    growth: Vec<Growth>,
    scaling: Option<Scaling>,
    refits: Vec<Refit>,
    sharing: Vec<Sharing>,
    batch: Vec<Batch>,
    failed: Vec<String>,
}

fn main() -> ExitCode {
    if std::env::args().any(|word| word == "--help") {
        println!("{USAGE}");
        return ExitCode::SUCCESS;
    }
    // Cargo starts a benchmark in the folder of its package.
    if let Err(error) = std::env::set_current_dir(testing::process::root()) {
        eprintln!("bench: {error}");
        return ExitCode::FAILURE;
    }
    let arguments = match Arguments::read(std::env::args().skip(1)) {
        Ok(arguments) => arguments,
        Err(message) => {
            eprintln!("{message}\n{USAGE}");
            return ExitCode::from(2);
        }
    };
    let outcome = match &arguments.case {
        Some([garment, avatar]) => one(&Case { garment: garment.clone(), avatar: avatar.clone() }, &arguments),
        None => all(&arguments),
    };
    match outcome {
        Ok(failed) if failed.is_empty() => ExitCode::SUCCESS,
        Ok(failed) => {
            failed.iter().for_each(|message| eprintln!("FAILED {message}"));
            ExitCode::FAILURE
        }
        Err(error) => {
            eprintln!("bench: {error}");
            ExitCode::FAILURE
        }
    }
}

/// Measures one case here, for the process that asked for it.
fn one(case: &Case, arguments: &Arguments) -> Result<Vec<String>, Failure> {
    let mut options = Options { threads: arguments.threads, ..Options::default() };
    if let Some(tolerance) = arguments.tolerance {
        (options.tolerance, options.max_iterations) = (tolerance, PATIENCE);
    }
    let measurement = measurement::measure(case, &options, arguments.runs)?;
    println!("{}", serde_json::to_string(&measurement)?);
    Ok(Vec::new())
}

/// All tables that are asked for. Returns what failed.
fn all(arguments: &Arguments) -> Result<Vec<String>, Failure> {
    let folder = std::path::absolute(arguments.out.with_extension("")).map(|out| out.with_extension("files"))?;
    let closet = closet_cases::write(&folder)?;
    let real = testing::obj::assets().map(|assets| Case::pairs(&assets)).unwrap_or_default();
    let setup = Setup { runs: arguments.runs, threads: arguments.threads, tolerance: None };
    let mut failed = Vec::new();

    let mut pairs = Vec::new();
    if arguments.has("pairs") {
        let cases = real.iter().map(|case| (case, true)).chain(closet.iter().map(|case| (case, false)));
        for (case, is_real) in cases.filter(|(case, _)| case.name().contains(&arguments.only)) {
            match Pair::measure(case, is_real, setup, arguments.tight) {
                Ok(pair) => pairs.push(pair),
                Err(message) => failed.push(message),
            }
        }
    }
    let mut growth = Vec::new();
    if arguments.has("growth") {
        let families = densities(&folder, &closet, &real)?;
        for (garment, cases) in families.iter().filter(|(garment, _)| garment.contains(&arguments.only)) {
            growth.push(Growth::measure(garment, cases, setup, &mut failed));
        }
    }
    // The pair that takes longest.
    let widest = real.iter().find(|case| case.name() == "jumpsuit_dense Goblin").or(closet.last());
    let scaling = arguments.has("threads").then_some(widest).flatten();
    let scaling = scaling.map(|case| Scaling::measure(case, setup, &mut failed));

    let mut refits = Vec::new();
    if arguments.has("refit") {
        let cases = if real.is_empty() { &closet } else { &real };
        for case in cases.iter().filter(|case| case.name().contains(&arguments.only)) {
            match Refit::measure(case, arguments.threads, arguments.runs) {
                Ok(measured) => refits.extend(measured),
                Err(error) => failed.push(format!("{}: {error}", case.name())),
            }
        }
    }

    let mut shared = Vec::new();
    if arguments.has("sharing") {
        match Sharing::measure(arguments.runs) {
            Ok(measured) => shared = measured,
            Err(error) => failed.push(error.to_string()),
        }
    }

    let mut batch = Vec::new();
    if arguments.has("batch") {
        match Batch::measure(&folder, &arguments.only) {
            Ok(measured) => batch = measured,
            Err(error) => failed.push(error.to_string()),
        }
    }

    pairs::print(&pairs);
    growth.iter().for_each(Growth::print);
    scaling.iter().for_each(Scaling::print);
    refit::print(&refits);
    sharing::print(&shared);
    batch::print(&batch);
    let goals = summary::goals(&pairs, &growth, scaling.as_ref());
    summary::print(&goals);
    for pair in pairs.iter().filter(|pair| pair.measured.intersections != [0; 2]) {
        failed.push(format!("{}: the result intersects", pair.measured.case));
    }
    write(
        &arguments.out,
        &Figures {
            version: env!("CARGO_PKG_VERSION").into(),
            cores: std::thread::available_parallelism().map_or(1, usize::from),
            runs: arguments.runs,
            threads: arguments.threads,
            goals,
            pairs,
            growth,
            scaling,
            refits,
            sharing: shared,
            batch,
            failed: failed.clone(),
        },
    )?;
    Ok(failed)
}

/// Garments in several densities, each on one body: jackets on the closet's heavy one, and each real garment on the heavy adult.
fn densities(folder: &Path, closet: &[Case], real: &[Case]) -> Result<Vec<(String, Vec<Case>)>, Failure> {
    let on = |avatar: &Path, garments: Vec<PathBuf>| {
        garments.into_iter().map(|garment| Case { garment, avatar: avatar.into() }).collect::<Vec<_>>()
    };
    let avatar = &closet.first().ok_or("the closet is empty")?.avatar;
    let mut families = vec![("jacket".to_string(), on(avatar, closet_cases::write_densities(folder)?))];
    for case in real.iter().filter(|case| case.avatar.ends_with("heavy_adult")) {
        let name = case.garment.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
        families.push((name, on(&case.avatar, closet_cases::write_subdivided(&case.garment, folder)?)));
    }
    Ok(families)
}

fn write(path: &Path, figures: &Figures) -> Result<(), Failure> {
    if let Some(folder) = path.parent() {
        std::fs::create_dir_all(folder)?;
    }
    std::fs::write(path, serde_json::to_string_pretty(figures)? + "\n")?;
    println!("\n{}", path.display());
    Ok(())
}

/// The middle one in order.
fn median(values: &mut [f64]) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}
