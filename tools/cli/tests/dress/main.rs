//! The program on files.

mod animated;
mod batch;
mod farm;
mod files;
mod judges;
mod obj;
mod pages;

use std::path::Path;
use std::process::{Command, Output};
use std::sync::LazyLock;

use bespoke::geometry::mesh::TriangleMesh;
use bespoke::verify::intersections;
use bespoke_gltf::{Document, Instance};
use closet::avatars::Avatar;
use closet::garments;
use closet::rigs::{Body, Character, Naming, character, y_up};
use files::folder;
use glam::DVec3;
use serde_json::Value;
use testing::glb::{Part, glb};

/// The mannequin in a vest, whose joints have the names of Unreal.
static OUTFIT: LazyLock<Vec<u8>> = LazyLock::new(|| {
    let (body, vest) = (&source(), &vest());
    glb(&[
        Part { node: "Mannequin_Body", material: "Skin", mesh: body },
        Part { node: "Mannequin_Vest", material: "Wool", mesh: vest },
    ])
});

/// The slim body, whose joints have the names of Mixamo, turned and in centimetres.
static AVATAR: LazyLock<Vec<u8>> = LazyLock::new(|| {
    let frame = glam::DAffine3::from_scale_rotation_translation(
        DVec3::splat(100.0),
        glam::DQuat::from_rotation_y(std::f64::consts::FRAC_PI_2),
        DVec3::new(30.0, 0.0, -20.0),
    );
    let body = character(&Body::Avatar(Avatar::Slim).model(), Naming::Mixamo).placed(y_up()).placed(frame);
    glb(&[Part { node: "Body", material: "Body", mesh: &body }])
});

fn source() -> Character {
    character(&Body::Mannequin.model(), Naming::Unreal).placed(y_up())
}

fn vest() -> Character {
    let mut mesh = garments::vest(2.5).mesh;
    mesh.positions.iter_mut().for_each(|p| *p = y_up().transform_point3(*p));
    source().wears(&mesh)
}

fn bespoke(folder: &Path, args: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_bespoke")).current_dir(folder).args(args).output().unwrap()
}

#[track_caller]
fn ends(output: &Output, exit: i32) {
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(exit), "{said}");
}

fn mesh(instance: &Instance) -> TriangleMesh {
    TriangleMesh {
        positions: instance.geometry.positions.iter().copied().map(DVec3::from_array).collect(),
        triangles: instance.geometry.triangles.clone(),
    }
}

