//! The figures of the paper's evaluation, each from the closet, with pictures, numbers and claims that are checked.
//!
//!     cargo run --release -p figures -- [--out DIR] [--pair FOLDER]... [NAME...]
//!
//! A folder holds a real pair of garment and body ([`gallery::folder`]), for the figures that show such beside the closet's.
//! Writes for each figure `NAME.json` with `NAME.bin`, a sheet of pictures for `tools/gallery/web/render.mjs`, and `NAME.md`,
//! its numbers. Exits with 0 where all claims hold, 1 where one does not, 2 where nothing could be written.

use std::fs;
use std::io;
use std::path::PathBuf;
use std::process::ExitCode;
use std::time::Instant;

use figures::figure::{Figure, Outcome};
use figures::{
    clearance, comparison, curve_term, fit_weight, key_poses, layers, poses, resolution, shells, skeleton_edits,
    skin_weights, stress,
};

/// The name of a figure, and what makes it, with folders of real pairs.
type Maker = (&'static str, fn(&[PathBuf]) -> Outcome<Figure>);

/// Those that are made where none is named.
const FIGURES: [Maker; 12] = [
    ("layers", |_| layers::figure()),
    ("stress", |_| stress::figure()),
    ("fit-weight", |_| fit_weight::figure()),
    ("skeleton-edits", |_| skeleton_edits::figure()),
    ("curve-term", |_| curve_term::figure()),
    ("resolution", |_| resolution::figure()),
    ("clearance", |_| clearance::figure()),
    ("shells", |_| shells::figure()),
    ("skin-weights", |_| skin_weights::figure()),
    ("key-poses", key_poses::figure),
    ("poses", |_| poses::figure()),
    ("comparison", |_| comparison::figure()),
];

/// Those that are made by name alone.
const BY_NAME: [Maker; 1] = [("poses-more", |_| poses::figure_of_more())];

const USAGE: &str = "usage: figures [--out DIR] [--pair FOLDER]... [layers] [stress] [fit-weight] [skeleton-edits] [curve-term] [resolution] [clearance] [shells] [skin-weights] [key-poses] [poses] [comparison] [poses-more]";

fn main() -> ExitCode {
    let mut out = PathBuf::from("build/gallery/figures");
    let (mut names, mut folders) = (Vec::new(), Vec::new());
    let mut words = std::env::args().skip(1);
    while let Some(word) = words.next() {
        match (word.as_str(), words.len()) {
            ("--out", 1..) => out = words.next().unwrap_or_default().into(),
            ("--pair", 1..) => folders.extend(words.next().map(PathBuf::from)),
            (name, _) if FIGURES.iter().chain(&BY_NAME).any(|(known, _)| *known == name) => names.push(word),
            _ => {
                eprintln!("figures: there is no figure or option '{word}'\n{USAGE}");
                return ExitCode::from(2);
            }
        }
    }
    let is_named = |(name, _): &&Maker| names.iter().any(|named| named == name);
    let others = BY_NAME.iter().filter(is_named);
    let wanted = FIGURES.iter().filter(|maker| names.is_empty() || is_named(maker)).chain(others);
    let mut failed = 0;
    for (name, make) in wanted {
        let clock = Instant::now();
        let figure = match make(&folders) {
            Ok(figure) => figure,
            Err(message) => {
                eprintln!("{name}: {message}");
                failed += 1;
                continue;
            }
        };
        if let Err(error) = write(&out, name, &figure) {
            eprintln!("figures: {}: {error}", out.display());
            return ExitCode::from(2);
        }
        failed += figure.failed();
        println!("{}\n({name}: {:.1} s)\n", figure.markdown(), clock.elapsed().as_secs_f64());
    }
    if failed == 0 { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

fn write(folder: &std::path::Path, name: &str, figure: &Figure) -> io::Result<()> {
    fs::create_dir_all(folder)?;
    figure.sheet.write(&folder.join(format!("{name}.json")))?;
    fs::write(folder.join(format!("{name}.md")), figure.markdown())
}
