//! Writes the sample closet: `cargo run --example closet -- OUTDIR`.
//!
//! `mannequin.obj` and `skeleton.obj`; `jacket/` designed on it; `heavy/` and `creature/`, bodies to dress.

mod files;
mod generator;

use std::fs;
use std::io;
use std::path::Path;
use std::process::ExitCode;
use std::thread;

use generator::{Kind, Sample, sample};

fn main() -> ExitCode {
    let mut arguments = std::env::args_os().skip(1);
    let (Some(folder), None) = (arguments.next(), arguments.next()) else {
        eprintln!("usage: closet OUTDIR");
        return ExitCode::from(2);
    };
    match write_closet(Path::new(&folder)) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("closet: {}: {error}", Path::new(&folder).display());
            ExitCode::FAILURE
        }
    }
}

fn write_closet(folder: &Path) -> io::Result<()> {
    thread::scope(|scope| {
        let kinds = [Kind::Creature, Kind::Heavy, Kind::Mannequin, Kind::Jacket];
        let threads = kinds.map(|kind| scope.spawn(move || write_sample(folder, kind, &sample(kind))));
        threads
            .into_iter()
            .try_for_each(|thread| thread.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic)))
    })
}

fn write_sample(folder: &Path, kind: Kind, sample: &Sample) -> io::Result<()> {
    let own = match kind {
        Kind::Mannequin => folder.to_path_buf(),
        Kind::Heavy => folder.join("heavy"),
        Kind::Creature => folder.join("creature"),
        Kind::Jacket => folder.join("jacket"),
    };
    fs::create_dir_all(&own)?;
    match kind {
        Kind::Jacket => {
            files::write_garment(&own.join("garment.obj"), "jacket", &sample.mesh, &sample.texture)?;
            files::write_indices(&own.join("no-fit.txt"), &sample.no_fit)
        }
        Kind::Mannequin => {
            files::write_mesh(&own.join("mannequin.obj"), &sample.mesh)?;
            files::write_skeleton(&own.join("skeleton.obj"), &sample.skeleton)
        }
        Kind::Heavy | Kind::Creature => {
            files::write_mesh(&own.join("avatar.obj"), &sample.mesh)?;
            files::write_skeleton(&own.join("skeleton.obj"), &sample.skeleton)?;
            files::write_matrix(&own.join("skin.txt"), &sample.skin)
        }
    }
}
