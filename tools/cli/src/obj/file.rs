//! What an OBJ file holds, in its order.

use std::path::Path;

use crate::failure::{Failure, Result};

/// Where a file was written by this program, the line before a garment.
pub const WORN: &str = "# bespoke garment";

/// A corner of a face: its vertex, texture coordinate and normal, from 0.
pub type Corner = (u32, Option<u32>, Option<u32>);

/// A face, with any number of corners.
#[derive(Clone, Debug)]
pub struct Face {
    /// Index of its line.
    pub line: usize,
    /// Which of the file's pieces it belongs to.
    pub piece: usize,
    /// Three at least.
    pub corners: Vec<Corner>,
}

/// The faces of one object, or group where there are no objects, that have one material.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Piece {
    /// Name of the object or group; empty before the first.
    pub object: String,
    /// Name of the material; empty before the first.
    pub material: String,
    /// Whether the file says that it is a garment that was put on.
    pub is_worn: bool,
}

/// An OBJ file.
#[derive(Clone, Debug, Default)]
pub struct ObjFile {
    /// Its text.
    pub text: String,
    /// Vertices.
    pub positions: Vec<[f32; 3]>,
    /// Texture coordinates, whose origin is at the lower left.
    pub texture: Vec<[f32; 2]>,
    /// Normals.
    pub normals: Vec<[f32; 3]>,
    /// Faces in their order.
    pub faces: Vec<Face>,
    /// Lines between two vertices.
    pub segments: Vec<[u32; 2]>,
    /// Objects with one of their materials, by first use.
    pub pieces: Vec<Piece>,
}

impl ObjFile {
    /// Reads a file.
    ///
    /// # Errors
    /// With file and line.
    pub fn open(path: &Path) -> Result<Self> {
        let said = |what: String| Failure::no_result(format!("{}: {what}", path.display()));
        let bytes = std::fs::read(path).map_err(|e| said(format!("it cannot be read: {e}")))?;
        // Names are in whatever encoding.
        let text = String::from_utf8(bytes).unwrap_or_else(|e| String::from_utf8_lossy(e.as_bytes()).into_owned());
        Self::parse(text).map_err(said)
    }

    /// # Errors
    /// With the line.
    fn parse(text: String) -> Result<Self, String> {
        let mut file = Self::default();
        let has_objects = text.lines().any(|line| line.split_whitespace().next() == Some("o"));
        let mut now = Piece { object: String::new(), material: String::new(), is_worn: false };
        let mut says_worn = false;
        let mut highest = [(0i64, 0usize); 3];
        for (index, line) in text.lines().enumerate() {
            let at = |what: String| format!("line {}: {what}", index + 1);
            let mut words = line.split_whitespace();
            let Some(key) = words.next() else { continue };
            let name = || line.trim_start()[key.len()..].trim().to_string();
            match key {
                "v" => file.positions.push(numbers(words, "a vertex").map_err(at)?),
                "vt" => {
                    let [u, v] = match numbers::<2>(words.clone(), "a texture coordinate") {
                        // One number is a point of a line.
                        Err(_) if words.clone().count() == 1 => {
                            [numbers::<1>(words, "a texture coordinate").map_err(at)?[0], 0.0]
                        }
                        other => other.map_err(at)?,
                    };
                    file.texture.push([u, v]);
                }
                "vn" => file.normals.push(numbers(words, "a normal").map_err(at)?),
                "f" => {
                    let counts = [file.positions.len(), file.texture.len(), file.normals.len()];
                    let corner = |word| corner(word, counts, &mut highest, index).map_err(at);
                    let corners: Vec<Corner> = words.map(corner).collect::<Result<_, _>>()?;
                    if corners.len() < 3 {
                        return Err(at(format!("a face has {} corners, and needs three", corners.len())));
                    }
                    let piece = file.piece(&now);
                    file.faces.push(Face { line: index, piece, corners });
                }
                "l" => {
                    let counts = [file.positions.len(), file.texture.len(), file.normals.len()];
                    let corner = |word| corner(word, counts, &mut highest, index).map_err(at);
                    let ends: Vec<Corner> = words.map(corner).collect::<Result<_, _>>()?;
                    file.segments.extend(ends.windows(2).map(|pair| [pair[0].0, pair[1].0]));
                }
                "o" => {
                    now = Piece { object: name(), material: now.material, is_worn: says_worn };
                    says_worn = false;
                }
                "g" if !has_objects => now.object = name(),
                "usemtl" => now.material = name(),
                _ if line.trim() == WORN => says_worn = true,
                _ => {}
            }
        }
        let counts = [file.positions.len(), file.texture.len(), file.normals.len()];
        let kinds = ["vertex", "texture coordinate", "normal"];
        for ((&(index, line), count), kind) in highest.iter().zip(counts).zip(kinds) {
            if index > count as i64 {
                return Err(format!("line {}: there is no {kind} {index}; the file has {count}", line + 1));
            }
        }
        file.text = text;
        Ok(file)
    }

    fn piece(&mut self, now: &Piece) -> usize {
        // The last one first: faces come in runs.
        let known = self.pieces.iter().rposition(|piece| piece == now);
        known.unwrap_or_else(|| {
            self.pieces.push(now.clone());
            self.pieces.len() - 1
        })
    }
}

fn numbers<'a, const N: usize>(mut words: impl Iterator<Item = &'a str>, what: &str) -> Result<[f32; N], String> {
    let mut row = [0.0; N];
    for (k, number) in row.iter_mut().enumerate() {
        let word = words.next().ok_or_else(|| format!("{what} needs {N} coordinates and has {k}"))?;
        let value = word.parse::<f32>().ok().filter(|value| value.is_finite());
        *number = value.ok_or_else(|| format!("'{word}' is not a coordinate (a finite 32-bit number)"))?;
    }
    Ok(row)
}

/// `v`, `v/vt`, `v//vn` or `v/vt/vn`, counted from 1, or from the end by numbers below 0. A face may name what comes later in the
/// file: `highest` keeps what has to be there, and the line that says so.
fn corner(word: &str, counts: [usize; 3], highest: &mut [(i64, usize); 3], line: usize) -> Result<Corner, String> {
    let wrong = || format!("'{word}' is not a corner (v, v/vt, v/vt/vn or v//vn with indices from 1 or below 0)");
    let mut fields = [None; 3];
    for (k, field) in word.split('/').enumerate() {
        if k > 2 {
            return Err(wrong());
        }
        if field.is_empty() && k > 0 {
            continue;
        }
        let index: i64 = field.parse().map_err(|_| wrong())?;
        let index = if index < 0 { counts[k] as i64 + 1 + index } else { index };
        if index <= 0 || index > i64::from(u32::MAX) {
            return Err(if index == 0 && field == "0" { wrong() } else { format!("'{word}' names what is not there") });
        }
        if index > highest[k].0 {
            highest[k] = (index, line);
        }
        fields[k] = Some((index - 1) as u32);
    }
    Ok((fields[0].ok_or_else(wrong)?, fields[1], fields[2]))
}
