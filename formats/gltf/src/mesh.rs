//! Meshes as the file holds them: each in its own space, vertices that primitives share once.

use std::collections::HashMap;
use std::ops::Range;

use serde_json::Value;

use crate::document::{Document, compressed};
use crate::error::Result;
use crate::json::At;
use crate::reader::Reader;

/// A mesh: its primitives joined, in its own space.
#[derive(Clone, Debug, Default)]
pub struct Mesh {
    /// Empty where it has none.
    pub name: String,
    /// Positions of all vertices.
    pub positions: Vec<[f64; 3]>,
    /// Three vertices a triangle, counter-clockwise seen from outside.
    pub triangles: Vec<[u32; 3]>,
    /// For each vertex, places in the skin's list of joints with weights that sum to 1; empty where the mesh has none.
    pub influences: Vec<Vec<(u32, f64)>>,
    /// Its morph targets.
    pub morphs: Vec<Morph>,
    /// What it is made of.
    pub primitives: Vec<Primitive>,
    /// What was passed over or put right, in sentences.
    pub notes: Vec<String>,
}

/// A primitive, and which part of its mesh it is. Primitives whose attributes are the same accessors have the same
/// vertices.
#[derive(Clone, Debug)]
pub struct Primitive {
    /// Place in the file's list of primitives.
    pub index: usize,
    /// Its vertices.
    pub vertices: Range<usize>,
    /// Its triangles.
    pub triangles: Range<usize>,
    /// Its material.
    pub material: Option<usize>,
    /// Its attributes by name, with the accessor of each.
    pub attributes: Vec<(String, usize)>,
    /// The accessor of its indices.
    pub indices: Option<usize>,
}

/// A morph target: what it adds to the positions.
#[derive(Clone, Debug, Default)]
pub struct Morph {
    /// From `extras.targetNames`; empty where there is none.
    pub name: String,
    /// How much of it the mesh has as it lies in the file; a node may say otherwise.
    pub weight: f64,
    /// Vertices that it moves, in order, with how far.
    pub deltas: crate::import::Deltas,
}

impl Document {
    /// Reads a mesh.
    ///
    /// # Errors
    /// Where an accessor leaves its data, is compressed or does not fit the others, or a number is not finite.
    pub fn mesh(&self, index: usize) -> Result<Mesh> {
        read(&Reader::new(self), index)
    }

    /// The accessor of an attribute such as "NORMAL", and rows of `N` numbers as it holds them.
    ///
    /// # Errors
    /// Where it leaves its data, or its elements have another number of numbers.
    pub fn rows<const N: usize>(&self, accessor: usize) -> Result<Vec<[f64; N]>> {
        Reader::new(self).numbers(accessor)
    }
}

/// What primitives with the same vertices have in common.
type Shared = (Vec<(String, usize)>, Vec<Vec<(String, usize)>>);

pub(crate) fn read(reader: &Reader, index: usize) -> Result<Mesh> {
    let at = reader.document.entry("meshes", index)?;
    let mut mesh = Mesh { name: at.text_of("name").to_owned(), ..Mesh::default() };
    let mut known: HashMap<Shared, Range<usize>> = HashMap::new();
    for (index, primitive) in at.need("primitives")?.list()?.enumerate() {
        read_primitive(reader, &primitive, index, &mut mesh, &mut known)?;
    }
    if mesh.influences.iter().all(Vec::is_empty) {
        mesh.influences.clear();
    }
    let names = at.get("extras").and_then(|extras| extras.get("targetNames"));
    let weights = at.list_of("weights")?;
    for (k, morph) in mesh.morphs.iter_mut().enumerate() {
        let name = names.as_ref().and_then(|names| names.value.get(k)).and_then(Value::as_str);
        name.unwrap_or_default().clone_into(&mut morph.name);
        morph.weight = weights.get(k).map_or(Ok(0.0), At::number)?;
    }
    Ok(mesh)
}

/// The attributes of a primitive or target.
fn attributes(at: &At, accessors: usize) -> Result<Vec<(String, usize)>> {
    let object = at.value.as_object().ok_or_else(|| at.error("is no object"))?;
    let mut read = Vec::with_capacity(object.len());
    for name in object.keys() {
        read.push((name.clone(), at.need(name)?.index_into("accessors", accessors)?));
    }
    Ok(read)
}

