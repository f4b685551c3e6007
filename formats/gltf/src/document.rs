//! A file in memory: its bytes as they were, its JSON, and the bytes of its buffers.

use std::ops::Range;
use std::path::Path;

use serde_json::Value;

use crate::buffers::{self, Resolver};
use crate::container::{Form, Layout, layout};
use crate::error::{Error, Result};
use crate::json::At;

/// A glTF, GLB or VRM file.
///
/// Opened, it is known to have JSON of glTF 2 and all bytes of its buffers; whatever else is wrong is found when it is read,
/// and is an error that says where.
pub struct Document {
    bytes: Vec<u8>,
    layout: Layout,
    json: Value,
    buffers: Vec<Bytes>,
    resolver: Resolver,
    name: Option<String>,
}

/// The bytes of a buffer.
enum Bytes {
    /// Within the file.
    Chunk(Range<usize>),
    Own(Vec<u8>),
    /// A buffer whose data exists in compressed form only.
    Missing,
}

impl Document {
    /// Opens a file; buffers and images that are files of their own are looked for beside it.
    ///
    /// # Errors
    /// Where a file cannot be read, or is not glTF 2.
    pub fn open(path: &Path) -> Result<Self> {
        let name = path.display().to_string();
        let bytes = std::fs::read(path).map_err(|reason| Error::file(reason.to_string()).in_file(&name))?;
        let resolver = buffers::files_in(path.parent().unwrap_or(Path::new("")));
        let mut document = Self::from_bytes(bytes, resolver).map_err(|error| error.in_file(&name))?;
        document.name = Some(name);
        Ok(document)
    }

    /// Reads the bytes of a file. `resolver` gets the relative URIs in it, see [`files_in`](crate::files_in) and
    /// [`nothing_outside`](crate::nothing_outside).
    ///
    /// # Errors
    /// Where they are not glTF 2, or a buffer is shorter than the file says.
    pub fn from_bytes(bytes: Vec<u8>, resolver: Resolver) -> Result<Self> {
        let mut layout = layout(&bytes)?;
        // Padded by zeros instead of spaces, as some exporters do.
        let zeros = bytes[layout.json.clone()].iter().rev().take_while(|b| **b == 0).count();
        layout.json.end -= zeros;
        let text = &bytes[layout.json.clone()];
        let json: Value = serde_json::from_slice(text).map_err(|reason| {
            let before = text.split_inclusive(|b| *b == b'\n').take(reason.line().saturating_sub(1));
            let at = layout.json.start + before.map(<[u8]>::len).sum::<usize>() + reason.column().saturating_sub(1);
            let message = reason.to_string();
            Error::byte(at, format!("JSON: {}", message.split(" at line ").next().unwrap_or_default()))
        })?;
        let root = At::root(&json);
        if !json.is_object() {
            return Err(root.error("is no object"));
        }
        let version = root.need("asset")?.need("version")?;
        let (wanted, major) = (version.text()?, |v: &str| v.split('.').next() == Some("2"));
        if !major(wanted) {
            return Err(
                version.error(format!("is '{wanted}', and this reads glTF 2; export the file again as glTF 2.0"))
            );
        }
        if let Some(least) = root.need("asset")?.get("minVersion").filter(|least| !least.text().is_ok_and(major)) {
            return Err(least.error("is above glTF 2, which this reads"));
        }
        let mut document = Self { bytes, layout, json: Value::Null, buffers: Vec::new(), resolver, name: None };
        for (i, buffer) in root.list_of("buffers")?.iter().enumerate() {
            let bytes = document.buffer_bytes(i, buffer)?;
            document.buffers.push(bytes);
        }
        document.json = json;
        Ok(document)
    }

    fn buffer_bytes(&self, index: usize, buffer: &At) -> Result<Bytes> {
        let length = buffer.need("byteLength")?;
        let claimed = length.count()?;
        let (bytes, has) = match buffer.get("uri") {
            Some(uri) => {
                let bytes = self.resolve(&uri)?.1;
                let has = bytes.len();
                (Bytes::Own(bytes), has)
            }
            None => match self.layout.binary.clone().filter(|_| index == 0) {
                Some(range) => (Bytes::Chunk(range.clone()), range.len()),
                // As a fallback for those who cannot read the compressed one.
                None if compression(buffer).is_some() => return Ok(Bytes::Missing),
                None => return Err(buffer.error("has no 'uri', and there is no binary chunk for it")),
            },
        };
        if claimed > has {
            return Err(length.error(format!("is {claimed}, but there are {has} bytes")));
        }
        Ok(bytes)
    }

    /// Media type (of a data URI) and bytes of a URI.
    pub(crate) fn resolve(&self, uri: &At) -> Result<(String, Vec<u8>)> {
        let text = uri.text()?;
        if buffers::is_data(text) {
            return buffers::data(text).map_err(|reason| uri.error(reason));
        }
        (self.resolver)(text).map(|bytes| (String::new(), bytes)).map_err(|reason| uri.error(reason))
    }

    /// The JSON, keys in the order of the file, numbers with their digits.
    #[must_use]
    pub fn json(&self) -> &Value {
        &self.json
    }

