//! The container: a GLB file's header and chunks, or a bare JSON text.

use std::ops::Range;

use crate::error::{Error, Result};

/// Form of a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// One binary file, `.glb` or `.vrm`.
    Glb,
    /// A JSON text, `.gltf`, with its buffers beside it or as text within.
    Gltf,
}

/// Where in the bytes of a file the parts lie.
#[derive(Clone, Debug)]
pub(crate) struct Layout {
    pub form: Form,
    pub json: Range<usize>,
    /// The chunk of binary data.
    pub binary: Option<Range<usize>>,
    /// Chunks after these, headers included: not known here, and kept.
    pub others: Range<usize>,
}

const MAGIC: &[u8] = b"glTF";
const JSON: u32 = 0x4E4F_534A;
const BINARY: u32 = 0x004E_4942;

fn word(bytes: &[u8], at: usize) -> Option<u32> {
    let word = bytes.get(at..at.checked_add(4)?)?;
    Some(u32::from_le_bytes(word.try_into().ok()?))
}

/// Finds the parts of a file.
pub(crate) fn layout(bytes: &[u8]) -> Result<Layout> {
    if !bytes.starts_with(MAGIC) {
        let first = bytes.iter().find(|b| !b.is_ascii_whitespace() && !b"\xEF\xBB\xBF".contains(b));
        if first != Some(&b'{') {
            return Err(Error::byte(0, "neither a GLB file (which begins with 'glTF') nor a JSON text (with '{')"));
        }
        let start = if bytes.starts_with(b"\xEF\xBB\xBF") { 3 } else { 0 };
        let json = start..bytes.len();
        return Ok(Layout { form: Form::Gltf, json, binary: None, others: bytes.len()..bytes.len() });
    }
    let header = |at: usize| {
        word(bytes, at).ok_or_else(|| Error::byte(bytes.len(), "the file ends within its header of 12 bytes"))
    };
    let (version, length) = (header(4)?, header(8)? as usize);
    if version != 2 {
        let what = if version == 1 { " (glTF 1.0); export it again as glTF 2.0" } else { "; this reads version 2" };
        return Err(Error::byte(4, format!("the container's version is {version}{what}")));
    }
    if length != bytes.len() {
        let said = format!("the header says {length} bytes, but the file has {}", bytes.len());
        return Err(Error::byte(8, said + if length > bytes.len() { ": it is cut off" } else { "" }));
    }
    let chunk = |at: usize| -> Result<(u32, Range<usize>)> {
        let (Some(length), Some(kind)) = (word(bytes, at), word(bytes, at + 4)) else {
            return Err(Error::byte(at, "the file ends within the header of a chunk"));
        };
        let (start, left) = (at + 8, bytes.len() - at - 8);
        if length as usize > left {
            return Err(Error::byte(at, format!("the chunk says {length} bytes, but {left} are left in the file")));
        }
        Ok((kind, start..start + length as usize))
    };
    let (kind, json) = chunk(12)?;
    if kind != JSON {
        return Err(Error::byte(16, "the first chunk is not the JSON"));
    }
    let mut at = json.end;
    let mut binary = None;
    if at < bytes.len() {
        let (kind, range) = chunk(at)?;
        if kind == BINARY {
            at = range.end;
            binary = Some(range);
        }
    }
    let others = at..bytes.len();
    while at < bytes.len() {
        let (_, range) = chunk(at)?;
        at = range.end;
    }
    Ok(Layout { form: Form::Glb, json, binary, others })
}

/// A GLB file of a JSON text, a binary chunk and further chunks (with their headers). Fails where it were above 4 GiB.
pub(crate) fn glb(json: &[u8], binary: Option<&[u8]>, others: &[u8]) -> Result<Vec<u8>> {
    let padded = |length: usize| length.next_multiple_of(4);
    let length = 12 + 8 + padded(json.len()) + binary.map_or(0, |b| 8 + padded(b.len())) + others.len();
    let size = |n: usize| {
        let size = u32::try_from(n).map(u32::to_le_bytes);
        size.map_err(|_| Error::file(format!("a GLB file can hold 4 GiB, and this has {length} bytes")))
    };
    let mut file = Vec::with_capacity(length);
    file.extend(MAGIC);
    file.extend(2u32.to_le_bytes());
    file.extend(size(length)?);
    file.extend(size(padded(json.len()))?);
    file.extend(JSON.to_le_bytes());
    file.extend(json);
    file.resize(file.len().next_multiple_of(4), b' ');
    if let Some(binary) = binary {
        file.extend(size(padded(binary.len()))?);
        file.extend(BINARY.to_le_bytes());
        file.extend(binary);
        file.resize(file.len().next_multiple_of(4), 0);
    }
    file.extend(others);
    Ok(file)
}
