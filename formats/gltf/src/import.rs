//! Takes meshes and materials of one file into another: every index is put right, everything else is kept.

use std::collections::HashMap;

use serde_json::{Map, Value, json};

use crate::document::Document;
use crate::edit::{Edit, INDICES, VERTICES};
use crate::error::{Error, Result};
use crate::json::At;
use crate::mesh::Mesh;
use crate::output::image_type;
use crate::reader::Reader;

/// What a morph target adds: vertices that it moves, in order, with how far.
pub type Deltas = Vec<(u32, [f64; 3])>;

/// The attributes of a primitive, and its morph targets.
type Vertices = (Map<String, Value>, Vec<Value>);

/// What of a mesh is new; what is none is taken over as it is. Lists are by the vertices of [`Document::mesh`].
#[derive(Clone, Copy, Debug, Default)]
pub struct Change<'a> {
    /// Positions.
    pub positions: Option<&'a [[f64; 3]]>,
    /// Normals of length 1.
    pub normals: Option<&'a [[f64; 3]]>,
    /// Tangents of length 1, with the sign of the bitangent.
    pub tangents: Option<&'a [[f64; 4]]>,
    /// Joints (places in the list of the skin that the mesh will have) and weights; empty takes them off the mesh.
    pub influences: Option<&'a [Vec<(u32, f64)>]>,
    /// For each morph target what it adds to the positions.
    pub morphs: Option<&'a [Deltas]>,
    /// Turns the triangles around: for positions that are written in a space that mirrors the mesh's own.
    pub turned: bool,
}

/// Takes entries of `source` into a file that is edited; each once.
pub struct Import<'s> {
    source: &'s Document,
    known: HashMap<(&'static str, usize), usize>,
    /// What could not be taken over, in sentences.
    pub notes: Vec<String>,
}

/// Extensions of a primitive that hold its vertices in another form, or indices of lists that are not taken over.
const LEFT_OUT: [&str; 3] = ["KHR_draco_mesh_compression", "EXT_mesh_gpu_instancing", "KHR_materials_variants"];

impl<'s> Import<'s> {
    /// Begins to take over from a file.
    #[must_use]
    pub fn new(source: &'s Document) -> Self {
        Self { source, known: HashMap::new(), notes: Vec::new() }
    }

    fn entry(&self, list: &str, index: usize) -> Result<(At<'s>, Map<String, Value>)> {
        let at = self.source.entry(list, index)?;
        let object = at.value.as_object().cloned().ok_or_else(|| at.error("is no object"))?;
        Ok((at, object))
    }

    /// Takes over an entry with `make`, or finds what it became before.
    fn once(
        &mut self,
        list: &'static str,
        index: usize,
        edit: &mut Edit,
        make: impl FnOnce(&mut Self, &mut Edit) -> Result<Value>,
    ) -> Result<usize> {
        if let Some(known) = self.known.get(&(list, index)) {
            return Ok(*known);
        }
        let entry = make(self, edit)?;
        self.extensions(&entry, edit)?;
        let new = edit.push(list, entry)?;
        self.known.insert((list, index), new);
        Ok(new)
    }

    /// Notes the extensions that an entry uses.
    fn extensions(&self, entry: &Value, edit: &mut Edit) -> Result<()> {
        let required = self.source.json().get("extensionsRequired").and_then(Value::as_array);
        let mut open = vec![entry];
        while let Some(value) = open.pop() {
            if let Some(extensions) = value.get("extensions").and_then(Value::as_object) {
                for name in extensions.keys() {
                    edit.use_extension(name, required.is_some_and(|list| list.contains(&name.as_str().into())))?;
                }
            }
            match value {
                // What is in extras is the user's own, and means nothing here.
                Value::Object(object) => open.extend(object.iter().filter(|(key, _)| *key != "extras").map(|(_, v)| v)),
                Value::Array(list) => open.extend(list),
                _ => {}
            }
        }
        Ok(())
    }

    /// Takes over an image with its bytes, into the binary data of the file.
    ///
    /// # Errors
    /// Where there is no such image, or its bytes cannot be read.
    pub fn image(&mut self, edit: &mut Edit, index: usize) -> Result<usize> {
        self.once("images", index, edit, |own, edit| {
            let (at, mut image) = own.entry("images", index)?;
            let bytes = match (at.get("bufferView"), at.get("uri")) {
                (Some(view), _) => own.source.view_bytes(view.count()?)?.to_vec(),
                (None, Some(uri)) => own.source.resolve(&uri)?.1,
                (None, None) => return Err(at.error("has neither 'uri' nor 'bufferView'")),
            };
            image.shift_remove("uri");
            image.insert("bufferView".into(), edit.add_view(&bytes, None, None)?.into());
            if !image.contains_key("mimeType") {
                image.insert("mimeType".into(), image_type(&bytes).into());
            }
            Ok(image.into())
        })
    }

