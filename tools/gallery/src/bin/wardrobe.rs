//! The wardrobe: real pairs of garment and body, each in a folder of its own, dressed as a caller would with the defaults.
//!
//!     cargo run --release -p gallery --bin wardrobe -- FOLDERS [--out DIR]
//!
//! What a folder holds: [`gallery::folder`]. Writes `wardrobe.md`, a table, and `sheet.json` with `sheet.bin` for
//! `web/render.mjs`: each pair as designed and as dressed, front and back. Exits with 1 where a pair has no result.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::fs;
use std::path::PathBuf;
use std::process::ExitCode;

use bespoke::error::Result;
use bespoke::geometry::mesh::TriangleMesh;
use bespoke::options::Options;
use bespoke::session::{Precision, Session};
use gallery::folder::Pair;
use gallery::look;
use gallery::sheet::{Cell, Heading, Layer, Role, Sheet, View};
use glam::DVec3;

/// The colour of garments.
const GARMENT: &str = "#2f6d73";
/// Of what is in a picture, in metres.
const HEIGHT: f64 = 1.8;

/// What became of it.
struct Outcome {
    /// The garment on the avatar, or why there is none.
    result: std::result::Result<Vec<DVec3>, String>,
    cpu_seconds: f64,
    iterations: [u32; 2],
    /// Pairs of garment triangles that intersected as designed, that do now, and pairs of garment and avatar.
    intersections: [u64; 3],
    /// The kinds of diagnostics and how many of each.
    diagnostics: BTreeMap<String, usize>,
}

fn main() -> ExitCode {
    let (mut folders, mut out) = (Vec::new(), PathBuf::from("build/wardrobe"));
    let mut words = std::env::args().skip(1);
    while let Some(word) = words.next() {
        match word.as_str() {
            "--out" => out = words.next().map_or(out, PathBuf::from),
            folder => folders.push(PathBuf::from(folder)),
        }
    }
    let pairs: Vec<Pair> = folders.iter().filter_map(|folder| Pair::read(folder)).collect();
    if pairs.is_empty() {
        eprintln!("usage: wardrobe FOLDERS [--out DIR]: none of the folders given holds a pair");
        return ExitCode::from(2);
    }
    let outcomes: Vec<Outcome> = pairs.iter().map(dress).collect();
    let table = table(&pairs, &outcomes);
    println!("{table}");
    let written = fs::create_dir_all(&out)
        .and_then(|()| fs::write(out.join("wardrobe.md"), &table))
        .and_then(|()| sheet(&pairs, &outcomes).write(&out.join("sheet.json")));
    if let Err(error) = written {
        eprintln!("wardrobe: {}: {error}", out.display());
        return ExitCode::from(2);
    }
    ExitCode::from(u8::from(outcomes.iter().any(|outcome| outcome.result.is_err())))
}

/// With one thread, so that its processor time is that of the work.
fn dress(pair: &Pair) -> Outcome {
    let mut session = Session::new();
    let before = cpu_seconds();
    let result = inputs(pair, &mut session).and_then(|()| session.run()).and_then(|_| {
        let read = session.garment_as_read(Precision::F32)?;
        Ok(read.into_iter().collect())
    });
    let cpu_seconds = cpu_seconds() - before;
    let report = session.report();
    let verified = report.verification.map_or([0; 2], |v| [v.garment_garment, v.garment_avatar]);
    let mut diagnostics = BTreeMap::new();
    for found in session.diagnostics() {
        *diagnostics.entry(format!("{:?}", found.kind())).or_insert(0) += 1;
    }
    Outcome {
        result: result.map_err(|error| error.message),
        cpu_seconds,
        iterations: [report.inflate.iterations, report.fit.iterations],
        intersections: [report.initial_self_intersections as u64, verified[0], verified[1]],
        diagnostics,
    }
}

fn inputs(pair: &Pair, session: &mut Session) -> Result<()> {
    session.set_options(Options { threads: 1, ..Options::default() })?;
    if let Some(skin) = &pair.skin {
        session.set_target_skin(skin.clone())?;
    }
    session.set_garment(pair.garment.clone(), Precision::F32)?;
    session.set_source_skeleton(pair.source_skeleton.clone())?;
    if let Some(source) = &pair.source_avatar {
        session.set_source_avatar(source.clone())?;
    }
    session.set_target_avatar(pair.avatar.clone())?;
    session.set_target_skeleton(pair.skeleton.clone())
}