fn find(attributes: &[(String, usize)], name: &str) -> Option<usize> {
    attributes.iter().find(|(other, _)| other == name).map(|(_, accessor)| *accessor)
}

fn read_primitive(
    reader: &Reader,
    at: &At,
    index: usize,
    mesh: &mut Mesh,
    known: &mut HashMap<Shared, Range<usize>>,
) -> Result<()> {
    let accessors = reader.document.count("accessors")?;
    let mode_at = at.get("mode");
    let mode = mode_at.as_ref().map_or(Ok(4), At::count)?;
    match (mode, mode_at) {
        (4..=6, _) => {}
        (0..=3, _) => {
            let what = if mode == 0 { "points" } else { "lines" };
            mesh.notes.push(format!("{}: has {what}, no triangles, and was passed over", at.path));
            return Ok(());
        }
        (_, Some(at)) => return Err(at.error(format!("is {mode}, which is no mode of glTF (0 to 6)"))),
        (_, None) => unreachable!("the default is 4"),
    }
    let attributes_at = at.need("attributes")?;
    let own = attributes(&attributes_at, accessors)?;
    let targets: Vec<_> =
        at.list_of("targets")?.iter().map(|target| attributes(target, accessors)).collect::<Result<_>>()?;
    let Some(position) = find(&own, "POSITION") else {
        mesh.notes.push(format!("{}: has no positions and was passed over", at.path));
        return Ok(());
    };
    if at.extension("KHR_draco_mesh_compression").is_some() {
        let accessor = reader.document.entry("accessors", position)?;
        if accessor.get("bufferView").is_none() && accessor.get("sparse").is_none() {
            return Err(at.error(compressed("KHR_draco_mesh_compression")));
        }
    }
    let shared = (own, targets);
    let vertices = match known.get(&shared) {
        Some(vertices) => vertices.clone(),
        None => {
            let vertices = read_vertices(reader, &attributes_at, at, &shared, position, mesh)?;
            known.insert(shared.clone(), vertices.clone());
            vertices
        }
    };
    let indices = at.index("indices", "accessors", accessors)?;
    let corners: Vec<u32> = match indices {
        Some(accessor) => {
            let corners = reader.integers::<1>(accessor)?.into_iter().map(|[v]| v);
            corners.collect()
        }
        None => {
            reader.take(at, vertices.len() * 4)?;
            (0..vertices.len() as u32).collect()
        }
    };
    if let Some(k) = corners.iter().position(|&v| v as usize >= vertices.len()) {
        let path = at.get("indices").unwrap_or_else(|| at.clone());
        return Err(path.error(format!("index {k} is {}, but there are {} vertices", corners[k], vertices.len())));
    }
    if mode == 4 && !corners.len().is_multiple_of(3) {
        mesh.notes.push(format!(
            "{}: {} corners are no whole triangles; the last were left out",
            at.path,
            corners.len()
        ));
    }
    let first = mesh.triangles.len();
    reader.take(at, corners.len() * 12)?;
    let base = vertices.start as u32;
    mesh.triangles.extend(triangles(&corners, mode).into_iter().map(|t| t.map(|v| base + v)));
    mesh.primitives.push(Primitive {
        index,
        vertices,
        triangles: first..mesh.triangles.len(),
        material: at.index("material", "materials", reader.document.count("materials")?)?,
        attributes: shared.0,
        indices,
    });
    Ok(())
}