    fn sampler(&mut self, edit: &mut Edit, index: usize) -> Result<usize> {
        self.once("samplers", index, edit, |own, _| Ok(own.entry("samplers", index)?.1.into()))
    }

    /// Takes over a texture with its image and sampler; images that extensions name instead (WebP, KTX2) as well.
    ///
    /// # Errors
    /// Where there is no such texture, or an image cannot be read.
    pub fn texture(&mut self, edit: &mut Edit, index: usize) -> Result<usize> {
        self.once("textures", index, edit, |own, edit| {
            let (at, mut texture) = own.entry("textures", index)?;
            if let Some(sampler) = at.get("sampler") {
                texture.insert("sampler".into(), own.sampler(edit, sampler.count()?)?.into());
            }
            if let Some(image) = at.get("source") {
                texture.insert("source".into(), own.image(edit, image.count()?)?.into());
            }
            for extension in texture.get_mut("extensions").and_then(Value::as_object_mut).into_iter().flatten() {
                let (name, value) = extension;
                if let Some(image) = at.extension(name).and_then(|extension| extension.get("source")) {
                    value["source"] = own.image(edit, image.count()?)?.into();
                }
            }
            Ok(texture.into())
        })
    }

    /// Takes over a material with its textures, also those of its extensions. Where both files are VRM 0, which keeps a list
    /// beside the materials, what it says goes along.
    ///
    /// # Errors
    /// Where there is no such material, or a texture cannot be read.
    pub fn material(&mut self, edit: &mut Edit, index: usize) -> Result<usize> {
        if let Some(known) = self.known.get(&("materials", index)) {
            return Ok(*known);
        }
        let new = self.once("materials", index, edit, |own, edit| {
            let (at, material) = own.entry("materials", index)?;
            let mut material = Value::Object(material);
            own.textures(edit, &at, &mut material)?;
            Ok(material)
        })?;
        self.vrm_zero_material(edit, index, new)?;
        Ok(new)
    }

    /// Puts the textures right that a part of a material names. By glTF and by all extensions that are known, the key of
    /// such an object ends with "Texture", and its `index` is the texture.
    fn textures(&mut self, edit: &mut Edit, at: &At, part: &mut Value) -> Result<()> {
        let Some(object) = part.as_object_mut() else { return Ok(()) };
        for (key, value) in object.iter_mut().filter(|(key, _)| *key != "extras") {
            let Some(at) = at.get(key) else { continue };
            if key.ends_with("Texture")
                && value.is_object()
                && let Some(index) = at.get("index")
            {
                value["index"] = self.texture(edit, index.count()?)?.into();
            }
            self.textures(edit, &at, value)?;
        }
        Ok(())
    }

    fn vrm_zero_material(&mut self, edit: &mut Edit, old: usize, new: usize) -> Result<()> {
        let list = "/extensions/VRM/materialProperties";
        let count = edit.json().pointer(list).and_then(Value::as_array).map(Vec::len);
        // The list is beside that of the materials, or it is broken already.
        if count != Some(new) {
            return Ok(());
        }
        let source = self.source.root();
        let properties = source.extension("VRM").and_then(|vrm| vrm.entry("materialProperties", old));
        let entry = match properties {
            Some(at) => {
                let mut entry = at.value.clone();
                for (name, texture) in
                    entry.get_mut("textureProperties").and_then(Value::as_object_mut).into_iter().flatten()
                {
                    let at = at.need("textureProperties")?.need(name)?;
                    *texture = self.texture(edit, at.count()?)?.into();
                }
                entry
            }
            None => json!({
                "name": edit.json()["materials"][new].get("name").cloned().unwrap_or_else(|| "".into()),
                "shader": "VRM_USE_GLTFSHADER", "renderQueue": 2000, "floatProperties": {}, "vectorProperties": {},
                "textureProperties": {}, "keywordMap": {}, "tagMap": {},
            }),
        };
        if let Some(list) = edit.json_mut().pointer_mut(list).and_then(Value::as_array_mut) {
            list.push(entry);
        }
        Ok(())
    }

