//! Writes the sample closet: `cargo run -p closet -- OUTDIR`, and with `--all` everything.
//!
//! `mannequin.obj` and `skeleton.obj`; `jacket/` designed on it; `heavy/` and `creature/`, bodies to dress. With `--all`
//! also `mannequin/`, `avatars/` with a folder for each body and `garments/` with a folder for each garment.

use std::ffi::OsString;
use std::fs;
use std::io;
use std::path::Path;
use std::process::ExitCode;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;

use closet::avatars::{Avatar, avatar};
use closet::garments::{Garment, garment};
use closet::{Kind, Sample, files, sample};

/// What can be written.
#[derive(Clone, Copy)]
enum Item {
    /// Of the sample that the demo shows.
    Sample(Kind),
    /// The body on which all garments are designed, with its skin.
    Mannequin,
    Avatar(Avatar),
    Garment(Garment),
}

fn main() -> ExitCode {
    let (all, folders): (Vec<OsString>, Vec<OsString>) = std::env::args_os().skip(1).partition(|word| word == "--all");
    let folder = match folders.as_slice() {
        // `--help` is no folder.
        [folder] if !folder.as_encoded_bytes().starts_with(b"-") => folder,
        _ => {
            eprintln!("usage: closet OUTDIR [--all]");
            return ExitCode::from(2);
        }
    };
    match write_closet(Path::new(folder), !all.is_empty()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("closet: {}: {error}", Path::new(folder).display());
            ExitCode::FAILURE
        }
    }
}

/// Models and writes everything, as many items at a time as there are processors.
fn write_closet(folder: &Path, all: bool) -> io::Result<()> {
    let mut items = [Kind::Creature, Kind::Heavy, Kind::Mannequin, Kind::Jacket].map(Item::Sample).to_vec();
    if all {
        items.push(Item::Mannequin);
        items.extend(Avatar::ALL.map(Item::Avatar));
        items.extend(Garment::ALL.map(Item::Garment));
    }
    let next = AtomicUsize::new(0);
    let work = || {
        while let Some(item) = items.get(next.fetch_add(1, Ordering::Relaxed)) {
            write_item(folder, *item)?;
        }
        Ok(())
    };
    thread::scope(|scope| {
        let count = thread::available_parallelism().map_or(1, usize::from);
        let threads: Vec<_> = (0..count).map(|_| scope.spawn(work)).collect();
        threads
            .into_iter()
            .try_for_each(|thread| thread.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic)))
    })
}

fn write_item(folder: &Path, item: Item) -> io::Result<()> {
    match item {
        Item::Sample(kind) => write_sample(folder, kind, &sample(kind)),
        Item::Mannequin => write_body(&folder.join("mannequin"), &sample(Kind::Mannequin)),
        Item::Avatar(body) => write_body(&folder.join("avatars").join(body.name()), &avatar(body)),
        Item::Garment(cloth) => write_cloth(&folder.join("garments").join(cloth.name()), cloth.name(), &garment(cloth)),
    }
}

fn write_sample(folder: &Path, kind: Kind, sample: &Sample) -> io::Result<()> {
    match kind {
        Kind::Jacket => write_cloth(&folder.join("jacket"), "jacket", sample),
        Kind::Mannequin => {
            fs::create_dir_all(folder)?;
            files::write_mesh(&folder.join("mannequin.obj"), &sample.mesh)?;
            files::write_skeleton(&folder.join("skeleton.obj"), &sample.skeleton)
        }
        Kind::Heavy => write_body(&folder.join("heavy"), sample),
        Kind::Creature => write_body(&folder.join("creature"), sample),
    }
}

fn write_body(folder: &Path, sample: &Sample) -> io::Result<()> {
    fs::create_dir_all(folder)?;
    files::write_mesh(&folder.join("avatar.obj"), &sample.mesh)?;
    files::write_skeleton(&folder.join("skeleton.obj"), &sample.skeleton)?;
    files::write_matrix(&folder.join("skin.txt"), &sample.skin)
}

fn write_cloth(folder: &Path, name: &str, sample: &Sample) -> io::Result<()> {
    fs::create_dir_all(folder)?;
    files::write_garment(&folder.join("garment.obj"), name, &sample.mesh, &sample.texture)?;
    files::write_indices(&folder.join("no-fit.txt"), &sample.no_fit)
}
