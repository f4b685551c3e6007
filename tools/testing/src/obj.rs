//! Reads the OBJ files of the real meshes: vertices, faces (polygons fanned), lines.
//!
//! With `wavefront_obj`, for the order of the vertices has to stay: lists of vertices refer to it. `tobj` 4.0.5 numbers
//! them anew by their first use and an object at a time (1 of 3112 vertices of a real garment keeps its number), whatever
//! its options; `obj` and `obj-rs` hold 32-bit numbers, with which the pinned results would be others.

use std::path::{Path, PathBuf};

use bespoke::geometry::mesh::TriangleMesh;
use bespoke::input::skeleton::Skeleton;
use bespoke::input::skin::SkinWeights;
use glam::DVec3;
use wavefront_obj::obj::{Primitive, VTNIndex, parse};

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
    let file = parse(text).unwrap_or_else(|e| panic!("{}:{}: {}", path.display(), e.line_number, e.message));
    let (mut vertices, mut faces, mut lines) = (Vec::new(), Vec::new(), Vec::new());
    for object in &file.objects {
        // The indices of an object count from its own first vertex.
        let first = vertices.len();
        let index = |(v, _, _): VTNIndex| u32::try_from(first + v).expect("32 bits are enough for a vertex");
        vertices.extend(object.vertices.iter().map(|v| DVec3::new(v.x, v.y, v.z)));
        for shape in object.geometry.iter().flat_map(|part| &part.shapes) {
            match shape.primitive {
                // The reader puts the last corner first.
                Primitive::Triangle(c, a, b) => faces.push([a, b, c].map(index)),
                Primitive::Line(a, b) => lines.push([a, b].map(index)),
                Primitive::Point(_) => {}
            }
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

/// The skin weights of a file, which has a row for each of `joints` and a column for each of `vertices`; none where there is no
/// such file.
pub fn read_skin(path: &Path, joints: usize, vertices: usize) -> Option<SkinWeights> {
    let text = std::fs::read_to_string(path).ok()?;
    let number = |word: &str| word.parse().unwrap_or_else(|e| panic!("{}: {word}: {e}", path.display()));
    let weights: Vec<f64> = text.split_whitespace().map(number).collect();
    let skin = SkinWeights::from_dense(&weights, joints, vertices, "skin weights");
    Some(skin.unwrap_or_else(|e| panic!("{}: {}", path.display(), e.message)))
}