    /// Takes over an accessor with its data as they are held; only the space between elements may become another.
    /// `target` is [`VERTICES`](crate::VERTICES) or [`INDICES`](crate::INDICES), or none.
    ///
    /// # Errors
    /// Where it leaves its data.
    pub fn accessor(&mut self, edit: &mut Edit, index: usize, target: Option<u32>) -> Result<usize> {
        self.once("accessors", index, edit, |own, edit| {
            let (at, mut entry) = own.entry("accessors", index)?;
            let accessor = Reader::new(own.source).accessor(index)?;
            entry.shift_remove("byteOffset");
            entry.shift_remove("bufferView");
            let stride = match target {
                // Vertices begin at multiples of four bytes.
                Some(VERTICES) => accessor.element.next_multiple_of(4),
                _ => accessor.element,
            };
            if let Some((indices, kind, values)) = accessor.sparse_alone() {
                let mut sparse = at.need("sparse")?.value.clone();
                let many = indices.len();
                let indices: Vec<u8> =
                    indices.iter().flat_map(|k| (*k as u32).to_le_bytes()[..kind.size()].to_vec()).collect();
                for (part, bytes) in
                    [("indices", &indices[..]), ("values", &values[..(many * accessor.element).min(values.len())])]
                {
                    let view = edit.add_view(bytes, None, None)?;
                    let part =
                        sparse[part].as_object_mut().ok_or_else(|| at.error("has a sparse part that is no object"))?;
                    part.shift_remove("byteOffset");
                    part.insert("bufferView".into(), view.into());
                }
                entry.insert("sparse".into(), sparse);
            } else if accessor.has_data() {
                // Sparse elements are in their places now.
                entry.shift_remove("sparse");
                let bytes = accessor.packed(stride);
                let written = (target == Some(VERTICES) && stride != accessor.element).then_some(stride);
                entry.insert("bufferView".into(), edit.add_view(&bytes, target, written)?.into());
            }
            Ok(entry.into())
        })
    }

    /// Takes over a mesh with its materials, UVs, colours, attributes of its own and morph targets, and with the `change`;
    /// its index in the file that is edited. Primitives without positions are left out, as [`Document::mesh`] does.
    ///
    /// # Errors
    /// Where the mesh cannot be read, or a list of the change has not one entry a vertex.
    pub fn mesh(&mut self, edit: &mut Edit, index: usize, change: &Change) -> Result<usize> {
        let mesh = self.source.mesh(index)?;
        let (at, mut entry) = self.entry("meshes", index)?;
        check(&at, &mesh, change)?;
        let mut primitives = Vec::new();
        // Vertices that primitives share are written once.
        let mut written: HashMap<(usize, usize), Vertices> = HashMap::new();
        for primitive in &mesh.primitives {
            let at = at.need("primitives")?.list()?.nth(primitive.index);
            let at = at.ok_or_else(|| Error::file("a primitive that was read is there no more"))?;
            let mut new = at.value.as_object().cloned().unwrap_or_default();
            let range = (primitive.vertices.start, primitive.vertices.end);
            let (attributes, targets) = match written.get(&range) {
                Some(known) => known.clone(),
                None => {
                    let vertices =
                        self.vertices(edit, &at, primitive.vertices.clone(), primitive.attributes.as_slice(), change)?;
                    written.insert(range, vertices.clone());
                    vertices
                }
            };
            new.insert("attributes".into(), attributes.into());
            if !targets.is_empty() {
                new.insert("targets".into(), targets.into());
            }
            let indices = if change.turned {
                let base = range.0 as u32;
                let turned =
                    mesh.triangles[primitive.triangles.clone()].iter().map(|[a, b, c]| [a - base, c - base, b - base]);
                let turned: Vec<[u32; 3]> = turned.collect();
                new.shift_remove("mode");
                if turned.is_empty() { None } else { Some(edit.add_triangles(&turned)?) }
            } else {
                primitive.indices.map(|accessor| self.accessor(edit, accessor, Some(INDICES))).transpose()?
            };
            match indices {
                Some(indices) => drop(new.insert("indices".into(), indices.into())),
                None => drop(new.shift_remove("indices")),
            }
            if let Some(material) = primitive.material {
                new.insert("material".into(), self.material(edit, material)?.into());
            }
            self.primitive_extensions(&at, &mut new);
            primitives.push(Value::Object(new));
        }
        if primitives.is_empty() {
            return Err(at.error("has no triangles"));
        }
        entry.insert("primitives".into(), primitives.into());
        let entry = Value::Object(entry);
        self.extensions(&entry, edit)?;
        self.quantised(edit)?;
        edit.push("meshes", entry)
    }

