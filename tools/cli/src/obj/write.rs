//! The dressed avatar as an OBJ file: the text of the avatar's file, and the garments behind it.

use std::collections::{BTreeSet, HashMap};
use std::fmt::Write;

use bespoke_gltf::replace;
use glam::DVec3;

use super::Source;
use super::file::{Corner, Face, WORN};
use crate::args::{Dress, Keep};
use crate::dress::Dressed;
use crate::failure::{Failure, Result};
use crate::figure::{Figure, Part};
use crate::parts::Kind;

/// Writes the avatar with what it wears now. Its own lines stay as they are; of what it takes off, the faces go.
///
/// # Errors
/// Where the file cannot be written; nothing half-written stays.
pub fn write(args: &Dress, outfit: &Figure, avatar: &Figure, dressed: &[Dressed]) -> Result<()> {
    let Some(source) = &avatar.obj else {
        return Err(Failure::usage(format!(
            "{}: the avatar is no OBJ file, so neither is the result",
            args.output.display()
        )));
    };
    let mut text = match args.keep {
        Keep::Both => source.file.text.clone(),
        Keep::Body => without(avatar, source, Kind::Garment),
        Keep::Outfit => String::new(),
    };
    if !text.is_empty() && !text.ends_with('\n') {
        text.push('\n');
    }
    let counts = [source.file.positions.len(), source.file.texture.len(), source.file.normals.len()];
    let mut counts = if args.keep == Keep::Outfit { [0; 3] } else { counts };
    for (k, garment) in dressed.iter().enumerate() {
        let parts: Vec<&Part> = garment.garment.parts.iter().map(|&part| &outfit.parts[part]).collect();
        let garment = Worn { garment, parts, first: counts };
        counts = match &outfit.obj {
            Some(made_of) => garment.of_lines(&mut text, made_of, source, k == 0),
            None => garment.of_parts(&mut text, outfit, source)?,
        };
    }
    let text = libraries(outfit, &text) + &text;
    replace(&args.output, text.as_bytes())
        .map_err(|e| Failure::no_result(format!("{}: cannot be written: {e}", args.output.display())))
}

/// The lines of the outfit that name files of materials, where `text` has not got them. They come first, as some readers ask for.
fn libraries(outfit: &Figure, text: &str) -> String {
    let names = |line: &&str| line.split_whitespace().next() == Some("mtllib");
    let own = outfit.obj.as_ref().map(|source| source.file.text.as_str()).unwrap_or_default();
    let new = own.lines().map(str::trim).filter(names).filter(|line| !text.lines().any(|other| other.trim() == *line));
    new.fold(String::new(), |all, line| all + line + "\n")
}

/// The text without the faces of parts of one kind.
fn without(avatar: &Figure, source: &Source, kind: Kind) -> String {
    let gone: BTreeSet<usize> = avatar.of(kind).map(|part| source.piece(part)).collect();
    let lines: BTreeSet<usize> =
        source.file.faces.iter().filter(|face| gone.contains(&face.piece)).map(|face| face.line).collect();
    let kept = source.file.text.lines().enumerate().filter(|(line, _)| !lines.contains(line));
    kept.fold(String::new(), |text, (_, line)| text + line + "\n")
}

/// A garment on its way into the file.
struct Worn<'a> {
    garment: &'a Dressed<'a>,
    parts: Vec<&'a Part>,
    /// How many vertices, texture coordinates and normals there are before it.
    first: [usize; 3],
}

