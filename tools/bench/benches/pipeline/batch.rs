//! A batch beside single calls: the program `bespoke` on the closet as GLB files, every outfit on every avatar.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::Instant;

use closet::avatars::Avatar;
use closet::garments::{Garment, garment};
use closet::rigs::{Body, Character, Naming, character, y_up};
use serde::Serialize;
use testing::glb::{Part, glb};

use crate::cpu::children_seconds;
use crate::table;

type Failure = Box<dyn std::error::Error>;

/// All pairs, one way or the other.
#[derive(Clone, Debug, Serialize)]
pub struct Batch {
    what: &'static str,
    pairs: usize,
    /// Wall seconds.
    seconds: f64,
    /// User CPU seconds.
    cpu: f64,
    /// How many ended dressed, dressed but not as designed, and without a result.
    ended: [usize; 3],
}

impl Batch {
    /// Writes the closet's characters whose names have `only` in them to `folder`, and measures single calls, with all cores each,
    /// and one batch of the same pairs.
    pub fn measure(folder: &Path, only: &str) -> Result<Vec<Self>, Failure> {
        let program = program()?;
        let (outfits, avatars) = write(folder, only)?;
        let pairs: Vec<(&str, &str)> =
            outfits.iter().flat_map(|&outfit| avatars.iter().map(move |&avatar| (outfit, avatar))).collect();
        let mut ended = [0; 3];
        let (clock, before) = (Instant::now(), children_seconds()?);
        for (outfit, avatar) in &pairs {
            let status = Command::new(&program)
                .current_dir(folder)
                .args(["dress", "--quiet", &format!("{outfit}.glb"), &format!("{avatar}.glb"), "--keep", "outfit"])
                .args(["-o", &format!("single/{outfit}-on-{avatar}.glb")])
                .stderr(Stdio::null())
                .status()?;
            ended[match status.code() {
                Some(0) => 0,
                Some(3) => 1,
                _ => 2,
            }] += 1;
        }
        let single = Self {
            what: "single calls",
            pairs: pairs.len(),
            seconds: clock.elapsed().as_secs_f64(),
            cpu: children_seconds()? - before,
            ended,
        };
        let manifest = serde_json::json!({
            "outfits": outfits.iter().map(|name| format!("{name}.glb")).collect::<Vec<_>>(),
            "avatars": avatars.iter().map(|name| format!("{name}.glb")).collect::<Vec<_>>(),
            "output": "batch/{outfit}-on-{avatar}.glb",
            "options": { "keep": "outfit" },
        });
        fs::write(folder.join("closet.json"), manifest.to_string())?;
        let (clock, before) = (Instant::now(), children_seconds()?);
        Command::new(&program).current_dir(folder).args(["batch", "--quiet", "closet.json"]).status()?;
        let (seconds, cpu) = (clock.elapsed().as_secs_f64(), children_seconds()? - before);
        for (outfit, avatar) in &pairs {
            let file = |way: &str| fs::read(folder.join(way).join(format!("{outfit}-on-{avatar}.glb"))).ok();
            if file("single") != file("batch") {
                return Err(format!("{outfit} on {avatar}: the batch gives another file than the single call").into());
            }
        }
        Ok(vec![single, Self { what: "one batch", pairs: pairs.len(), seconds, cpu, ended }])
    }
}

/// The program, beside this one.
fn program() -> Result<PathBuf, Failure> {
    let this = std::env::current_exe()?;
    let program = this.ancestors().nth(2).map(|folder| folder.join("bespoke")).filter(|program| program.is_file());
    Ok(program.ok_or("there is no program to measure: cargo build --release -p bespoke-cli")?)
}

/// Writes outfits, each with the mannequin that wears it, and avatars, and returns their names.
fn write(folder: &Path, only: &str) -> Result<(Vec<&'static str>, Vec<&'static str>), Failure> {
    for way in ["single", "batch"] {
        drop(fs::remove_dir_all(folder.join(way)));
        fs::create_dir_all(folder.join(way))?;
    }
    drop(fs::remove_file(folder.join("closet.report.jsonl")));
    let source = character(&Body::Mannequin.model(), Naming::Unreal).placed(y_up());
    let (mut outfits, mut avatars) = (Vec::new(), Vec::new());
    let wanted = |name: &str| only.is_empty() || name.contains(only);
    for outfit in Garment::ALL {
        let mut mesh = garment(outfit).mesh;
        mesh.positions.iter_mut().for_each(|p| *p = y_up().transform_point3(*p));
        write_character(folder, outfit.name(), &source, Some(&source.wears(&mesh)))?;
        outfits.push(outfit.name());
    }
    for avatar in Avatar::ALL.into_iter().filter(|avatar| wanted(avatar.name())) {
        let body = character(&Body::Avatar(avatar).model(), Naming::Mixamo).placed(y_up());
        write_character(folder, avatar.name(), &body, None)?;
        avatars.push(avatar.name());
    }
    Ok((outfits, avatars))
}

fn write_character(folder: &Path, name: &str, body: &Character, worn: Option<&Character>) -> Result<(), Failure> {
    let mut parts = vec![Part { node: "Body", material: "Skin", mesh: body }];
    parts.extend(worn.map(|mesh| Part { node: "Jacket", material: "Wool", mesh }));
    Ok(fs::write(folder.join(format!("{name}.glb")), glb(&parts))?)
}

/// Prints them.
pub fn print(measured: &[Batch]) {
    let row = |m: &Batch| {
        let [dressed, flawed, none] = m.ended;
        let mut row = vec![m.what.to_string(), m.pairs.to_string()];
        row.extend([format!("{:.1}", m.seconds), format!("{:.1}", m.cpu), format!("{dressed} / {flawed} / {none}")]);
        row
    };
    table::print(
        "Batch: wall and user CPU seconds, and pairs dressed / not as designed / without a result",
        1,
        &["closet", "pairs", "seconds", "CPU", "ended"],
        &measured.iter().map(row).collect::<Vec<_>>(),
    );
}