/// The processor time of this program.
fn cpu_seconds() -> f64 {
    let mut time = libc::timespec { tv_sec: 0, tv_nsec: 0 };
    // SAFETY: `time` is a timespec that the call may write to, and the clock exists on every system that has this call.
    unsafe { libc::clock_gettime(libc::CLOCK_PROCESS_CPUTIME_ID, &mut time) };
    time.tv_sec as f64 + 1e-9 * time.tv_nsec as f64
}

fn table(pairs: &[Pair], outcomes: &[Outcome]) -> String {
    let dressed = outcomes.iter().filter(|outcome| outcome.result.is_ok()).count();
    let mut text = format!(
        "{dressed} of {} pairs with a result.\n\n\
         | pair | garment vertices | CPU s | iterations (inflate + fit) | self-intersections (designed, now) | with the avatar | \
         found |\n| --- | --- | --- | --- | --- | --- | --- |\n",
        pairs.len()
    );
    for (pair, outcome) in pairs.iter().zip(outcomes) {
        let [designed, now, avatar] = outcome.intersections;
        let found: Vec<String> = outcome.diagnostics.iter().map(|(kind, count)| format!("{kind} {count}")).collect();
        let [inflate, fit] = outcome.iterations;
        let after =
            if outcome.result.is_ok() { [now.to_string(), avatar.to_string()] } else { ["-".into(), "-".into()] };
        let _ = writeln!(
            text,
            "| {} | {} | {:.1} | {inflate} + {fit} | {designed}, {} | {} | {} |",
            pair.name,
            pair.garment.positions.len(),
            outcome.cpu_seconds,
            after[0],
            after[1],
            found.join(", ")
        );
    }
    for (pair, outcome) in pairs.iter().zip(outcomes) {
        if let Err(message) = &outcome.result {
            let _ = writeln!(text, "\n{}: {message}", pair.name);
        }
    }
    text
}

/// A body, where there is one, and a garment, each with its vertices in the picture.
type Scene<'a> = [Option<(&'a TriangleMesh, &'a [DVec3], Role, &'static str)>; 2];

fn sheet(pairs: &[Pair], outcomes: &[Outcome]) -> Sheet {
    let mut sheet = Sheet::new("Wardrobe", "Garments as designed, and as dressed: front and back.", View::default());
    let back = View { azimuth: 180.0, ..View::default() };
    for label in ["Designed", "Designed, back", "Dressed", "Dressed, back"] {
        sheet.rows.push(Heading { label: label.into(), ..Heading::default() });
    }
    for (column, (pair, outcome)) in pairs.iter().zip(outcomes).enumerate() {
        sheet.columns.push(Heading { label: pair.name.clone(), ..Heading::default() });
        let garment = |positions| Some((&pair.garment, positions, Role::Garment, GARMENT));
        let source = pair.source_avatar.as_ref();
        let designed = layers(
            &mut sheet,
            [source.map(|m| (m, &m.positions[..], Role::Body, look::MANNEQUIN)), garment(&pair.garment.positions[..])],
        );
        let body = Some((&pair.avatar, &pair.avatar.positions[..], Role::Body, look::BODY));
        let dressed = layers(&mut sheet, [body, outcome.result.as_ref().ok().and_then(|found| garment(found))]);
        let message = outcome.result.as_ref().err().cloned();
        for (row, layers) in [&designed, &designed, &dressed, &dressed].into_iter().enumerate() {
            let (view, message) = ((row % 2 == 1).then_some(back), message.clone().filter(|_| row >= 2));
            sheet.cells.push(Cell { column, row, layers: layers.clone(), message, view, ..Cell::default() });
        }
    }
    sheet
}

/// What is in a picture, as large as a person whatever its unit, and as a sheet has it: z up.
fn layers(sheet: &mut Sheet, scene: Scene<'_>) -> Vec<Layer> {
    let all = || scene.iter().flatten().flat_map(|(_, positions, ..)| positions.iter().copied());
    let low = all().fold(DVec3::INFINITY, DVec3::min);
    let high = all().fold(DVec3::NEG_INFINITY, DVec3::max);
    let foot = DVec3::new(0.5 * (low.x + high.x), low.y, 0.5 * (low.z + high.z));
    let scale = HEIGHT / (high.y - low.y);
    let layer = |(mesh, positions, role, colour): (&TriangleMesh, &[DVec3], Role, &str)| {
        let placed = positions.iter().map(|p| scale * (*p - foot)).map(|p| DVec3::new(p.x, -p.z, p.y));
        let mesh = sheet.add_mesh(&look::positions(&placed.collect::<Vec<_>>()), &mesh.triangles);
        look::surface(role, mesh, colour)
    };
    scene.into_iter().flatten().map(layer).collect()
}