/// One command: the vest is on the avatar, in its file, on its joints, and the avatar's part of the file is as it was.
#[test]
fn dress() {
    let folder = folder("dress");
    std::fs::write(folder.join("outfit.glb"), &*OUTFIT).unwrap();
    std::fs::write(folder.join("avatar.glb"), &*AVATAR).unwrap();
    let run = bespoke(&folder, &["dress", "outfit.glb", "avatar.glb", "-o", "out.glb", "--json", "report.json"]);
    ends(&run, 0);

    let before = Document::open(&folder.join("avatar.glb")).unwrap();
    let after = Document::open(&folder.join("out.glb")).unwrap();
    let old = before.binary_chunk().unwrap();
    assert_eq!(&after.binary_chunk().unwrap()[..old.len()], old, "the avatar's data have changed");
    for list in ["accessors", "bufferViews", "materials", "meshes", "nodes", "skins"] {
        let (was, is) = (before.json()[list].as_array().unwrap(), after.json()[list].as_array().unwrap());
        assert_eq!(is[..was.len()], was[..], "{list}");
    }
    assert_eq!(after.json()["extras"].to_string(), r#"{"kept":12345678901234567890}"#);

    let scene = after.scene().unwrap();
    assert_eq!(scene.characters.len(), 1);
    let worn = scene.characters[0].meshes.iter().find(|m| m.name == "Mannequin_Vest").expect("the vest is there");
    let body = scene.characters[0].meshes.iter().find(|m| m.name == "Body").expect("the body is there");
    assert_eq!(intersections(&mesh(worn), Some(&mesh(body)), 0).unwrap().count, 0);
    assert_eq!(intersections(&mesh(worn), None, 0).unwrap().count, 0);
    assert!(worn.geometry.influences.iter().all(|row| !row.is_empty() && row.len() <= 4));
    let primitive = &worn.geometry.primitives[0];
    let names: Vec<&str> = primitive.attributes.iter().map(|(name, _)| name.as_str()).collect();
    for name in ["POSITION", "NORMAL", "TEXCOORD_0", "JOINTS_0", "WEIGHTS_0"] {
        assert!(names.contains(&name), "{name} is not among {names:?}");
    }
    assert_eq!(after.materials().unwrap()[primitive.material.unwrap()], "Wool");
    // The texture coordinates are those of the outfit, bit by bit.
    let outfit = Document::open(&folder.join("outfit.glb")).unwrap();
    let texture = |document: &Document, accessor: usize| document.rows::<2>(accessor).unwrap();
    let designed = outfit.scene().unwrap();
    let designed = designed.characters[0].meshes.iter().find(|m| m.name == "Mannequin_Vest").unwrap();
    let of = |instance: &Instance| {
        instance.geometry.primitives[0].attributes.iter().find(|a| a.0 == "TEXCOORD_0").unwrap().1
    };
    assert_eq!(texture(&after, of(worn)), texture(&outfit, of(designed)));

    let report: Value = serde_json::from_slice(&std::fs::read(folder.join("report.json")).unwrap()).unwrap();
    assert_eq!(report["garments"][0]["status"], "dressed");
    assert_eq!(report["garments"][0]["name"], "Mannequin_Vest");
    assert!(report["joint_map"].as_array().unwrap().iter().any(|joint| joint["target"] == "mixamorig:Spine"));

    // What it is now can be looked at with the other commands.
    ends(&bespoke(&folder, &["check", "out.glb"]), 0);
    let inspected = bespoke(&folder, &["inspect", "out.glb", "--json"]);
    ends(&inspected, 0);
    let inspected: Value = serde_json::from_slice(&inspected.stdout).unwrap();
    let kinds: Vec<&str> = inspected["parts"].as_array().unwrap().iter().map(|p| p["kind"].as_str().unwrap()).collect();
    assert_eq!(kinds, ["body", "garment"]);

    // The skeleton and the outfit alone.
    let run = bespoke(&folder, &["dress", "outfit.glb", "avatar.glb", "-o", "alone.glb", "--keep", "outfit", "-q"]);
    ends(&run, 0);
    assert!(run.stderr.is_empty(), "{}", String::from_utf8_lossy(&run.stderr));
    let alone = Document::open(&folder.join("alone.glb")).unwrap().scene().unwrap();
    let names: Vec<&str> = alone.characters[0].meshes.iter().map(|m| m.name.as_str()).collect();
    assert_eq!(names, ["Mannequin_Vest"]);
    judges::valid(&[&folder.join("out.glb"), &folder.join("alone.glb")]);
}

/// What cannot be done is said, and nothing is written.
#[test]
fn refusals() {
    let folder = folder("refusals");
    std::fs::write(folder.join("outfit.glb"), &*OUTFIT).unwrap();
    std::fs::write(folder.join("avatar.glb"), &*AVATAR).unwrap();
    std::fs::write(folder.join("map"), "Hips hips\n").unwrap();
    std::fs::write(folder.join("cut.glb"), &OUTFIT[..OUTFIT.len() / 2]).unwrap();
    std::fs::write(folder.join("empty.glb"), br#"{"asset":{"version":"2.0"}}"#).unwrap();
    let before = std::fs::read_dir(&folder).unwrap().count();
    let out = ["-o", "out.glb"];
    for (args, exit, says) in [
        (&["dress", "outfit.glb", "avatar.glb", "-o", "out.fbx"][..], 2, "has to end in .glb, .vrm or .gltf"),
        (&["dress", "nothing.glb", "avatar.glb", out[0], out[1]], 1, "nothing.glb"),
        (&["dress", "cut.glb", "avatar.glb", out[0], out[1]], 1, "cut.glb"),
        (&["dress", "outfit.glb", "empty.glb", out[0], out[1]], 1, "there is no skin in it"),
        (&["dress", "empty.glb", "avatar.glb", out[0], out[1]], 1, "it has no skin"),
        (&["dress", "avatar.glb", "avatar.glb", out[0], out[1]], 1, "no part is known as a garment"),
        (&["dress", "outfit.glb", "avatar.glb", out[0], out[1], "--nodes", "Coat"], 2, "'Coat' is the name of no part"),
        (&["dress", "outfit.glb", "avatar.glb", out[0], out[1], "--map", "map"], 1, "line 1: 'Hips' is no joint"),
        (&["dress", "outfit.glb", "avatar.glb", out[0], out[1], "--fit=-1"], 1, "fit_weight is -1"),
        (&["check", "avatar.glb"], 1, "no part is known as a garment"),
        (&["inspect", "cut.glb"], 1, "cut.glb"),
        (&["dress", "outfit.glb"], 2, "AVATAR"),
    ] {
        let run = bespoke(&folder, args);
        ends(&run, exit);
        let said = String::from_utf8_lossy(&run.stderr);
        assert!(said.contains(says), "{args:?}: {said}");
        assert!(!said.contains("panicked"), "{args:?}: {said}");
        assert_eq!(std::fs::read_dir(&folder).unwrap().count(), before, "{args:?} wrote something");
    }
}

/// A garment that the body passes through is counted.
#[test]
fn check_counts() {
    let folder = folder("check");
    let (body, vest) = (source(), vest());
    let mut inside = vest.clone();
    inside.mesh.positions.iter_mut().for_each(|p| p.x += 0.05);
    std::fs::write(
        folder.join("through.glb"),
        glb(&[
            Part { node: "Body", material: "Skin", mesh: &body },
            Part { node: "Vest", material: "Wool", mesh: &inside },
            Part { node: "Jacket", material: "Wool", mesh: &vest },
        ]),
    )
    .unwrap();
    let run = bespoke(&folder, &["check", "through.glb", "--json"]);
    ends(&run, 3);
    let counted: Value = serde_json::from_slice(&run.stdout).unwrap();
    let garment = |k: usize, what: &str| counted[0]["garments"][k][what].as_u64().unwrap();
    let mesh = |c: &Character| {
        // The file holds 32-bit numbers.
        let positions = c.mesh.positions.iter().map(|p| p.as_vec3().as_dvec3()).collect();
        TriangleMesh { positions, triangles: c.mesh.triangles.clone() }
    };
    let count = |a: &Character, b: &Character| intersections(&mesh(a), Some(&mesh(b)), 0).unwrap().count;
    assert!(garment(0, "body") > 0);
    assert_eq!(garment(0, "body"), count(&inside, &body));
    assert_eq!(garment(1, "others"), count(&vest, &inside));
}

/// Completions and the manual page name the commands.
#[test]
fn help() {
    let folder = folder("help");
    for args in [&["man"][..], &["completions", "bash"], &["--help"]] {
        let run = bespoke(&folder, args);
        ends(&run, 0);
        let text = String::from_utf8_lossy(&run.stdout);
        for command in ["dress", "inspect", "check"] {
            assert!(text.contains(command), "{args:?} without {command}");
        }
    }
}
