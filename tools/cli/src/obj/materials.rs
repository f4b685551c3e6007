//! The materials of an OBJ file: colours and textures out of the files that its `mtllib` lines name.

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use bespoke_gltf::Edit;
use serde_json::{Value, json};

/// What is taken of a material.
#[derive(Clone, Debug, PartialEq)]
struct Material {
    /// Red, green, blue.
    colour: [f32; 3],
    /// 1 where nothing shines through.
    opacity: f32,
    /// An image in place of the colour.
    texture: Option<PathBuf>,
}

/// Materials by their names.
#[derive(Debug, Default)]
pub struct Materials {
    known: HashMap<String, Material>,
    images: HashMap<PathBuf, Option<usize>>,
    /// What could not be had, in words.
    pub notes: Vec<String>,
}

impl Materials {
    /// Those that the lines of `text` name, which stands in the file `obj`.
    pub fn of(obj: &Path, text: &str) -> Self {
        let mut materials = Self::default();
        let named = text.lines().filter_map(|line| line.trim().strip_prefix("mtllib ")).map(str::trim);
        for file in named.map(|name| obj.with_file_name(name)) {
            match std::fs::read(&file) {
                Ok(bytes) => materials.parse(&file, &String::from_utf8_lossy(&bytes)),
                Err(why) => materials.note(&file, &format!("it cannot be read ({why}), so materials have names alone")),
            }
        }
        materials
    }

    fn note(&mut self, file: &Path, what: &str) {
        self.notes.push(format!("{}: {what}", file.display()));
    }

    fn parse(&mut self, file: &Path, text: &str) {
        let mut now = String::new();
        for line in text.lines().map(str::trim) {
            let (key, rest) = line.split_once(char::is_whitespace).unwrap_or((line, ""));
            let numbers: Vec<f32> = rest.split_whitespace().map_while(|word| word.parse().ok()).collect();
            let numbers: Vec<f32> =
                numbers.into_iter().map(|x| if x.is_finite() { x.clamp(0.0, 1.0) } else { 1.0 }).collect();
            if key == "newmtl" {
                now = rest.trim().to_string();
                self.known.entry(now.clone()).or_insert(Material { colour: [0.8; 3], opacity: 1.0, texture: None });
                continue;
            }
            let Some(material) = self.known.get_mut(&now) else { continue };
            match (key, &numbers[..]) {
                ("Kd", &[red, green, blue, ..]) => material.colour = [red, green, blue],
                ("d", &[opacity, ..]) => material.opacity = opacity,
                ("Tr", &[transparency, ..]) => material.opacity = 1.0 - transparency,
                ("map_Kd", _) if !rest.trim().is_empty() => {
                    // Options come before the name; with such, it has no blanks.
                    let name = rest.trim();
                    let name =
                        if name.starts_with('-') { name.split_whitespace().last().unwrap_or(name) } else { name };
                    material.texture = Some(file.with_file_name(name.replace('\\', "/")));
                }
                _ => {}
            }
        }
    }

    /// The material `name` as glTF has it, with its image appended to the file.
    ///
    /// # Errors
    /// Where the file becomes too large.
    pub fn entry(&mut self, edit: &mut Edit, name: &str) -> bespoke_gltf::Result<Value> {
        let Some(material) = self.known.get(name).cloned() else { return Ok(json!({ "name": name })) };
        let texture = match &material.texture {
            Some(file) => self.texture(edit, file)?,
            None => None,
        };
        let [red, green, blue] = if texture.is_some() { [1.0; 3] } else { material.colour };
        let mut surface = json!({
            "baseColorFactor": [red, green, blue, material.opacity], "metallicFactor": 0, "roughnessFactor": 1,
        });
        if let Some(texture) = texture {
            surface["baseColorTexture"] = json!({ "index": texture });
        }
        let mut entry = json!({ "name": name, "pbrMetallicRoughness": surface });
        if material.opacity < 1.0 {
            entry["alphaMode"] = "BLEND".into();
        }
        Ok(entry)
    }

    /// The texture with the image of a file; none where it cannot be had, which is noted once.
    fn texture(&mut self, edit: &mut Edit, file: &Path) -> bespoke_gltf::Result<Option<usize>> {
        if let Some(known) = self.images.get(file) {
            return Ok(*known);
        }
        let texture = match std::fs::read(file).map(|bytes| (media(&bytes), bytes)) {
            Ok((Some(media), bytes)) => {
                let view = edit.add_view(&bytes, None, None)?;
                let image = edit.push("images", json!({ "bufferView": view, "mimeType": media }))?;
                Some(edit.push("textures", json!({ "source": image }))?)
            }
            Ok((None, _)) => {
                self.note(file, "it is neither PNG nor JPEG, which glTF takes; the colour is taken in its place");
                None
            }
            Err(why) => {
                self.note(file, &format!("it cannot be read ({why}); the colour is taken in its place"));
                None
            }
        };
        self.images.insert(file.to_path_buf(), texture);
        Ok(texture)
    }
}

/// The media type of an image by its first bytes.
fn media(bytes: &[u8]) -> Option<&'static str> {
    match bytes {
        [0x89, b'P', b'N', b'G', ..] => Some("image/png"),
        [0xFF, 0xD8, ..] => Some("image/jpeg"),
        _ => None,
    }
}
