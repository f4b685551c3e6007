//! Dressed avatars that move: what passes through what is counted in their poses, and other programs move them as they are
//! moved here.

use std::ops::Range;
use std::path::Path;

use bespoke::geometry::mesh::{Topology, TriangleMesh};
use bespoke::input::weld::Weld;
use bespoke::verify::intersections;
use bespoke_gltf::{Document, Edit, Form, Pose, Scene, Vrm, nothing_outside};
use closet::avatars::Avatar;
use closet::garments;
use closet::mesh::Mesh;
use closet::rigs::{Body, Character, Naming, character, y_up};
use glam::{DAffine3, DMat4, DQuat, DVec3};
use serde_json::{Value, json};
use testing::glb::{Part, glb};

use super::files::folder;
use super::{bespoke, ends, judges};

/// Times of the keys, at whole frames of all usual rates.
const KEYS: [f64; 3] = [0.0, 0.5, 1.0];
/// What turns on a straight way, about x of the joint, and by how many degrees at the keys.
const TURNS: [(&str, [f64; 3]); 4] = [
    ("spine", [0.0, 100.0, -70.0]),
    ("leftUpperArm", [0.0, 50.0, -20.0]),
    ("rightLowerArm", [0.0, 70.0, 200.0]),
    ("leftUpperLeg", [0.0, -60.0, 15.0]),
];
/// Nothing that others compute with 32 bits is farther off, in metres.
const NEAR: f64 = 1e-5;

pub fn body() -> Character {
    character(&Body::Mannequin.model(), Naming::Vrm).placed(y_up())
}

pub fn vest() -> Character {
    worn(garments::vest(2.5).mesh)
}

/// A garment that was modelled on the mannequin, in the axes of files.
fn worn(mut mesh: Mesh) -> Character {
    mesh.positions.iter_mut().for_each(|p| *p = y_up().transform_point3(*p));
    body().wears(&mesh)
}

/// A jacket whose hem, neck and cuffs are closed by fans, and the triangles of each fan. Coarser than this its sleeves are modelled
/// shut, but for a slit.
fn closed_jacket() -> (Character, Vec<Range<usize>>) {
    let mut mesh = closet::jacket(2.0).mesh;
    // Welded, so that seams are no borders.
    let (weld, _) = Weld::new(&TriangleMesh { positions: mesh.positions.clone(), triangles: mesh.triangles.clone() });
    let mut fans = Vec::new();
    for border in Topology::new(weld.mesh.positions.len(), &weld.mesh.triangles).loops {
        let corners: Vec<u32> = border.vertices.iter().map(|&w| weld.vertex_of[w as usize]).collect();
        let tip = mesh.positions.len() as u32;
        let sum: DVec3 = corners.iter().map(|&v| mesh.positions[v as usize]).sum();
        mesh.positions.push(sum / corners.len() as f64);
        let next = corners.iter().cycle().skip(1);
        let around = corners
            .iter()
            .zip(next.clone())
            .map(|(&a, &b)| mesh.positions[a as usize].distance(mesh.positions[b as usize]));
        let around: f64 = around.sum();
        assert!(around > 0.1, "an opening {around} m around");
        fans.push(mesh.triangles.len()..mesh.triangles.len() + corners.len());
        mesh.triangles.extend(corners.iter().zip(next).map(|(&a, &b)| [b, a, tip]));
    }
    assert_eq!(fans.len(), 4);
    (worn(mesh), fans)
}

fn open(bytes: &[u8]) -> Document {
    Document::from_bytes(bytes.to_vec(), nothing_outside()).unwrap()
}

fn turn(degrees: f64) -> DQuat {
    DQuat::from_rotation_x(degrees.to_radians())
}

