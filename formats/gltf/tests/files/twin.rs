//! The reader beside another one, which is built on the crate `gltf`.

use std::path::{Path, PathBuf};

use bespoke_gltf::{Character, Document, Instance};
use testing::process::root;

/// All files with the ending `.glb` below a folder.
fn below(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).into_iter().flatten().flatten() {
        let path = entry.path();
        if path.is_dir() {
            below(&path, found);
        } else if path.extension().is_some_and(|ending| ending == "glb") {
            found.push(path);
        }
    }
}

#[track_caller]
fn near(a: &[f64], b: &[f64], what: &str) {
    assert_eq!(a.len(), b.len(), "{what}");
    let size = b.iter().fold(1.0, |size: f64, x| size.max(x.abs()));
    assert!(a.iter().zip(b).all(|(x, y)| (x - y).abs() < 1e-5 * size), "{what}: {a:?} instead of {b:?}");
}

/// Compares what both readers say of a file; how many vertices that were.
fn compare(path: &Path) -> usize {
    let twin = testing::gltf::read(path);
    let scene = Document::open(path).and_then(|document| document.scene()).unwrap_or_else(|error| panic!("{error}"));
    let name = path.display();
    let all = |c: &Character| c.joints.len();
    assert_eq!(scene.characters.iter().map(all).sum::<usize>(), twin.joints.len(), "{name}: joints");
    assert_eq!(scene.characters.len(), 1, "{name}: rigs");
    let rig = &scene.characters[0];
    for (own, other) in rig.joints.iter().zip(&twin.joints) {
        assert_eq!((&own.name, own.parent), (&other.name, other.parent), "{name}");
        let matrix = |m: glam::DAffine3| glam::DMat4::from(m).to_cols_array();
        near(own.bind.as_flattened(), &matrix(other.bind), &format!("{name}: bind of '{}'", own.name));
        near(own.rest.as_flattened(), &matrix(other.rest), &format!("{name}: rest of '{}'", own.name));
    }
    let mut instances: Vec<&Instance> = rig.meshes.iter().chain(&scene.loose).collect();
    assert_eq!(instances.len(), twin.meshes.len(), "{name}: meshes");
    let mut vertices = 0;
    for other in &twin.meshes {
        let k = instances.iter().position(|i| scene.nodes.all[i.node].name == other.node).expect("the same node");
        let own = &instances.remove(k).geometry;
        // The twin joins vertices anew for each primitive, so corners are compared.
        assert_eq!(own.triangles.len(), other.triangles.len(), "{name}: {}", other.node);
        for (a, b) in own.triangles.iter().zip(&other.triangles) {
            for (a, b) in a.iter().zip(b) {
                let (a, b) = (*a as usize, *b as usize);
                near(&own.positions[a], &other.positions[b].to_array(), &format!("{name}: {}", other.node));
                let pairs = |list: &mut Vec<(usize, f64)>| list.sort_by_key(|(joint, _)| *joint);
                let mut x: Vec<(usize, f64)> = own
                    .influences
                    .get(a)
                    .into_iter()
                    .flatten()
                    .map(|&(joint, weight)| (joint as usize, weight))
                    .collect();
                let mut y = other.influences[b].clone();
                pairs(&mut x);
                pairs(&mut y);
                assert!(x.iter().zip(&y).all(|(x, y)| x.0 == y.0 && (x.1 - y.1).abs() < 1e-6), "{name}: {x:?} {y:?}");
                assert_eq!(x.len(), y.len(), "{name}: influences");
            }
        }
        vertices += own.positions.len();
    }
    vertices
}

#[test]
fn real_files_are_read_as_by_another_reader() {
    let mut paths = Vec::new();
    below(&root().join("../shared/rigs"), &mut paths);
    if paths.is_empty() {
        println!("skipped: there are no files in ../shared/rigs");
    }
    for path in paths {
        println!("{}: {} vertices", path.display(), compare(&path));
    }
}
