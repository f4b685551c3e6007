//! Moments of animations: characters in files as they move, a row for each animation.
//!
//!     cargo run --release -p gallery --bin moments -- FILE ANIMATION [FILE ANIMATION ...] [--count N] [--out DIR]
//!
//! The files are such as `bespoke dress` writes. Vertices are moved by the files' own skin weights, and nothing is solved. Writes
//! `moments.json` with `moments.bin` for `web/render.mjs`: evenly spaced moments across, each as long after the one before. With `-`
//! in place of an animation a row shows the pose in which the nodes rest, from as many sides.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use bespoke_cli::failure::{Failure, Result};
use bespoke_cli::figure::{Choice, Figure};
use bespoke_cli::moments::Meshes;
use bespoke_cli::parts::{Kind, Role as FileRole};
use bespoke_gltf::Pose;
use gallery::look;
use gallery::sheet::{Cell, Heading, Layer, Role, Sheet, View};
use glam::DVec3;

/// The colours of garments, one after the other.
const GARMENTS: [&str; 5] = ["#2f6d73", "#8c4a3c", "#4b5a8c", "#7a6b2f", "#6d3f66"];
/// Of hair.
const HAIR: &str = "#6b5b4d";
/// The character in a picture, in metres.
const HEIGHT: f64 = 1.8;

fn main() -> ExitCode {
    let (mut words, mut out, mut count) = (Vec::new(), PathBuf::from("build/moments"), 6);
    let mut all = std::env::args().skip(1);
    while let Some(word) = all.next() {
        match word.as_str() {
            "--out" => out = all.next().map_or(out, PathBuf::from),
            "--count" => count = all.next().and_then(|number| number.parse().ok()).unwrap_or(count),
            _ => words.push(word),
        }
    }
    let pairs = words.as_chunks::<2>();
    if pairs.0.is_empty() || !pairs.1.is_empty() || count == 0 {
        eprintln!("usage: moments FILE ANIMATION [FILE ANIMATION ...] [--count N] [--out DIR]");
        return ExitCode::from(2);
    }
    let mut sheet = Sheet::new("Moments", "Dressed characters, moved by their skin weights.", View::default());
    sheet.view = View { azimuth: 25.0, elevation: 5.0, ..View::default() };
    sheet.evenness = 1.0;
    let drawn = pairs.0.iter().try_for_each(|[file, animation]| row(&mut sheet, Path::new(file), animation, count));
    let written = drawn.and_then(|()| {
        std::fs::create_dir_all(&out)
            .and_then(|()| sheet.write(&out.join("moments.json")))
            .map_err(|error| Failure::no_result(format!("{}: {error}", out.display())))
    });
    match written {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            eprintln!("moments: {}", failure.sentence);
            ExitCode::from(2)
        }
    }
}

fn row(sheet: &mut Sheet, file: &Path, name: &str, count: usize) -> Result<()> {
    let figure = Figure::open(file, FileRole::Outfit, &Choice::default())?;
    let fail = |e: bespoke_gltf::Error| Failure::no_result(e.in_file(file.display().to_string()).to_string());
    let animations = figure.document.animations().map_err(fail)?;
    let missing = || Failure::no_result(format!("{}: it has no animation '{name}'", file.display()));
    let found = animations.iter().find(|animation| animation.name == name);
    let moving = found.and_then(|animation| Some((animation, animation.span()?)));
    if moving.is_none() && name != "-" {
        return Err(missing());
    }
    let meshes = Meshes::of(&figure)?;
    let row = sheet.rows.len();
    let stem = file.file_stem().unwrap_or_default().to_string_lossy().replace(['-', '_'], " ");
    let note = if moving.is_some() { name.replace('_', " ") } else { String::new() };
    sheet.rows.push(Heading { label: stem, note, ..Heading::default() });
    // As tall as in the bind pose whatever its unit, on the floor of the file.
    let bound = || figure.of(Kind::Body).flat_map(|part| &part.positions).map(|p| p.y);
    let (low, high) = (bound().fold(f64::INFINITY, f64::min), bound().fold(f64::NEG_INFINITY, f64::max));
    let place = Place { scale: HEIGHT / (high - low), low };
    for column in 0..count {
        if sheet.columns.len() <= column {
            sheet.columns.push(Heading::default());
        }
        let share = column as f64 / count as f64;
        let (pose, caption, view) = match moving {
            Some((animation, (first, last))) => {
                let time = first + (last - first) * share;
                (animation.pose(&figure.scene.nodes, time).map_err(fail)?, format!("{time:.2} s"), None)
            }
            None => {
                let view = View { azimuth: 360.0 * share, ..sheet.view };
                (Pose::rest(&figure.scene.nodes), String::new(), Some(view))
            }
        };
        let layers = layers(sheet, &figure, &meshes.in_pose(&figure, &pose)?, place);
        sheet.cells.push(Cell { column, row, caption, layers, view, ..Cell::default() });
    }
    Ok(())
}

/// How a file's space becomes that of a sheet.
#[derive(Clone, Copy)]
struct Place {
    scale: f64,
    /// The height of the floor.
    low: f64,
}

impl Place {
    /// A sheet's z is up, and its front -y.
    fn of(self, p: DVec3) -> DVec3 {
        self.scale * DVec3::new(p.x, -p.z, p.y - self.low)
    }
}

/// All parts with their vertices in `places`, without what is carried.
fn layers(sheet: &mut Sheet, figure: &Figure, places: &[Vec<DVec3>], to_sheet: Place) -> Vec<Layer> {
    let mut garments = Vec::new();
    let mut layers = Vec::new();
    for part in figure.parts.iter().filter(|part| part.sorted.kind != Kind::Prop) {
        let (role, colour) = match part.sorted.kind {
            Kind::Garment => {
                let number = garments.iter().position(|node| *node == part.node).unwrap_or(garments.len());
                if number == garments.len() {
                    garments.push(part.node);
                }
                (Role::Garment, GARMENTS[number % GARMENTS.len()])
            }
            Kind::Hair => (Role::Body, HAIR),
            Kind::Body | Kind::Prop => (Role::Body, look::BODY),
        };
        let positions: Vec<DVec3> =
            part.vertices.iter().map(|&v| to_sheet.of(places[part.instance][v as usize])).collect();
        let mesh = sheet.add_mesh(&look::positions(&positions), &part.triangles);
        layers.push(look::surface(role, mesh, colour));
    }
    layers
}