    /// The text of the JSON, as it stands in the file.
    #[must_use]
    pub fn json_text(&self) -> &str {
        std::str::from_utf8(&self.bytes[self.layout.json.clone()]).unwrap_or_default()
    }

    /// The file, byte by byte.
    #[must_use]
    pub fn bytes(&self) -> &[u8] {
        &self.bytes
    }

    /// Whether this is GLB (VRM too) or a JSON text.
    #[must_use]
    pub fn form(&self) -> Form {
        self.layout.form
    }

    /// The path that it was opened with.
    #[must_use]
    pub fn name(&self) -> Option<&str> {
        self.name.as_deref()
    }

    /// The binary chunk of a GLB file.
    #[must_use]
    pub fn binary_chunk(&self) -> Option<&[u8]> {
        self.layout.binary.clone().map(|range| &self.bytes[range])
    }

    /// The chunks of a GLB file after that, with their headers.
    #[must_use]
    pub fn other_chunks(&self) -> &[u8] {
        &self.bytes[self.layout.others.clone()]
    }

    /// Whether the first buffer is the binary chunk.
    pub(crate) fn has_chunk_buffer(&self) -> bool {
        matches!(self.buffers.first(), Some(Bytes::Chunk(_)))
    }

    /// The bytes of a buffer, as many as there are: the file may say fewer.
    ///
    /// # Errors
    /// Where there is no such buffer, or its data exist in compressed form only.
    pub fn buffer(&self, index: usize) -> Result<&[u8]> {
        match self.buffers.get(index) {
            Some(Bytes::Chunk(range)) => Ok(&self.bytes[range.clone()]),
            Some(Bytes::Own(bytes)) => Ok(bytes),
            Some(Bytes::Missing) => Err(self.entry("buffers", index)?.error("has no data but in compressed form")),
            None => Err(Error::json(
                "/buffers",
                format!("there are {}, and number {index} was asked for", self.buffers.len()),
            )),
        }
    }

    /// How many bytes the file and its buffers have: the measure for what reading it may take.
    #[must_use]
    pub fn size(&self) -> usize {
        let own = |bytes: &Bytes| if let Bytes::Own(bytes) = bytes { bytes.len() } else { 0 };
        self.bytes.len() + self.buffers.iter().map(own).sum::<usize>()
    }

    pub(crate) fn root(&self) -> At<'_> {
        At::root(&self.json)
    }

    /// The object `index` of a list such as "meshes".
    pub(crate) fn entry(&self, list: &str, index: usize) -> Result<At<'_>> {
        let count = self.root().count_of(list)?;
        let missing =
            || Error::json(format!("/{list}"), format!("there are {count}, and number {index} was asked for"));
        self.root().entry(list, index).ok_or_else(missing)
    }

    /// How many entries a list of the file has, such as "meshes".
    ///
    /// # Errors
    /// Where it is no list.
    pub fn count(&self, list: &str) -> Result<usize> {
        self.root().count_of(list)
    }

    /// The bytes of a buffer view.
    ///
    /// # Errors
    /// Where there is no such view, or it leaves its buffer, or is compressed.
    pub fn view_bytes(&self, view: usize) -> Result<&[u8]> {
        self.view(&self.entry("bufferViews", view)?)
    }

    pub(crate) fn view(&self, view: &At) -> Result<&[u8]> {
        let buffer = view.need("buffer")?.index_into("buffers", self.buffers.len())?;
        let bytes = match &self.buffers[buffer] {
            Bytes::Chunk(range) => &self.bytes[range.clone()],
            Bytes::Own(bytes) => bytes,
            Bytes::Missing => return Err(view.error(compressed(compression(view).unwrap_or("an extension")))),
        };
        // The buffer ends where it says so: bytes after that are padding.
        let claimed = self.entry("buffers", buffer)?.need("byteLength")?.count()?;
        let bytes = &bytes[..claimed.min(bytes.len())];
        let (offset, length) = (view.count_of_key("byteOffset", 0)?, view.need("byteLength")?.count()?);
        let end = offset.checked_add(length).filter(|end| *end <= bytes.len()).ok_or_else(|| {
            view.error(format!("{length} bytes from byte {offset} on, but buffer {buffer} has {}", bytes.len()))
        })?;
        Ok(&bytes[offset..end])
    }

    /// Names of the materials; empty where one has none.
    ///
    /// # Errors
    /// Where the materials are no list.
    pub fn materials(&self) -> Result<Vec<String>> {
        Ok(self.root().list_of("materials")?.iter().map(|material| material.text_of("name").to_owned()).collect())
    }
}

/// The extension by which a buffer or a view is compressed.
fn compression(at: &At) -> Option<&'static str> {
    ["EXT_meshopt_compression", "KHR_meshopt_compression"].into_iter().find(|name| at.extension(name).is_some())
}

/// What is said of compressed data.
pub(crate) fn compressed(extension: &str) -> String {
    format!(
        "is compressed by {extension}, which this does not read; export it without compression of meshes (in Blender's \
         exporter, switch off Compression)"
    )
}
