//! Appends to a file: new entries go to the ends of its lists, new data behind its data, and what is there stays.

use serde_json::{Map, Value, json};

use crate::container::Form;
use crate::document::Document;
use crate::error::{Error, Result};
use crate::nodes::Matrix;

/// `bufferView.target` of vertex attributes.
pub const VERTICES: u32 = 34962;
/// `bufferView.target` of indices.
pub const INDICES: u32 = 34963;

/// A file with additions, in memory until it is [written](Edit::output).
///
/// Indices of the file stay what they are, and so do its data; of the JSON, text that has not changed is kept letter by
/// letter.
pub struct Edit<'a> {
    document: &'a Document,
    form: Form,
    json: Value,
    /// Which buffer the new data goes to, and how many bytes it has before them.
    home: usize,
    base: usize,
    new: Vec<u8>,
}

impl<'a> Edit<'a> {
    /// Begins with a file as it is. `form` is what it will be written as: everything in one GLB file, or a JSON text with
    /// files beside it.
    ///
    /// # Errors
    /// Where its lists are none.
    pub fn new(document: &'a Document, form: Form) -> Result<Self> {
        let buffers = document.count("buffers")?;
        // The binary chunk of a GLB file is its first buffer.
        let chunk = document.binary_chunk().filter(|_| document.has_chunk_buffer());
        let (home, base) = match (chunk, form) {
            (Some(chunk), _) => (0, chunk.len()),
            (None, Form::Glb) => (0, if buffers == 0 { 0 } else { document.buffer(0)?.len() }),
            (None, Form::Gltf) => (buffers, 0),
        };
        let base = base.next_multiple_of(4);
        Ok(Self { document, form, json: document.json().clone(), home, base, new: Vec::new() })
    }