fn read_vertices(
    reader: &Reader,
    attributes_at: &At,
    at: &At,
    (own, targets): &Shared,
    position: usize,
    mesh: &mut Mesh,
) -> Result<Range<usize>> {
    let positions = reader.numbers::<3>(position)?;
    let vertices = mesh.positions.len()..mesh.positions.len() + positions.len();
    if u32::try_from(vertices.end).is_err() {
        return Err(at.error("the mesh has more vertices than 32 bits can count"));
    }
    for (name, accessor) in own.iter().chain(targets.iter().flatten()) {
        let count = reader.document.entry("accessors", *accessor)?.need("count")?.count()?;
        if count != positions.len() {
            let what = format!("'{name}' (accessor {accessor}) has {count} elements, and POSITION {}", positions.len());
            return Err(attributes_at.error(what));
        }
    }
    let influences = influences(reader, attributes_at, own, positions.len(), &mut mesh.notes)?;
    mesh.influences.extend(influences);
    for (k, target) in targets.iter().enumerate() {
        if mesh.morphs.len() <= k {
            mesh.morphs.push(Morph::default());
        }
        if let Some(accessor) = find(target, "POSITION") {
            let accessor = reader.accessor(accessor)?;
            let rows = accessor.sparse_rows::<3>()?;
            reader.take(&accessor.at, rows.len() * size_of::<(u32, [f64; 3])>())?;
            let base = vertices.start as u32;
            mesh.morphs[k].deltas.extend(rows.into_iter().map(|(v, delta)| (base + v, delta)));
        }
    }
    mesh.positions.extend(positions);
    Ok(vertices)
}

/// The influences of `count` vertices from all sets; an empty list for each where the primitive has none.
fn influences(
    reader: &Reader,
    at: &At,
    attributes: &[(String, usize)],
    count: usize,
    notes: &mut Vec<String>,
) -> Result<Vec<Vec<(u32, f64)>>> {
    reader.take(at, count * size_of::<Vec<(u32, f64)>>())?;
    let mut all: Vec<Vec<(u32, f64)>> = vec![Vec::new(); count];
    let mut first_joint: Vec<u32> = Vec::new();
    for set in 0.. {
        let names = (format!("JOINTS_{set}"), format!("WEIGHTS_{set}"));
        let (joints, weights) = match (find(attributes, &names.0), find(attributes, &names.1)) {
            (Some(joints), Some(weights)) => (reader.integers::<4>(joints)?, reader.numbers::<4>(weights)?),
            (None, None) => break,
            (Some(_), None) => return Err(at.error(format!("has {} without {}", names.0, names.1))),
            (None, Some(_)) => return Err(at.error(format!("has {} without {}", names.1, names.0))),
        };
        if set == 0 {
            first_joint = joints.iter().map(|j| j[0]).collect();
        }
        // What a vertex may take at most: a list of four entries a set.
        reader.take(at, count * 4 * size_of::<(u32, f64)>())?;
        for (own, (joints, weights)) in all.iter_mut().zip(joints.iter().zip(&weights)) {
            for (&joint, &weight) in joints.iter().zip(weights).filter(|(_, weight)| **weight > 0.0) {
                match own.iter_mut().find(|(other, _)| *other == joint) {
                    Some((_, sum)) => *sum += weight,
                    None => own.push((joint, weight)),
                }
            }
        }
    }
    if first_joint.is_empty() {
        return Ok(all);
    }
    let mut without = 0;
    for (own, first) in all.iter_mut().zip(first_joint) {
        let sum: f64 = own.iter().map(|(_, weight)| weight).sum();
        if own.is_empty() {
            // As engines do.
            own.push((first, 1.0));
            without += 1;
        } else {
            own.iter_mut().for_each(|(_, weight)| *weight /= sum);
        }
    }
    if without > 0 {
        notes.push(format!("{}: {without} vertices without weights were given to their first joint", at.path));
    }
    Ok(all)
}

/// The triangles of a primitive.
fn triangles(corners: &[u32], mode: usize) -> Vec<[u32; 3]> {
    let turned = |(k, w): (usize, &[u32])| if k % 2 == 0 { [w[0], w[1], w[2]] } else { [w[1], w[0], w[2]] };
    // Strips are joined by triangles without area.
    let has_area = |t: &[u32; 3]| t[0] != t[1] && t[1] != t[2] && t[2] != t[0];
    match mode {
        5 => corners.windows(3).enumerate().map(turned).filter(has_area).collect(),
        6 => corners.windows(2).skip(1).map(|w| [corners[0], w[0], w[1]]).filter(has_area).collect(),
        _ => corners.as_chunks().0.to_vec(),
    }
}
