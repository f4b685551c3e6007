//! Files that lie: an error that says where, never a panic.

use bespoke_gltf::{Change, Document, Edit, Form, Import, nothing_outside};
use testing::Random;

use crate::everything::{everything, glb, open};

/// Reads all that can be read, and writes it; what is wrong, if anything is.
fn read(bytes: &[u8]) -> Result<(), bespoke_gltf::Error> {
    let document = Document::from_bytes(bytes.to_vec(), nothing_outside())?;
    document.scene()?;
    let mut edit = Edit::new(&document, Form::Glb)?;
    for mesh in 0..document.count("meshes")? {
        Import::new(&document).mesh(&mut edit, mesh, &Change::default())?;
    }
    let written = edit.output("x")?;
    Document::from_bytes(written.file, nothing_outside())?;
    Ok(())
}

/// The file with a piece of its JSON replaced.
fn with(from: &str, to: &str) -> Vec<u8> {
    let document = open(&everything());
    let text = document.json_text();
    assert!(text.contains(from), "{from} is not in the file");
    glb(&text.replacen(from, to, 1), document.binary_chunk().expect("data"), &[])
}

#[track_caller]
fn refused(bytes: &[u8], words: &[&str]) {
    let message = read(bytes).expect_err("a broken file was read").to_string();
    assert!(words.iter().all(|word| message.contains(word)), "{message}");
}

#[test]
fn an_error_says_where() {
    read(&everything()).unwrap_or_else(|error| panic!("{error}"));
    refused(b"", &["byte 0"]);
    refused(&everything()[..1000], &["byte 8", "cut off"]);
    let mut longer = everything();
    longer[12..16].copy_from_slice(&u32::MAX.to_le_bytes());
    refused(&longer, &["byte 12", "4294967295"]);
    refused(&with("\"scene\": 0", "\"scene\": oh"), &["byte ", "JSON"]);
    refused(&with("\"version\":\"2.0\"", "\"version\":\"1.0\""), &["/asset/version", "1.0"]);
    refused(&with("\"children\": [2]", "\"children\": [0]"), &["/nodes/", "below itself"]);
    refused(&with("\"children\": [2]", "\"children\": [1]"), &["/nodes/1/children/0", "trees"]);
    refused(&with("\"children\": [2]", "\"children\": [99]"), &["/nodes/1/children/0", "99"]);
    refused(&with("[0, 0.5, 0]", "[0, 1e999, 0]"), &["/nodes/1/translation/1"]);
    refused(&with("\"POSITION\": 0", "\"POSITION\": 77"), &["/meshes/0/primitives/0/attributes/POSITION", "77"]);
    refused(&with("\"count\":4,\"type\":\"VEC3\"", "\"count\":4000000000,\"type\":\"VEC3\""), &["/accessors/0"]);
    refused(&with("\"byteLength\": ", "\"byteLength\": 9"), &["/buffers/0/byteLength"]);
    refused(&with("\"joints\": [0, 1, 2]", "\"joints\": [0, 1]"), &["joint 2"]);
    let sparse = "{\"componentType\":5126,\"count\":4,\"type\":\"VEC3\",\"min\":[0,0,0]";
    refused(&with(sparse, &sparse.replace("\":4", "\":4000000000")), &["4000000000"]);
    let draco = "\"indices\": 3, \"material\": 0, \"extensions\": {\"KHR_draco_mesh_compression\": {}}";
    let bytes = with("\"indices\": 3, \"material\": 0", draco);
    let text = open(&bytes).json_text().replacen("{\"bufferView\":0,", "{", 1);
    refused(
        &glb(&text, open(&bytes).binary_chunk().expect("data"), &[]),
        &["KHR_draco_mesh_compression", "without compression"],
    );
    // A vertex that is no number.
    let mut nan = everything();
    let at = nan.windows(4).position(|w| w == (-0.5f32).to_le_bytes()).expect("a position");
    nan[at..at + 4].copy_from_slice(&f32::NAN.to_le_bytes());
    refused(&nan, &["/accessors/0", "NaN"]);
    refused("{".repeat(100_000).as_bytes(), &["byte "]);
}

#[test]
fn any_bytes_are_read_or_refused() {
    let mut random = Random::new(7);
    let original = everything();
    let mut below = |n: usize| ((random.unit() * n as f64) as usize).min(n - 1);
    let json_end = 20 + u32::from_le_bytes([original[12], original[13], original[14], original[15]]) as usize;
    let mut read_at_all = 0;
    for _ in 0..20_000 {
        let mut bytes = original.clone();
        for _ in 0..1 + below(3) {
            // Mostly the digits of the JSON, where the indices, counts and offsets are.
            let at = if below(8) == 0 { below(bytes.len()) } else { 20 + below(json_end - 20) };
            bytes[at] = match bytes[at] {
                digit if digit.is_ascii_digit() => b'0' + below(10) as u8,
                other if below(4) == 0 => other ^ (1 << below(8)),
                _ => b"0123456789-e.,:[]{}\" "[below(21)],
            };
        }
        read_at_all += usize::from(read(&bytes).is_ok());
    }
    assert!(read_at_all > 100, "only {read_at_all} were read");
}
