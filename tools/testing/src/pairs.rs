//! The real pairs, where there are real meshes.

use std::fs;
use std::path::{Path, PathBuf};

use crate::obj;

/// A garment and an avatar.
pub struct Pair {
    /// The names of both.
    pub name: String,
    /// What the program `retarget` is told: every file of them.
    pub words: Vec<String>,
}

/// Every garment on every avatar; none, which is said, where there are no real meshes.
pub fn real() -> Vec<Pair> {
    let Some(assets) = obj::assets() else { return Vec::new() };
    let [garments, avatars] = ["garments", "avatars"].map(|kind| folders(&assets.join(kind)));
    garments.iter().flat_map(|garment| avatars.iter().map(move |avatar| pair(garment, avatar))).collect()
}

fn folders(place: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(place).into_iter().flatten();
    let mut found: Vec<PathBuf> = entries.map(|entry| entry.expect("an entry").path()).collect();
    found.retain(|folder| folder.is_dir());
    found.sort();
    found
}

fn pair(garment: &Path, avatar: &Path) -> Pair {
    let files = [
        ("--garment", garment.join("garment.obj")),
        ("--source-skeleton", garment.join("skeleton.obj")),
        ("--avatar", avatar.join("avatar.obj")),
        ("--target-skeleton", avatar.join("skeleton.obj")),
        ("--skin-weights", avatar.join("skin.txt")),
        ("--no-fit", garment.join("no-fit.txt")),
    ];
    let there = files.into_iter().filter(|(_, file)| file.is_file());
    let [a, b] = [garment, avatar].map(|folder| folder.file_name().unwrap_or_default().display());
    Pair {
        name: format!("{a} on {b}"),
        words: there.flat_map(|(option, file)| [option.to_owned(), file.display().to_string()]).collect(),
    }
}
