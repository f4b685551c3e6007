//! Bytes as a glTF, GLB or VRM file: all of it is read, posed, taken over into itself, written and read again.

use bespoke_gltf::{Change, Document, Edit, Error, Form, Import, Instance, Pose, nothing_outside};

/// Poses that are looked at of each animation.
const POSES: usize = 3;

pub fn run(bytes: &[u8]) -> usize {
    let mut read = usize::from(whole(bytes).is_ok());
    // With a header that tells the truth, what comes after it is reached.
    if let Some(mended) = mended(bytes) {
        read += usize::from(whole(&mended).is_ok());
    }
    read
}

/// Does with a file all that can be done.
///
/// # Errors
/// What is wrong with it.
pub fn whole(bytes: &[u8]) -> Result<(), Error> {
    let document = Document::from_bytes(bytes.to_vec(), nothing_outside())?;
    let scene = document.scene()?;
    document.humanoid()?;
    document.materials()?;
    let posed = |instance: &Instance, pose: &Pose| document.posable(&scene, instance)?.positions(pose).map(drop);
    let instances = || scene.characters.iter().flat_map(|character| &character.meshes).chain(&scene.loose);
    for instance in instances() {
        posed(instance, &Pose::rest(&scene.nodes))?;
    }
    for animation in document.animations()? {
        for time in animation.keys().into_iter().take(POSES) {
            let pose = animation.pose(&scene.nodes, time + 0.01)?;
            for instance in instances().take(POSES) {
                posed(instance, &pose)?;
            }
        }
    }
    let mut edit = Edit::new(&document, Form::Glb)?;
    for mesh in 0..document.count("meshes")? {
        Import::new(&document).mesh(&mut edit, mesh, &Change::default())?;
    }
    let written = edit.output("x")?;
    Document::from_bytes(written.file, nothing_outside())?.scene()?;
    Ok(())
}

/// A GLB file with the lengths of file and chunks put right: the first chunk ends with the last brace that closes, the second is
/// the rest. None where it is none.
fn mended(bytes: &[u8]) -> Option<Vec<u8>> {
    let rest = bytes.strip_prefix(b"glTF")?.get(16..)?;
    let end = rest.iter().rposition(|b| *b == b'}')? + 1;
    let mut json = rest[..end].to_vec();
    json.resize(end.next_multiple_of(4), b' ');
    // Its own header, or what is in its place.
    let mut binary = rest.get(json.len() + 8..).unwrap_or_default().to_vec();
    binary.resize(binary.len().next_multiple_of(4), 0);
    let mut file = b"glTF\x02\0\0\0".to_vec();
    file.extend(((28 + json.len() + binary.len()) as u32).to_le_bytes());
    for (kind, chunk) in [(b"JSON", json), (b"BIN\0", binary)] {
        file.extend((chunk.len() as u32).to_le_bytes());
        file.extend(kind);
        file.extend(chunk);
    }
    Some(file)
}