    /// The file that this began with.
    #[must_use]
    pub fn document(&self) -> &'a Document {
        self.document
    }

    /// The JSON as it will be written.
    #[must_use]
    pub fn json(&self) -> &Value {
        &self.json
    }

    /// The same to change. Who takes something out of a list moves what comes after it.
    pub fn json_mut(&mut self) -> &mut Value {
        &mut self.json
    }

    /// Appends an entry to a list such as "nodes"; its index.
    ///
    /// # Errors
    /// Where the file has something else under that name.
    pub fn push(&mut self, list: &str, entry: Value) -> Result<usize> {
        let root = self.json.as_object_mut().ok_or_else(|| Error::json("", "is no object"))?;
        let entries = root.entry(list).or_insert_with(|| Value::Array(Vec::new()));
        let entries = entries.as_array_mut().ok_or_else(|| Error::json(format!("/{list}"), "is no array"))?;
        entries.push(entry);
        Ok(entries.len() - 1)
    }

    /// Notes that an extension is used, and whether a reader has to know it.
    ///
    /// # Errors
    /// Where the file's list of extensions is none.
    pub fn use_extension(&mut self, name: &str, required: bool) -> Result<()> {
        for list in ["extensionsUsed", "extensionsRequired"].into_iter().take(1 + usize::from(required)) {
            let known = self.json.get(list).and_then(Value::as_array);
            if !known.is_some_and(|known| known.iter().any(|other| other.as_str() == Some(name))) {
                self.push(list, name.into())?;
            }
        }
        Ok(())
    }

    /// Appends bytes as a buffer view, at a multiple of four; its index. `stride` is for vertices only.
    ///
    /// # Errors
    /// Where a list of the file is none, or the data are above 4 GiB.
    pub fn add_view(&mut self, bytes: &[u8], target: Option<u32>, stride: Option<usize>) -> Result<usize> {
        self.new.resize(self.new.len().next_multiple_of(4), 0);
        let offset = self.base + self.new.len();
        if u32::try_from(offset + bytes.len()).is_err() {
            return Err(Error::file("the data would be above 4 GiB, which a file of glTF cannot hold"));
        }
        self.new.extend(bytes);
        let mut view = json!({ "buffer": self.home, "byteOffset": offset, "byteLength": bytes.len() });
        if let Some(stride) = stride {
            view["byteStride"] = stride.into();
        }
        if let Some(target) = target {
            view["target"] = target.into();
        }
        self.push("bufferViews", view)
    }

    fn add(&mut self, bytes: &[u8], component: u32, kind: &str, count: usize, target: Option<u32>) -> Result<Value> {
        if count == 0 {
            return Err(Error::file("glTF has no empty accessors, and one was to be written"));
        }
        let view = self.add_view(bytes, target, None)?;
        Ok(json!({ "bufferView": view, "componentType": component, "count": count, "type": kind }))
    }

    /// Appends rows of `N` (1 to 4) 32-bit numbers for vertices, or with another `target` for other things; the accessor.
    ///
    /// # Errors
    /// Where there are none, or one is not finite.
    pub fn add_rows<const N: usize>(&mut self, rows: &[[f64; N]], target: Option<u32>) -> Result<usize> {
        let accessor = self.rows(rows, target)?;
        self.push("accessors", accessor)
    }

    fn rows<const N: usize>(&mut self, rows: &[[f64; N]], target: Option<u32>) -> Result<Value> {
        let bytes = floats(rows.as_flattened())?;
        self.add(&bytes, 5126, ["SCALAR", "VEC2", "VEC3", "VEC4"][N - 1], rows.len(), target)
    }

    /// Appends vertex attributes of `N` numbers, such as normals; the accessor.
    ///
    /// # Errors
    /// Where there are none, or one is not finite.
    pub fn add_attribute<const N: usize>(&mut self, rows: &[[f64; N]]) -> Result<usize> {
        self.add_rows(rows, Some(VERTICES))
    }

    /// Appends positions, with their least and greatest as glTF demands; the accessor.
    ///
    /// # Errors
    /// Where there are none, or one is not finite.
    pub fn add_positions(&mut self, positions: &[[f64; 3]]) -> Result<usize> {
        let mut accessor = self.rows(positions, Some(VERTICES))?;
        bounds(&mut accessor, positions);
        self.push("accessors", accessor)
    }

    /// Appends what a morph target adds to `count` positions, of which only those listed move; the accessor. Where few
    /// move, only these are written.
    ///
    /// # Errors
    /// Where an index is above the others or not below `count`, or a number is not finite.
    pub fn add_deltas(&mut self, count: usize, deltas: &[(u32, [f64; 3])]) -> Result<usize> {
        if !deltas.is_sorted_by(|a, b| a.0 < b.0) || deltas.last().is_some_and(|(last, _)| *last as usize >= count) {
            return Err(Error::file("deltas of a morph target do not rise, or are for more vertices than there are"));
        }
        let mut rows = vec![[0.0; 3]; count];
        deltas.iter().for_each(|(v, delta)| rows[*v as usize] = *delta);
        let mut accessor = if deltas.is_empty() {
            json!({ "componentType": 5126, "count": count, "type": "VEC3" })
        } else if deltas.len() * 4 < count {
            let moved: Vec<[f64; 3]> = deltas.iter().map(|(_, delta)| *delta).collect();
            let indices: Vec<u8> = deltas.iter().flat_map(|(v, _)| v.to_le_bytes()).collect();
            let (indices, values) =
                (self.add_view(&indices, None, None)?, self.add_view(&floats(moved.as_flattened())?, None, None)?);
            json!({ "componentType": 5126, "count": count, "type": "VEC3", "sparse": {
                "count": deltas.len(),
                "indices": { "bufferView": indices, "componentType": 5125 },
                "values": { "bufferView": values },
            } })
        } else {
            self.rows(&rows, Some(VERTICES))?
        };
        bounds(&mut accessor, &rows);
        self.push("accessors", accessor)
    }

    /// Appends the corners of triangles; the accessor. 16 bits are taken where they are enough.
    ///
    /// # Errors
    /// Where there are none.
    pub fn add_triangles(&mut self, triangles: &[[u32; 3]]) -> Result<usize> {
        let corners = triangles.as_flattened();
        // The highest number of each size restarts a strip, and is no vertex.
        let accessor = if corners.iter().all(|&v| v < 0xFFFF) {
            let bytes: Vec<u8> = corners.iter().flat_map(|&v| (v as u16).to_le_bytes()).collect();
            self.add(&bytes, 5123, "SCALAR", corners.len(), Some(INDICES))?
        } else {
            let bytes: Vec<u8> = corners.iter().flat_map(|v| v.to_le_bytes()).collect();
            self.add(&bytes, 5125, "SCALAR", corners.len(), Some(INDICES))?
        };
        self.push("accessors", accessor)
    }

    /// Appends bind matrices; the accessor.
    ///
    /// # Errors
    /// Where there are none, or a number is not finite.
    pub fn add_matrices(&mut self, matrices: &[Matrix]) -> Result<usize> {
        let bytes = floats(matrices.as_flattened().as_flattened())?;
        let accessor = self.add(&bytes, 5126, "MAT4", matrices.len(), None)?;
        self.push("accessors", accessor)
    }

    /// Appends the influences of vertices: for each set of four the accessors of JOINTS_n and WEIGHTS_n. Weights are made to
    /// sum to 1 in 32 bits; a vertex with none gets the first joint.
    ///
    /// # Errors
    /// Where there are no vertices, a joint is above 65,535, or a weight is negative or not finite.
    pub fn add_influences(&mut self, influences: &[Vec<(u32, f64)>]) -> Result<Vec<(usize, usize)>> {
        let most = influences.iter().map(Vec::len).max().unwrap_or(0).max(1);
        let mut rows: Vec<Vec<(u16, f64)>> = Vec::with_capacity(influences.len());
        for (v, own) in influences.iter().enumerate() {
            let sum: f64 = own.iter().map(|(_, weight)| weight).sum();
            let mut row = Vec::with_capacity(own.len());
            for &(joint, weight) in own.iter().filter(|(_, weight)| *weight != 0.0) {
                let joint = u16::try_from(joint).ok().filter(|_| weight > 0.0 && sum.is_finite());
                let joint = joint.ok_or_else(|| {
                    Error::file(format!("the weights of vertex {v} are negative or on a joint above 65535"))
                })?;
                row.push((joint, weight / sum));
            }
            if row.is_empty() {
                row.push((0, 1.0));
            }
            row.sort_by(|a, b| b.1.total_cmp(&a.1).then(a.0.cmp(&b.0)));
            rows.push(row);
        }
        let small = rows.iter().flatten().all(|(joint, _)| *joint <= 0xFF);
        let mut sets = Vec::new();
        for set in 0..most.div_ceil(4) {
            let place = |row: &[(u16, f64)], k: usize| row.get(4 * set + k).copied().unwrap_or((0, 0.0));
            let each = || rows.iter().flat_map(|row| (0..4).map(move |k| place(row, k)));
            let bytes: Vec<u8> = if small {
                each().map(|(joint, _)| joint as u8).collect()
            } else {
                each().flat_map(|(joint, _)| joint.to_le_bytes()).collect()
            };
            let joints = self.add(&bytes, if small { 5121 } else { 5123 }, "VEC4", rows.len(), Some(VERTICES))?;
            let joints = self.push("accessors", joints)?;
            let weights: Vec<[f64; 4]> = rows.iter().map(|row| [0, 1, 2, 3].map(|k| place(row, k).1)).collect();
            sets.push((joints, self.add_attribute(&weights)?));
        }
        Ok(sets)
    }

    /// Appends a skin over nodes with their bind matrices (from the file's space to each joint's own); its index.
    ///
    /// # Errors
    /// Where there is no joint, their numbers differ, or a number is not finite.
    pub fn add_skin(&mut self, name: &str, joints: &[usize], inverse_binds: &[Matrix]) -> Result<usize> {
        if joints.len() != inverse_binds.len() {
            let said = format!("a skin of {} joints with {} bind matrices", joints.len(), inverse_binds.len());
            return Err(Error::file(said));
        }
        let matrices = self.add_matrices(inverse_binds)?;
        self.push("skins", named(name, json!({ "joints": joints, "inverseBindMatrices": matrices })))
    }

    /// Appends a node with a mesh and a skin, below `parent` or at the top of the default scene; its index.
    ///
    /// # Errors
    /// Where there is no such parent, or the file's scene is none.
    pub fn add_node(&mut self, name: &str, mesh: usize, skin: Option<usize>, parent: Option<usize>) -> Result<usize> {
        let mut node = named(name, json!({ "mesh": mesh }));
        if let Some(skin) = skin {
            node["skin"] = skin.into();
        }
        self.hang(node, parent)
    }

    /// Appends a node that is written as JSON, below `parent` or at the top of the default scene; its index.
    ///
    /// # Errors
    /// As with [`Edit::add_node`].
    pub fn hang(&mut self, node: Value, parent: Option<usize>) -> Result<usize> {
        let node = self.push("nodes", node)?;
        let (list, path) = match parent {
            Some(parent) => ("children", format!("/nodes/{parent}")),
            None => {
                let scene = self.json.get("scene").and_then(Value::as_u64).unwrap_or(0);
                if self.json.get("scenes").and_then(Value::as_array).is_none_or(Vec::is_empty) {
                    self.push("scenes", json!({}))?;
                    self.json["scene"] = 0.into();
                }
                ("nodes", format!("/scenes/{scene}"))
            }
        };
        let missing = || Error::json(&path, "is not there");
        let owner = self.json.pointer_mut(&path).and_then(Value::as_object_mut).ok_or_else(missing)?;
        let list = owner.entry(list).or_insert_with(|| Value::Array(Vec::new()));
        list.as_array_mut().ok_or_else(|| Error::json(&path, "has a list that is none"))?.push(node.into());
        Ok(node)
    }

    /// Takes the mesh off a node, which stays: the mesh is shown there no more.
    ///
    /// # Errors
    /// Where there is no such node.
    pub fn take_off(&mut self, node: usize) -> Result<()> {
        let path = format!("/nodes/{node}");
        let found = self.json.pointer_mut(&path).and_then(Value::as_object_mut);
        let found = found.ok_or_else(|| Error::json(&path, "is not there"))?;
        for key in ["mesh", "skin", "weights"] {
            found.shift_remove(key);
        }
        Ok(())
    }

    pub(crate) fn form(&self) -> Form {
        self.form
    }

    pub(crate) fn home(&self) -> usize {
        self.home
    }

    /// Where the new data begin in their buffer, and they.
    pub(crate) fn data(&self) -> (usize, &[u8]) {
        (self.base, &self.new)
    }
}

/// An object with a name in front, where there is one.
pub(crate) fn named(name: &str, entry: Value) -> Value {
    let mut object = Map::new();
    if !name.is_empty() {
        object.insert("name".into(), name.into());
    }
    if let Value::Object(entry) = entry {
        object.extend(entry);
    }
    Value::Object(object)
}

fn floats(numbers: &[f64]) -> Result<Vec<u8>> {
    let mut bytes = Vec::with_capacity(numbers.len() * 4);
    for &number in numbers {
        let single = number as f32;
        if !single.is_finite() {
            return Err(Error::file(format!("{number} was to be written, which 32 bits cannot hold")));
        }
        bytes.extend(single.to_le_bytes());
    }
    Ok(bytes)
}

/// Least and greatest of what is written, which is rounded to 32 bits.
fn bounds(accessor: &mut Value, rows: &[[f64; 3]]) {
    for (key, pick) in [("min", f32::min as fn(f32, f32) -> f32), ("max", f32::max)] {
        let bound: Vec<f64> = (0..3)
            .filter_map(|k| rows.iter().map(|row| row[k] as f32).reduce(pick))
            // 0 without a sign.
            .map(|bound| f64::from(bound) + 0.0)
            .collect();
        accessor[key] = json!(bound);
    }
}
