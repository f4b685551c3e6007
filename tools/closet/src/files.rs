//! The samples as files: OBJ meshes and skeletons, text matrices, rigs and influences.

use std::fmt::Write as _;
use std::fs;
use std::io;
use std::path::Path;

use glam::{DAffine3, DMat4};

use crate::mesh::Mesh;
use crate::skeleton::{BONES, Skeleton};
use crate::texture::Texture;

/// Coordinates are written to the nearest hundredth of a millimetre or finer.
fn vertices(mesh: &Mesh) -> String {
    let mut text = String::new();
    for p in &mesh.positions {
        let _ = writeln!(text, "v {:.7} {:.7} {:.7}", p.x, p.y, p.z);
    }
    text
}

/// Writes a body.
pub fn write_mesh(path: &Path, mesh: &Mesh) -> io::Result<()> {
    let mut text = vertices(mesh);
    for triangle in &mesh.triangles {
        let [a, b, c] = triangle.map(|v| v + 1);
        let _ = writeln!(text, "f {a} {b} {c}");
    }
    fs::write(path, text)
}

/// Writes a garment with texture coordinates and one material (`garment.mtl` beside it).
pub fn write_garment(path: &Path, name: &str, mesh: &Mesh, texture: &Texture) -> io::Result<()> {
    let mut text = format!("mtllib garment.mtl\no {name}\n");
    text += &vertices(mesh);
    for [u, v] in &texture.coordinates {
        let _ = writeln!(text, "vt {u:.6} {v:.6}");
    }
    text += "usemtl cloth\ns 1\n";
    for (triangle, coordinates) in mesh.triangles.iter().zip(&texture.triangles) {
        text.push('f');
        for (v, t) in triangle.iter().zip(coordinates) {
            let _ = write!(text, " {}/{}", v + 1, t + 1);
        }
        text.push('\n');
    }
    fs::write(path, text)?;
    fs::write(path.with_file_name("garment.mtl"), "newmtl cloth\nKd 0.16 0.30 0.44\nKs 0.05 0.05 0.05\nNs 20\n")
}

/// Writes joints as `v` and bones as `l`, counted from 1.
pub fn write_skeleton(path: &Path, skeleton: &Skeleton) -> io::Result<()> {
    let mut text = String::new();
    for p in &skeleton.joints {
        let _ = writeln!(text, "v {:.7} {:.7} {:.7}", p.x, p.y, p.z);
    }
    for [a, b] in BONES {
        let _ = writeln!(text, "l {} {}", a + 1, b + 1);
    }
    fs::write(path, text)
}

/// Writes a matrix, one row a line.
pub fn write_matrix(path: &Path, rows: &[Vec<f64>]) -> io::Result<()> {
    let mut text = String::new();
    for row in rows {
        let mut separator = "";
        for value in row {
            let _ = write!(text, "{separator}{value:.6}");
            separator = " ";
        }
        text.push('\n');
    }
    fs::write(path, text)
}

/// Writes one index a line, counted from 0.
pub fn write_indices(path: &Path, indices: &[u32]) -> io::Result<()> {
    fs::write(path, indices.iter().map(|index| format!("{index}\n")).collect::<String>())
}

/// A joint as the file of a rig has it: name, parent (an index counted from 0), bind transform.
pub type RigLine<'a> = (&'a str, Option<usize>, DAffine3);

/// Writes a rig, one joint a line: `joint NAME PARENT` and the 16 numbers of the bind transform, column by column. The
/// parent of a root is -1. A joint without a name is called by its index; spaces become `_`.
pub fn write_rig<'a>(path: &Path, joints: impl IntoIterator<Item = RigLine<'a>>) -> io::Result<()> {
    let mut text = String::new();
    for (index, (name, parent, bind)) in joints.into_iter().enumerate() {
        let name = if name.is_empty() { format!("joint_{index}") } else { name.replace(char::is_whitespace, "_") };
        let parent = parent.map_or("-1".to_owned(), |parent| parent.to_string());
        let _ = write!(text, "joint {name} {parent}");
        for number in DMat4::from(bind).to_cols_array() {
            let _ = write!(text, " {number:?}");
        }
        text.push('\n');
    }
    fs::write(path, text)
}

/// Writes influences, one vertex a line: joints (counted from 0) and weights in turn.
pub fn write_influences(path: &Path, influences: &[Vec<(usize, f64)>]) -> io::Result<()> {
    let mut text = String::new();
    for vertex in influences {
        let words: Vec<String> = vertex.iter().map(|(joint, weight)| format!("{joint} {weight:?}")).collect();
        text += &words.join(" ");
        text.push('\n');
    }
    fs::write(path, text)
}
