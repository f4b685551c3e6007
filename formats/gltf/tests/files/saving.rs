//! Results on disk: whole or not at all, with the files that lie beside them.

use std::fs;
use std::path::{Path, PathBuf};

use bespoke_gltf::{Document, Edit, Form};

use crate::everything::{everything, open};

/// A folder of its own, empty.
fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("saving").join(name);
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).expect("a folder");
    folder
}

fn names(folder: &Path) -> Vec<String> {
    let mut names: Vec<String> = fs::read_dir(folder)
        .expect("a folder")
        .map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned())
        .collect();
    names.sort();
    names
}

#[test]
fn a_file_and_what_lies_beside_it_are_written() {
    let folder = folder("beside");
    let document = open(&everything());
    let output = |form| Edit::new(&document, form).and_then(|edit| edit.output("all")).expect("a file");
    output(Form::Glb).save(&folder.join("all.glb")).expect("it can be written");
    assert!(fs::read(folder.join("all.glb")).expect("the file") == everything());
    output(Form::Gltf).save(&folder.join("all.gltf")).expect("it can be written");
    assert_eq!(names(&folder), ["all.bin", "all.glb", "all.gltf"]);
    let text = Document::open(&folder.join("all.gltf")).expect("a text with a file beside it");
    assert_eq!(text.mesh(0).expect("a mesh").positions, document.mesh(0).expect("a mesh").positions);
    // Once more, over itself; data of another result give way.
    fs::write(folder.join("all.bin"), b"of another result").expect("it can be written");
    output(Form::Gltf).save(&folder.join("all.gltf")).expect("it can be written again");
    assert_eq!(Some(&fs::read(folder.join("all.bin")).expect("data")[..]), document.binary_chunk());
    assert_eq!(names(&folder).len(), 3);
}

#[test]
fn what_cannot_be_written_leaves_all_as_it_was() {
    let folder = folder("failing");
    let document = open(&everything());
    let mut output = Edit::new(&document, Form::Gltf).and_then(|edit| edit.output("all")).expect("a file");
    // No folder to write to.
    let said = output.save(&folder.join("none/all.glb"));
    // The data come first, and make the folder that is theirs; the file follows into it.
    assert!(said.is_ok() && names(&folder.join("none")) == ["all.bin", "all.gltf"].map(|n| n.replace(".gltf", ".glb")));
    // A folder is where the file is to go: what is in it stays, and nothing half-written does.
    let taken = folder.join("taken");
    fs::create_dir_all(taken.join("all.glb/inside")).expect("a folder");
    output.beside.clear();
    let error = output.save(&taken.join("all.glb")).expect_err("a folder is there").to_string();
    assert!(error.contains("all.glb") && error.contains("cannot be written"), "{error}");
    assert_eq!(names(&taken), ["all.glb"]);
    assert_eq!(names(&taken.join("all.glb")), ["inside"]);
    // An image of another character is not overwritten, and then neither is the file.
    let images = folder.join("images");
    fs::create_dir_all(&images).expect("a folder");
    fs::write(images.join("skin.png"), b"another skin").expect("it can be written");
    fs::write(images.join("all.gltf"), b"the result of before").expect("it can be written");
    output.beside.push(("skin.png".into(), b"a skin".to_vec()));
    let error = output.save(&images.join("all.gltf")).expect_err("an image is there").to_string();
    assert!(error.contains("skin.png") && error.contains("another folder"), "{error}");
    assert_eq!(fs::read(images.join("skin.png")).expect("the image"), b"another skin");
    assert_eq!(fs::read(images.join("all.gltf")).expect("the file"), b"the result of before");
    assert_eq!(names(&images), ["all.gltf", "skin.png"]);
}
