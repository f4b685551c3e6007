//! The gallery: every avatar of the closet in every garment, each pair verified exactly, with its figures.
//!
//!     cargo run --release -p gallery -- [--out DIR] [options]
//!
//! Writes `pairs.md`, `pairs.json` and `sheet.json` with `sheet.bin`, from which `web/render.mjs` makes the pictures and
//! the page. Exits with 0 where all pairs are verified, 1 where one is not, 2 where nothing could be written.

mod arguments;
mod progress;

use std::fs;
use std::io;
use std::process::ExitCode;
use std::time::Instant;

use arguments::Arguments;
use closet::files;
use closet::mesh::Mesh;
use gallery::models::Closet;
use gallery::pair::{self, Outcome};
use gallery::{overview, table};
use glam::Vec3;
use progress::Progress;

fn main() -> ExitCode {
    let arguments = match Arguments::read(std::env::args().skip(1)) {
        Ok(arguments) => arguments,
        Err(message) => {
            eprintln!("{message}\n{}", arguments::USAGE);
            return ExitCode::from(2);
        }
    };
    if arguments.help {
        println!("{}", arguments::USAGE);
        return ExitCode::SUCCESS;
    }
    match run(&arguments) {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(error) => {
            eprintln!("gallery: {}: {error}", arguments.out.display());
            ExitCode::from(2)
        }
    }
}

/// True where all pairs are verified.
fn run(arguments: &Arguments) -> io::Result<bool> {
    fs::create_dir_all(&arguments.out)?;
    let clock = Instant::now();
    let closet = Closet::new(&arguments.garments, &arguments.avatars);
    let mannequin = arguments.source_avatar.then_some(&closet.mannequin);
    let progress = Progress::new(closet.garments.len() * closet.avatars.len());
    let mut outcomes = Vec::new();
    for (garment, worn) in &closet.garments {
        for (avatar, body) in &closet.avatars {
            progress.begin(garment.name(), avatar.name());
            let outcome = pair::dress([garment.name(), avatar.name()], worn, body, mannequin, &arguments.options);
            if arguments.keep && !outcome.positions.is_empty() {
                keep(arguments, &closet, &outcome)?;
            }
            progress.end(&outcome);
            outcomes.push(outcome);
        }
    }
    progress.close();
    let summary = table::Summary::of(&outcomes, clock.elapsed().as_secs_f64());
    let table = table::markdown(&outcomes, &summary);
    fs::write(arguments.out.join("pairs.md"), &table)?;
    fs::write(arguments.out.join("pairs.json"), table::json(&outcomes, &summary)?)?;
    overview::sheet(&closet, &outcomes, &summary).write(&arguments.out.join("sheet.json"))?;
    println!("{table}");
    Ok(summary.verified == summary.pairs)
}

/// Leaves the garment and the body that wears it as OBJ files.
fn keep(arguments: &Arguments, closet: &Closet, outcome: &Outcome) -> io::Result<()> {
    let folder = arguments.out.join("meshes");
    fs::create_dir_all(&folder)?;
    let (worn, body) = closet.samples(outcome);
    let positions = outcome.positions.iter().map(|&p| Vec3::from(p).as_dvec3()).collect();
    let mesh = Mesh { positions, triangles: worn.mesh.triangles.clone() };
    files::write_mesh(&folder.join(format!("{}-{}.obj", outcome.garment, outcome.avatar)), &mesh)?;
    files::write_mesh(&folder.join(format!("{}.obj", outcome.avatar)), &body.mesh)
}