/// The file with an animation `called` so, in which limbs turn on straight ways, the hips go along a spline, and the head is
/// turned at once; as a VRM file, if that is wanted.
pub fn waving(bytes: &[u8], vrm: Option<Vrm>, called: &str) -> Vec<u8> {
    let document = open(bytes);
    let nodes = document.nodes().unwrap();
    let mut edit = Edit::new(&document, Form::Glb).unwrap();
    let floats = |edit: &mut Edit, numbers: &[f64], kind: &str, width: usize| {
        let bytes: Vec<u8> = numbers.iter().flat_map(|&x| (x as f32).to_le_bytes()).collect();
        let view = edit.add_view(&bytes, None, None).unwrap();
        let mut accessor =
            json!({ "bufferView": view, "componentType": 5126, "type": kind, "count": numbers.len() / width });
        if width == 1 {
            accessor["min"] = json!([numbers[0]]);
            accessor["max"] = json!([numbers[numbers.len() - 1]]);
        }
        edit.push("accessors", accessor).unwrap()
    };
    let input = floats(&mut edit, &KEYS, "SCALAR", 1);
    let (mut samplers, mut channels) = (Vec::new(), Vec::new());
    let mut add = |edit: &mut Edit, name: &str, path: &str, kind: &str, values: &dyn Fn(DVec3, DQuat) -> Vec<f64>| {
        let node = nodes.all.iter().position(|node| node.name == name).expect("a joint of that name");
        let local = DAffine3::from_mat4(DMat4::from_cols_array_2d(&nodes.all[node].local_matrix));
        let (scale, rotation, translation) = local.to_scale_rotation_translation();
        // What is animated is no matrix.
        let entry = edit.json_mut()["nodes"][node].as_object_mut().unwrap();
        entry.shift_remove("matrix");
        entry.insert("translation".into(), json!(translation.to_array()));
        entry.insert("rotation".into(), json!(rotation.to_array()));
        entry.insert("scale".into(), json!(scale.to_array()));
        let (shape, width) = if path == "rotation" { ("VEC4", 4) } else { ("VEC3", 3) };
        let output = floats(edit, &values(translation, rotation), shape, width);
        channels.push(json!({ "sampler": samplers.len(), "target": { "node": node, "path": path } }));
        samplers.push(json!({ "input": input, "output": output, "interpolation": kind }));
    };
    for (name, degrees) in TURNS {
        add(&mut edit, name, "rotation", "LINEAR", &|_, rest| {
            degrees.iter().flat_map(|&degrees| (rest * turn(degrees)).to_array()).collect()
        });
    }
    add(&mut edit, "head", "rotation", "STEP", &|_, rest| {
        [0.0, 20.0, -10.0].iter().flat_map(|&degrees| (rest * turn(degrees)).to_array()).collect()
    });
    add(&mut edit, "hips", "translation", "CUBICSPLINE", &|rest, _| {
        let key = |k: usize| {
            let place = rest + DVec3::new(0.1, -0.05, 0.2) * k as f64;
            [DVec3::new(0.3, 0.1, 0.0), place, DVec3::new(-0.2, 0.4, 0.1)]
        };
        (0..3).flat_map(key).flat_map(|v| v.to_array()).collect()
    });
    edit.push("animations", json!({ "name": called, "samplers": samplers, "channels": channels })).unwrap();
    let bones: Vec<(&str, usize)> = nodes
        .all
        .iter()
        .enumerate()
        .filter(|(_, node)| !node.name.is_empty() && node.name != "Root" && node.mesh.is_none())
        .map(|(k, node)| (node.name.as_str(), k))
        .collect();
    match vrm {
        None => {}
        Some(Vrm::One) => {
            let bones: serde_json::Map<String, Value> =
                bones.iter().map(|&(name, node)| (name.to_string(), json!({ "node": node }))).collect();
            edit.json_mut()["extensions"]["VRMC_vrm"] = json!({
                "specVersion": "1.0", "humanoid": { "humanBones": bones },
                "meta": { "name": "one", "authors": ["us"], "licenseUrl": "https://vrm.dev/licenses/1.0/" },
            });
            edit.use_extension("VRMC_vrm", false).unwrap();
        }
        Some(Vrm::Zero) => {
            // The thumb begins otherwise there.
            let of_zero = |name: &str| {
                name.replace("ThumbProximal", "ThumbIntermediate").replace("ThumbMetacarpal", "ThumbProximal")
            };
            let bones: Vec<Value> =
                bones.iter().map(|&(name, node)| json!({ "bone": of_zero(name), "node": node })).collect();
            let material = |material: &Value| {
                json!({ "name": material["name"], "shader": "VRM_USE_GLTFSHADER", "renderQueue": 2000, "floatProperties": {},
                    "vectorProperties": {}, "textureProperties": {}, "keywordMap": {}, "tagMap": {} })
            };
            let materials: Vec<Value> = edit.json()["materials"].as_array().unwrap().iter().map(material).collect();
            edit.json_mut()["extensions"]["VRM"] = json!({
                "specVersion": "0.0", "exporterVersion": "none", "humanoid": { "humanBones": bones },
                "meta": { "title": "zero", "author": "us", "version": "1", "allowedUserName": "Everyone",
                    "licenseName": "CC0" },
                "materialProperties": materials, "firstPerson": {}, "blendShapeMaster": { "blendShapeGroups": [] },
                "secondaryAnimation": { "boneGroups": [], "colliderGroups": [] },
            });
            edit.use_extension("VRM", false).unwrap();
        }
    }
    edit.output("waving").unwrap().file
}