    /// Small numbers as positions need an extension that no object names.
    fn quantised(&self, edit: &mut Edit) -> Result<()> {
        let used = |list: &str| {
            let list = self.source.json().get(list).and_then(Value::as_array);
            list.is_some_and(|list| list.contains(&"KHR_mesh_quantization".into()))
        };
        if used("extensionsUsed") {
            edit.use_extension("KHR_mesh_quantization", used("extensionsRequired"))
        } else {
            Ok(())
        }
    }

    fn primitive_extensions(&mut self, at: &At, new: &mut Map<String, Value>) {
        let Some(extensions) = new.get_mut("extensions").and_then(Value::as_object_mut) else { return };
        for name in LEFT_OUT {
            if extensions.shift_remove(name).is_some() && name == "KHR_materials_variants" {
                self.notes.push(format!("{}: its material variants were left out", at.path));
            }
        }
        if extensions.is_empty() {
            new.shift_remove("extensions");
        }
    }

    /// The attributes and targets of a primitive.
    fn vertices(
        &mut self,
        edit: &mut Edit,
        at: &At,
        range: std::ops::Range<usize>,
        attributes: &[(String, usize)],
        change: &Change,
    ) -> Result<Vertices> {
        let mut new = Map::new();
        for (name, accessor) in attributes {
            let accessor = match name.as_str() {
                "POSITION" => change.positions.map(|all| edit.add_positions(&all[range.clone()])),
                "NORMAL" => change.normals.map(|all| edit.add_attribute(&all[range.clone()])),
                "TANGENT" => change.tangents.map(|all| edit.add_attribute(&all[range.clone()])),
                name if name.starts_with("JOINTS_") || name.starts_with("WEIGHTS_") => match change.influences {
                    Some(_) => continue,
                    None => None,
                },
                _ => None,
            }
            .unwrap_or_else(|| self.accessor(edit, *accessor, Some(VERTICES)))?;
            new.insert(name.clone(), accessor.into());
        }
        if let Some(normals) = change.normals.filter(|_| !new.contains_key("NORMAL")) {
            new.insert("NORMAL".into(), edit.add_attribute(&normals[range.clone()])?.into());
        }
        if let Some(influences) = change.influences.filter(|all| !all.is_empty()) {
            for (set, (joints, weights)) in edit.add_influences(&influences[range.clone()])?.into_iter().enumerate() {
                new.insert(format!("JOINTS_{set}"), joints.into());
                new.insert(format!("WEIGHTS_{set}"), weights.into());
            }
        }
        let mut targets = Vec::new();
        for (k, target) in at.list_of("targets")?.iter().enumerate() {
            let mut new = Map::new();
            for name in target.value.as_object().into_iter().flat_map(Map::keys) {
                let moved = change.morphs.and_then(|all| all.get(k)).filter(|_| name == "POSITION");
                let accessor = match moved {
                    Some(deltas) => {
                        let base = range.start as u32;
                        let own = deltas.iter().filter(|(v, _)| range.contains(&(*v as usize)));
                        let own: Vec<(u32, [f64; 3])> = own.map(|(v, delta)| (v - base, *delta)).collect();
                        edit.add_deltas(range.len(), &own)?
                    }
                    None => self.accessor(edit, target.need(name)?.count()?, Some(VERTICES))?,
                };
                new.insert(name.clone(), accessor.into());
            }
            targets.push(Value::Object(new));
        }
        Ok((new, targets))
    }
}

/// Whether the lists of a change are as long as they must be.
fn check(at: &At, mesh: &Mesh, change: &Change) -> Result<()> {
    let vertices = mesh.positions.len();
    let lists = [
        ("positions", change.positions.map(<[_]>::len)),
        ("normals", change.normals.map(<[_]>::len)),
        ("tangents", change.tangents.map(<[_]>::len)),
        ("influences", change.influences.map(<[_]>::len).filter(|n| *n > 0)),
    ];
    for (what, count) in lists {
        if let Some(count) = count.filter(|count| *count != vertices) {
            return Err(at.error(format!("{count} new {what} for {vertices} vertices")));
        }
    }
    if let Some(morphs) = change.morphs.filter(|morphs| morphs.len() != mesh.morphs.len()) {
        return Err(at.error(format!("{} new morph targets for {}", morphs.len(), mesh.morphs.len())));
    }
    Ok(())
}
