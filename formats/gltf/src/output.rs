//! An edited file as bytes, with the files that belong beside it.

use std::fs;
use std::io::Write;
use std::path::Path;

use percent_encoding::{AsciiSet, NON_ALPHANUMERIC, utf8_percent_encode};
use serde_json::{Value, json};

use crate::buffers::{self, file_name, is_data};
use crate::container::{Form, glb};
use crate::edit::Edit;
use crate::error::{Error, Result};
use crate::text;

/// What stays as it is in a URI.
const PLAIN: &AsciiSet = &NON_ALPHANUMERIC.remove(b'-').remove(b'_').remove(b'.').remove(b'~');

/// A file as it will be written.
#[derive(Clone, Debug)]
pub struct Output {
    /// The bytes of the file.
    pub file: Vec<u8>,
    /// Files beside it, by their relative paths: buffers and images.
    pub beside: Vec<(String, Vec<u8>)>,
}

impl Edit<'_> {
    /// The file with its additions. `stem` is its name without the ending: a buffer of its own is called after it.
    ///
    /// A GLB file has everything within: buffers and images that were files become part of it. A JSON text keeps the relative
    /// paths of its files, which [`Output::save`] puts beside it; those that lead out of its folder become part of it.
    ///
    /// # Errors
    /// Where a file that the document names cannot be read, or a GLB file were above 4 GiB.
    pub fn output(&self, stem: &str) -> Result<Output> {
        let document = self.document();
        let mut json = self.json().clone();
        let mut beside = Vec::new();
        let (base, new) = self.data();
        let mut binary = None;
        let as_glb = self.form() == Form::Glb;
        let old_chunk = document.binary_chunk().filter(|_| document.has_chunk_buffer());

        // The buffer with the new data.
        let home = self.home();
        let moves = (old_chunk.is_some() != as_glb) && home == 0 && document.count("buffers")? > 0;
        if !new.is_empty() || moves {
            let mut bytes = match old_chunk {
                Some(chunk) => chunk.to_vec(),
                None if home < document.count("buffers")? => document.buffer(home)?.to_vec(),
                None => Vec::new(),
            };
            if !new.is_empty() {
                bytes.resize(base, 0);
                bytes.extend(new);
            }
            let buffers = json.as_object_mut().map(|root| root.entry("buffers").or_insert_with(|| json!([])));
            let buffers =
                buffers.and_then(Value::as_array_mut).ok_or_else(|| Error::json("/buffers", "is no array"))?;
            if home == buffers.len() {
                buffers.push(json!({}));
            }
            let buffer = buffers[home].as_object_mut().ok_or_else(|| Error::json("/buffers/0", "is no object"))?;
            if !new.is_empty() {
                buffer.insert("byteLength".into(), bytes.len().into());
            }
            if as_glb {
                buffer.shift_remove("uri");
                binary = Some(bytes);
            } else {
                let name = format!("{stem}{}.bin", if home == 0 { "" } else { "-more" });
                buffer.insert("uri".into(), utf8_percent_encode(&name, PLAIN).to_string().into());
                beside.push((name, bytes));
            }
        } else if let Some(chunk) = document.binary_chunk().filter(|_| as_glb) {
            binary = Some(chunk.to_vec());
        }

        for list in ["buffers", "images"] {
            self.files(&mut json, list, &mut beside)?;
        }
        let others = if document.form() == Form::Glb && as_glb { document.other_chunks() } else { &[] };
        let text = text::update(document.json_text(), document.json(), &json);
        let file = if as_glb {
            // A file in which nothing has changed keeps its padding as well.
            let text = if json == *document.json() { &text } else { text.trim_end() };
            glb(text.trim_start_matches('\u{FEFF}').as_bytes(), binary.as_deref(), others)?
        } else {
            text.into_bytes()
        };
        Ok(Output { file, beside })
    }

    /// Takes the files that a list of `json` names into the output.
    fn files(&self, json: &mut Value, list: &str, beside: &mut Vec<(String, Vec<u8>)>) -> Result<()> {
        let document = self.document();
        for (index, at) in document.root().list_of(list)?.iter().enumerate() {
            let Some(uri) = at.get("uri") else { continue };
            let text = uri.text()?;
            // Of what has been changed since, the new URI counts.
            let kept = json.pointer(&uri.path).and_then(Value::as_str) == Some(text);
            if is_data(text) || !kept {
                continue;
            }
            let bytes = match list {
                "buffers" => document.buffer(index)?.to_vec(),
                _ => document.resolve(&uri)?.1,
            };
            let name = file_name(text).map_err(|reason| uri.error(reason))?;
            let leaves = name.split(['/', '\\']).any(|part| part == "..");
            if self.form() == Form::Gltf && !leaves {
                if !beside.iter().any(|(other, _)| *other == name) {
                    beside.push((name, bytes));
                }
                continue;
            }
            let media = match list {
                "buffers" => "application/octet-stream",
                _ => at.get("mimeType").and_then(|media| media.value.as_str()).unwrap_or_else(|| image_type(&bytes)),
            };
            if let Some(place) = json.pointer_mut(&uri.path) {
                *place = buffers::to_data(media, &bytes).into();
            }
        }
        Ok(())
    }
}

/// The media type of an image by its first bytes.
pub(crate) fn image_type(bytes: &[u8]) -> &'static str {
    match bytes {
        [0xFF, 0xD8, ..] => "image/jpeg",
        [b'R', b'I', b'F', b'F', _, _, _, _, b'W', b'E', b'B', b'P', ..] => "image/webp",
        [0xAB, b'K', b'T', b'X', ..] => "image/ktx2",
        _ => "image/png",
    }
}

impl Output {
    /// Writes the files beside it, and then the file itself, each whole or not at all. A file that is there with the same
    /// bytes is left alone.
    ///
    /// # Errors
    /// Where one cannot be written, or another file lies where a buffer or an image is to go.
    pub fn save(&self, path: &Path) -> Result<()> {
        let folder = path.parent().unwrap_or(Path::new(""));
        let failed = |path: &Path, reason: &dyn std::fmt::Display| {
            Error::file(format!("cannot be written: {reason}")).in_file(path.display().to_string())
        };
        let mut open = Vec::new();
        for (name, bytes) in &self.beside {
            let own = folder.join(name);
            match fs::read(&own) {
                Ok(there) if there == *bytes => {}
                Ok(_) if !name.ends_with(".bin") => {
                    return Err(failed(&own, &"another file of that name is there; write to another folder"));
                }
                _ => open.push((own, bytes)),
            }
        }
        for (own, bytes) in open {
            own.parent().map_or(Ok(()), fs::create_dir_all).map_err(|reason| failed(&own, &reason))?;
            replace(&own, bytes).map_err(|reason| failed(&own, &reason))?;
        }
        replace(path, &self.file).map_err(|reason| failed(path, &reason))
    }
}

/// Writes a file beside the one that it is to be, then puts it there: it appears whole or not at all.
///
/// # Errors
/// Where it cannot be written or moved; what was there stays then.
pub fn replace(path: &Path, bytes: &[u8]) -> std::io::Result<()> {
    let mut name = path.file_name().unwrap_or_default().to_owned();
    name.push(format!(".{}.new", std::process::id()));
    let new = path.with_file_name(name);
    let written = fs::File::create(&new).and_then(|mut file| {
        file.write_all(bytes)?;
        file.sync_all()
    });
    let moved = written.and_then(|()| fs::rename(&new, path));
    if moved.is_err() {
        // That it cannot be removed is not what has gone wrong.
        let _ = fs::remove_file(&new);
    }
    moved
}