/// Where the vertices of the mesh at the node `name` are when joints turn about their x, by their weights.
fn turned(scene: &Scene, name: &str, turns: &[(&str, f64)], away: DVec3) -> TriangleMesh {
    let character = &scene.characters[0];
    let instance = character.meshes.iter().find(|mesh| mesh.name == name).unwrap();
    let bind = |k: usize| DAffine3::from_mat4(DMat4::from_cols_array_2d(&character.joints[k].bind));
    let mut world: Vec<DAffine3> = Vec::new();
    for (k, joint) in character.joints.iter().enumerate() {
        let mut local = joint.parent.map_or(DAffine3::IDENTITY, |parent| bind(parent).inverse()) * bind(k);
        if let Some((_, degrees)) = turns.iter().find(|(name, _)| *name == joint.name) {
            local *= DAffine3::from_quat(turn(*degrees));
        }
        if joint.name == "hips" {
            local.translation += away;
        }
        world.push(joint.parent.map_or(DAffine3::IDENTITY, |parent| world[parent]) * local);
    }
    let moves: Vec<DAffine3> = world.iter().enumerate().map(|(k, world)| *world * bind(k).inverse()).collect();
    let place = |(p, row): (&[f64; 3], &Vec<(u32, f64)>)| {
        row.iter().map(|&(j, weight)| weight * moves[j as usize].transform_point3(DVec3::from_array(*p))).sum()
    };
    let geometry = &instance.geometry;
    TriangleMesh {
        positions: geometry.positions.iter().zip(&geometry.influences).map(place).collect(),
        triangles: geometry.triangles.clone(),
    }
}

/// What `check` counts at the keys is what there is when limbs are turned by hand.
#[test]
fn check_counts_in_poses() {
    let folder = folder("animated");
    let (body, vest) = (body(), vest());
    let file = waving(
        &glb(&[
            Part { node: "Body", material: "Skin", mesh: &body },
            Part { node: "Vest", material: "Wool", mesh: &vest },
        ]),
        None,
        "wave",
    );
    std::fs::write(folder.join("waving.glb"), &file).unwrap();
    let run = bespoke(&folder, &["check", "waving.glb", "--animation", "wave", "--json"]);
    ends(&run, 3);
    let counted: Value = serde_json::from_slice(&run.stdout).unwrap();
    assert_eq!(counted.as_array().unwrap().len(), 4, "the bind pose and three keys");
    let scene = open(&file).scene().unwrap();
    let count = |a: &TriangleMesh, b: Option<&TriangleMesh>| intersections(a, b, 0).unwrap().count;
    let mut through = 0;
    for (pose, key) in counted.as_array().unwrap()[1..].iter().zip(0..) {
        assert_eq!((pose["animation"].as_str(), pose["time"].as_f64()), (Some("wave"), Some(KEYS[key])));
        let mut turns: Vec<(&str, f64)> = TURNS.iter().map(|(name, degrees)| (*name, degrees[key])).collect();
        turns.push(("head", [0.0, 20.0, -10.0][key]));
        let away = DVec3::new(0.1, -0.05, 0.2) * key as f64;
        let [cloth, under] = ["Vest", "Body"].map(|name| turned(&scene, name, &turns, away));
        let garment = &pose["garments"][0];
        assert_eq!(garment["own"].as_u64().unwrap(), count(&cloth, None), "{pose}");
        assert_eq!(garment["body"].as_u64().unwrap(), count(&cloth, Some(&under)), "{pose}");
        assert!(garment["folds"].as_u64() <= garment["body"].as_u64(), "{pose}");
        through += garment["body"].as_u64().unwrap() + garment["own"].as_u64().unwrap();
    }
    assert!(through > 0, "an arm that is turned so takes no vest along");
    // The bind pose is counted as without an animation.
    let bound: Value = serde_json::from_slice(&bespoke(&folder, &["check", "waving.glb", "--json"]).stdout).unwrap();
    assert_eq!(bound[0], counted[0]);
    assert_eq!(bound[0]["garments"][0]["body"], 0);

    let words = bespoke(&folder, &["check", "waving.glb", "--animation", "--moments", "2"]);
    let words = String::from_utf8_lossy(&words.stdout).to_string();
    assert!(words.contains("wave at 0.000 s: Vest: ") && words.contains("wave at 1.000 s: Vest: "), "{words}");
    assert!(!words.contains("wave at 0.500 s"), "{words}");
    for (args, says) in [
        (["check", "waving.glb", "--animation", "run"], "it has no animation 'run'; its animations: wave"),
        (["check", "waving.glb", "--moments", "2"], "--animation"),
    ] {
        let run = bespoke(&folder, &args);
        let said = String::from_utf8_lossy(&run.stderr);
        assert!(!run.status.success() && said.contains(says), "{said}");
    }
}