impl Worn<'_> {
    /// Its vertices, part after part: which part, and which of its vertices.
    fn vertices(&self) -> impl Iterator<Item = (&Part, usize)> {
        self.parts
            .iter()
            .flat_map(|part| part.vertices.iter().map(|&v| (*part, v as usize - part.primitive.vertices.start)))
    }

    fn begin(&self, text: &mut String) {
        *text += &format!("{WORN}\no {}\n", self.garment.garment.name);
    }

    fn normals(&self, text: &mut String, to: &Source) {
        for normal in &self.garment.fitted.normals {
            let turned = to.space.position_from_internal(*normal).normalize_or_zero();
            row(text, "vn", &turned.to_array());
        }
    }

    /// As it stands in its own OBJ file: vertices in their order, faces with their corners, texture coordinates, groups and
    /// materials. Vertices of no face go with the `first` garment. How many of all there are then.
    fn of_lines(&self, text: &mut String, from: &Source, to: &Source, is_first: bool) -> [usize; 3] {
        let pieces: BTreeSet<usize> = self.parts.iter().map(|part| from.piece(part)).collect();
        let faces: Vec<&Face> = from.file.faces.iter().filter(|face| pieces.contains(&face.piece)).collect();
        // Copies of a vertex are in one place.
        let (mut place, mut normal) = (HashMap::new(), HashMap::<(usize, Corner), usize>::new());
        for (k, (part, local)) in self.vertices().enumerate() {
            let corner = from.corners[&[part.mesh, part.primitive.index]][local];
            place.entry(corner.0).or_insert(self.garment.fitted.positions[k]);
            normal.insert((from.piece(part), corner), k);
        }
        let used: BTreeSet<u32> =
            from.file.faces.iter().flat_map(|face| &face.corners).map(|corner| corner.0).collect();
        let mut vertex: HashMap<u32, usize> = HashMap::new();
        self.begin(text);
        for v in 0..from.file.positions.len() as u32 {
            let alone = || {
                let own = DVec3::from_array(from.file.positions[v as usize].map(f64::from));
                (is_first && !used.contains(&v)).then(|| from.space.position_to_internal(own))
            };
            if let Some(place) = place.get(&v).copied().or_else(alone) {
                vertex.insert(v, self.first[0] + vertex.len() + 1);
                row(text, "v", &to.space.position_from_internal(place).to_array());
            }
        }
        let own: BTreeSet<u32> = faces.iter().flat_map(|face| &face.corners).filter_map(|corner| corner.1).collect();
        let texture: HashMap<u32, usize> = own.iter().copied().zip(self.first[1] + 1..).collect();
        for &vt in &own {
            row(text, "vt", &from.file.texture[vt as usize].map(f64::from));
        }
        self.normals(text, to);
        let mut faces = faces.into_iter().peekable();
        // What holds for the faces that follow: group, material, smoothing.
        let mut state: Vec<(&str, &str)> = Vec::new();
        let mut said: Vec<(&str, &str)> = Vec::new();
        for (index, line) in from.file.text.lines().enumerate() {
            let line = line.trim();
            let key = line.split_whitespace().next().unwrap_or_default();
            if ["g", "usemtl", "s"].contains(&key) {
                state.retain(|(other, _)| *other != key);
                state.push((key, line));
            }
            if faces.peek().is_some_and(|face| face.line == index) {
                let Some(face) = faces.next() else { break };
                for entry in state.iter().filter(|entry| !said.contains(entry)) {
                    text.extend([entry.1, "\n"]);
                }
                said.clone_from(&state);
                *text += "f";
                for corner in &face.corners {
                    let vt = corner.1.map(|vt| texture[&vt].to_string()).unwrap_or_default();
                    let vn = self.first[2] + normal[&(face.piece, *corner)] + 1;
                    let _ = write!(text, " {}/{vt}/{vn}", vertex[&corner.0]);
                }
                *text += "\n";
            }
        }
        [self.first[0] + vertex.len(), self.first[1] + texture.len(), self.first[2] + self.garment.fitted.normals.len()]
    }

    /// Out of a glTF file: its triangles with their materials' names.
    fn of_parts(&self, text: &mut String, from: &Figure, to: &Source) -> Result<[usize; 3]> {
        self.begin(text);
        for &place in &self.garment.fitted.positions {
            row(text, "v", &to.space.position_from_internal(place).to_array());
        }
        let count = self.garment.fitted.positions.len();
        let mut texture = Vec::with_capacity(self.parts.len());
        let mut next = self.first[1];
        for part in &self.parts {
            let accessor = part.primitive.attributes.iter().find(|(name, _)| name == "TEXCOORD_0").map(|(_, a)| *a);
            let Some(accessor) = accessor else {
                texture.push(None);
                continue;
            };
            let rows = from
                .document
                .rows::<2>(accessor)
                .map_err(|e| Failure::no_result(e.in_file(from.file.display().to_string()).to_string()))?;
            for &v in &part.vertices {
                let [u, v] = rows[v as usize - part.primitive.vertices.start];
                row(text, "vt", &[u, 1.0 - v]);
            }
            texture.push(Some(next));
            next += part.vertices.len();
        }
        self.normals(text, to);
        let mut first = 0;
        for (part, texture) in self.parts.iter().zip(texture) {
            if !part.material.is_empty() {
                *text += &format!("usemtl {}\n", part.material);
            }
            for triangle in &part.triangles {
                *text += "f";
                for v in triangle.map(|v| v as usize) {
                    let vt = texture.map(|texture| (texture + v + 1).to_string()).unwrap_or_default();
                    let [own, vn] = [self.first[0], self.first[2]].map(|before| before + first + v + 1);
                    let _ = write!(text, " {own}/{vt}/{vn}");
                }
                *text += "\n";
            }
            first += part.vertices.len();
        }
        Ok([self.first[0] + count, next, self.first[2] + self.garment.fitted.normals.len()])
    }
}

/// A line of numbers of 32 bits, each of which survives.
fn row(text: &mut String, key: &str, numbers: &[f64]) {
    *text += key;
    for &number in numbers {
        let _ = write!(text, " {}", number as f32);
    }
    *text += "\n";
}
