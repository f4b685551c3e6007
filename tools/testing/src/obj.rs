//! Reads the OBJ files of the real meshes: vertices, faces (polygons fanned), lines.

use std::path::{Path, PathBuf};

use bespoke::geometry::mesh::TriangleMesh;
use bespoke::input::skeleton::Skeleton;
use glam::DVec3;

use crate::process::root;

/// The folder of real meshes, or `None` (said on standard error) where there is none: `BESPOKE_ASSETS`, or
/// `../shared/assets` beside the checkout.
pub fn assets() -> Option<PathBuf> {
    let beside = || root().join("../shared/assets");
    let folder = std::env::var_os("BESPOKE_ASSETS").map_or_else(beside, PathBuf::from);
    if folder.is_dir() {
        return Some(folder);
    }
    eprintln!("skipped: no real meshes in {} (set BESPOKE_ASSETS)", folder.display());
    None
}

fn read(path: &Path) -> (Vec<DVec3>, Vec<[u32; 3]>, Vec<[u32; 2]>) {
    let text = std::fs::read_to_string(path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    let (mut vertices, mut faces, mut lines) = (Vec::new(), Vec::new(), Vec::new());
    for (number, line) in text.lines().enumerate() {
        let mut words = line.split_whitespace();
        let Some(kind) = words.next() else { continue };
        let bad = |word: &str| -> ! { panic!("{}:{}: cannot read {word:?}", path.display(), number + 1) };
        let index = |word: &str, count: usize| {
            let first = word.split('/').next().unwrap_or(word);
            let i: i64 = first.parse().unwrap_or_else(|_| bad(word));
            u32::try_from(if i > 0 { i - 1 } else { count as i64 + i }).unwrap_or_else(|_| bad(word))
        };
        match kind {
            "v" => {
                let c: Vec<f64> = words.take(3).map(|w| w.parse().unwrap_or_else(|_| bad(w))).collect();
                vertices.push(DVec3::from_slice(&c));
            }
            "f" => {
                let corners: Vec<u32> = words.map(|w| index(w, vertices.len())).collect();
                faces.extend(corners[1..].windows(2).map(|w| [corners[0], w[0], w[1]]));
            }
            "l" => {
                let points: Vec<u32> = words.map(|w| index(w, vertices.len())).collect();
                lines.extend(points.windows(2).map(|w| [w[0], w[1]]));
            }
            _ => {}
        }
    }
    (vertices, faces, lines)
}

/// The vertices and faces of a file.
pub fn read_mesh(path: &Path) -> TriangleMesh {
    let (positions, triangles, _) = read(path);
    TriangleMesh { positions, triangles }
}

/// The vertices and lines of a file as joints and bones.
pub fn read_skeleton(path: &Path) -> Skeleton {
    let (joints, _, bones) = read(path);
    Skeleton { joints, bones }
}