/// Triangles that close neck, hem and cuffs are none that the body must not pass through, neither as designed nor in a result, which
/// says which they are.
#[test]
fn caps_are_counted_apart() {
    let folder = folder("caps");
    let (body, (closed, fans)) = (body(), closed_jacket());
    let outfit = glb(&[
        Part { node: "Body", material: "Skin", mesh: &body },
        Part { node: "Jacket", material: "Wool", mesh: &closed },
    ]);
    std::fs::write(folder.join("outfit.glb"), outfit).unwrap();
    let slim = character(&Body::Avatar(Avatar::Slim).model(), Naming::Vrm).placed(y_up());
    std::fs::write(folder.join("avatar.glb"), glb(&[Part { node: "Body", material: "Body", mesh: &slim }])).unwrap();
    ends(&bespoke(&folder, &["dress", "outfit.glb", "avatar.glb", "-o", "out.glb", "-q"]), 0);
    for file in ["outfit.glb", "out.glb"] {
        let run = bespoke(&folder, &["check", file, "--nodes", "Jacket", "--json"]);
        let counted: Value = serde_json::from_slice(&run.stdout).unwrap();
        let garment = &counted[0]["garments"][0];
        assert!(garment["caps"].as_u64().unwrap() > 0, "{file}: {counted}");
        // As designed the body comes through the coarse cloth in places.
        assert!(file == "outfit.glb" || garment["body"] == 0, "{file}: {counted}");
    }
    let document = Document::open(&folder.join("out.glb")).unwrap();
    let meshes = document.json()["meshes"].as_array().unwrap();
    let noted = &meshes[meshes.len() - 1]["primitives"][0]["extras"]["bespoke_caps"];
    let noted: Vec<usize> = serde_json::from_value(noted.clone()).unwrap();
    // Each of them, and a neighbour of the coarse cloth here and there.
    let of = |fan: &Range<usize>| noted.iter().filter(|t| fan.contains(t)).count();
    println!("{noted:?} of {fans:?}");
    assert!(fans.iter().all(|fan| of(fan) == fan.len()), "{noted:?} of {fans:?}");
    let closing: usize = fans.iter().map(of).sum();
    assert!(10 * closing >= 9 * noted.len(), "{noted:?} of {fans:?}");
}

/// The vertices in the poses that another program has found, of primitives or of whole meshes, are where they are by our own
/// posing: how far they are off at most, and how far they have moved from the bind pose.
#[track_caller]
fn compare(file: &Path, animation: &str, moments: &Value, list: &str) -> [f64; 2] {
    let document = Document::open(file).unwrap();
    let scene = document.scene().unwrap();
    let animations = document.animations().unwrap();
    let animation = animations.iter().find(|a| !animation.is_empty() && a.name == animation);
    let instances = || scene.characters.iter().flat_map(|character| &character.meshes).chain(&scene.loose);
    let apart = |(a, b): (&[f64; 3], &[f64; 3])| DVec3::from_array(*a).distance(DVec3::from_array(*b));
    let (mut worst, mut moved): (f64, f64) = (0.0, 0.0);
    for moment in moments.as_array().unwrap() {
        let pose = match animation {
            Some(animation) => animation.pose(&scene.nodes, moment["time"].as_f64().unwrap()).unwrap(),
            None => Pose::rest(&scene.nodes),
        };
        let found = moment[list].as_array().unwrap();
        let mut vertices = 0;
        for instance in instances() {
            let own = document.posable(&scene, instance).unwrap().positions(&pose).unwrap();
            let geometry = &instance.geometry;
            moved = own.iter().zip(&geometry.positions).map(apart).fold(moved, f64::max);
            let is_it = |entry: &&Value| match entry["node"].as_u64() {
                Some(node) => node == instance.node as u64,
                None => entry["node"].as_str() == Some(instance.name.as_str()),
            };
            let entries: Vec<&Value> = found.iter().filter(is_it).collect();
            assert!(!entries.is_empty(), "{} is not there", instance.name);
            for entry in entries {
                let range = match entry["primitive"].as_u64() {
                    Some(k) => geometry.primitives.iter().find(|p| p.index as u64 == k).unwrap().vertices.clone(),
                    None => 0..own.len(),
                };
                let theirs: Vec<[f64; 3]> = serde_json::from_value(entry["positions"].clone()).unwrap();
                assert_eq!(range.len(), theirs.len(), "{}", instance.name);
                worst = own[range].iter().zip(&theirs).map(apart).fold(worst, f64::max);
                vertices += theirs.len();
            }
        }
        assert!(vertices > 0);
    }
    println!("{}: {worst:.1e} apart, moved by up to {moved:.2}", file.display());
    [worst, moved]
}

/// The garment follows its avatar's animation in three.js and in Blender to where it does here, in plain files and in VRM of both
/// versions, which their own reader takes for what they are.
#[test]
fn other_programs_move_the_garment_as_we_do() {
    let folder = folder("judged");
    let outfit = glb(&[
        Part { node: "Mannequin_Body", material: "Skin", mesh: &body() },
        Part { node: "Vest", material: "Wool", mesh: &vest() },
    ]);
    std::fs::write(folder.join("outfit.glb"), outfit).unwrap();
    let slim = character(&Body::Avatar(Avatar::Slim).model(), Naming::Vrm).placed(y_up());
    let plain = glb(&[Part { node: "Body", material: "Body", mesh: &slim }]);
    let humanoid = slim.joints.iter().filter(|joint| !joint.name.is_empty() && joint.name != "Root").count();
    for (name, vrm) in [("plain.glb", None), ("zero.vrm", Some(Vrm::Zero)), ("one.vrm", Some(Vrm::One))] {
        std::fs::write(folder.join(name), waving(&plain, vrm, "wave")).unwrap();
        let out = folder.join(format!("dressed-{name}"));
        ends(&bespoke(&folder, &["dress", "outfit.glb", name, "-o", out.to_str().unwrap(), "-q"]), 0);
        judges::valid(&[&out]);
        if let Some(seen) = judges::three(&out, "wave", &[0.0, 0.3, 0.5, 0.71, 1.0]) {
            let (version, bones) = match vrm {
                None => (None, 0),
                Some(Vrm::Zero) => (Some("0"), humanoid),
                Some(Vrm::One) => (Some("1"), humanoid),
            };
            assert_eq!((seen["vrm"].as_str(), seen["bones"].as_u64()), (version, Some(bones as u64)), "{name}");
            let [apart, moved] = compare(&out, "wave", &seen["moments"], "primitives");
            assert!(apart < NEAR && moved > 0.1, "{name}: {apart} {moved}");
        }
        // Between keys Blender's curves are its own.
        if let Some(seen) = judges::blender(&out, &KEYS) {
            let [apart, moved] = compare(&out, "wave", &seen["moments"], "meshes");
            assert!(apart < NEAR && moved > 0.1, "{name}: {apart} {moved}");
        }
        if vrm == Some(Vrm::Zero) {
            // The list beside the materials has grown with them.
            let document = Document::open(&out).unwrap();
            let count = |path: &str| document.json().pointer(path).unwrap().as_array().unwrap().len();
            assert_eq!(count("/extensions/VRM/materialProperties"), count("/materials"));
            let last = &document.json().pointer("/extensions/VRM/materialProperties").unwrap()[1];
            assert_eq!((last["name"].as_str(), last["shader"].as_str()), (Some("Wool"), Some("VRM_USE_GLTFSHADER")));
        }
    }
}

/// Real files, where there are any: each where its nodes rest, and in moments of a few of its animations.
#[test]
fn real_files_are_posed_as_by_others() {
    let mut folders = vec![testing::process::root().join("../shared/rigs")];
    let mut files = Vec::new();
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(&folder).into_iter().flatten().flatten() {
            match entry.path() {
                path if path.is_dir() => folders.push(path),
                path if path.extension().is_some_and(|end| end == "glb") => files.push(path),
                _ => {}
            }
        }
    }
    if files.is_empty() {
        println!("SKIPPED: real files beside those of others, for there are none in ../shared/rigs");
    }
    files.sort();
    for file in files {
        let names: Vec<String> =
            Document::open(&file).unwrap().animations().unwrap().into_iter().map(|animation| animation.name).collect();
        let some = names.iter().filter(|name| !name.is_empty()).step_by(20).map(String::as_str);
        for animation in std::iter::once("").chain(some) {
            let Some(seen) = judges::three(&file, animation, &[0.0, 0.21]) else { return };
            let [apart, _] = compare(&file, animation, &seen["moments"], "primitives");
            assert!(apart < NEAR, "{}: {animation}: {apart}", file.display());
        }
    }
}
