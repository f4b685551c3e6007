//! Rigs are read as they were bound: over files that are hard to read, and over real ones where there are any.

use std::path::PathBuf;

use bespoke_gltf::{Character, Document, Instance, Scene};
use glam::{DAffine3, DMat3, DMat4, DQuat, DVec3};
use serde_json::{Value, json};
use testing::process::root;

use crate::everything::open;

/// A GLB file that is written.
#[derive(Default)]
struct Writer {
    binary: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
}

impl Writer {
    fn push(&mut self, bytes: Vec<u8>, component: u32, kind: &str, count: usize, more: &[(&str, Value)]) -> usize {
        while !self.binary.len().is_multiple_of(4) {
            self.binary.push(0);
        }
        self.views.push(json!({ "buffer": 0, "byteOffset": self.binary.len(), "byteLength": bytes.len() }));
        self.binary.extend(bytes);
        let view = self.views.len() - 1;
        let mut accessor = json!({ "bufferView": view, "componentType": component, "type": kind, "count": count });
        more.iter().for_each(|(key, value)| accessor[*key] = value.clone());
        self.accessors.push(accessor);
        self.accessors.len() - 1
    }

    fn floats(&mut self, rows: &[Vec<f64>], kind: &str) -> usize {
        let bytes = rows.iter().flatten().flat_map(|&x| (x as f32).to_le_bytes()).collect();
        self.push(bytes, 5126, kind, rows.len(), &[])
    }

    fn positions(&mut self, points: &[DVec3]) -> usize {
        let bound = |pick: fn(DVec3, DVec3) -> DVec3| points.iter().copied().reduce(pick).expect("points").as_vec3();
        let bounds = [("min", json!(bound(DVec3::min).to_array())), ("max", json!(bound(DVec3::max).to_array()))];
        let bytes = points.iter().flat_map(|p| p.to_array()).flat_map(|x| (x as f32).to_le_bytes()).collect();
        self.push(bytes, 5126, "VEC3", points.len(), &bounds)
    }

    fn matrices(&mut self, matrices: &[DAffine3]) -> usize {
        let rows: Vec<Vec<f64>> = matrices.iter().map(|m| DMat4::from(*m).to_cols_array().to_vec()).collect();
        self.floats(&rows, "MAT4")
    }

    fn joints(&mut self, rows: &[[u8; 4]]) -> usize {
        self.push(rows.as_flattened().to_vec(), 5121, "VEC4", rows.len(), &[])
    }

    /// As normalised 16-bit numbers.
    fn weights(&mut self, rows: &[[f64; 4]]) -> usize {
        let bytes = rows.as_flattened().iter().flat_map(|w| ((w * 65535.0).round() as u16).to_le_bytes()).collect();
        self.push(bytes, 5123, "VEC4", rows.len(), &[("normalized", json!(true))])
    }

    fn corners(&mut self, corners: &[u16]) -> usize {
        let bytes = corners.iter().flat_map(|v| v.to_le_bytes()).collect();
        self.push(bytes, 5123, "SCALAR", corners.len(), &[])
    }

    fn file(mut self, mut document: Value) -> Vec<u8> {
        while !self.binary.len().is_multiple_of(4) {
            self.binary.push(0);
        }
        document["asset"] = json!({ "version": "2.0" });
        document["buffers"] = json!([{ "byteLength": self.binary.len() }]);
        document["bufferViews"] = json!(self.views);
        document["accessors"] = json!(self.accessors);
        let mut text = document.to_string().into_bytes();
        text.resize(text.len().next_multiple_of(4), b' ');
        let mut file = b"glTF\x02\0\0\0".to_vec();
        file.extend(((28 + text.len() + self.binary.len()) as u32).to_le_bytes());
        for (kind, chunk) in [(b"JSON", text), (b"BIN\0", self.binary)] {
            file.extend((chunk.len() as u32).to_le_bytes());
            file.extend(kind);
            file.extend(chunk);
        }
        file
    }
}

fn matrix(transform: &DAffine3) -> Value {
    json!(DMat4::from(*transform).as_mat4().to_cols_array())
}

fn turn(axis: DVec3, degrees: f64) -> DAffine3 {
    DAffine3::from_quat(DQuat::from_axis_angle(axis, degrees.to_radians()))
}

fn shift(x: f64, y: f64, z: f64) -> DAffine3 {
    DAffine3::from_translation(DVec3::new(x, y, z))
}

#[track_caller]
fn near(a: DVec3, b: DVec3, what: &str) {
    assert!(a.distance(b) < 1e-4 * (1.0 + b.length()), "{what}: {a} instead of {b}");
}

/// What is in the file that [`two_skins`] writes, in the scene's space.
struct Truth {
    /// Bind transforms of hips, chest, arm.
    binds: [DAffine3; 3],
    body: Vec<DVec3>,
    sleeve: Vec<DVec3>,
    hat: Vec<DVec3>,
}

/// A file with all that makes reading hard: a node of `scale` turned to z up, two skins over the same nodes in another
/// order and in another space of their mesh, an arm and a chest that rest in another pose than the one they were bound in,
/// an end that is in no skin, a hat on the chest, and a shed that belongs to nothing.
fn two_skins(scale: DVec3) -> (Vec<u8>, Truth) {
    let armature = DAffine3::from_mat3(DMat3::from_diagonal(scale)) * turn(DVec3::X, -90.0);
    // The bind pose, in the armature's space.
    let hips = shift(0.0, 0.1, 1.0) * turn(DVec3::Z, 10.0);
    let chest = shift(0.0, 0.0, 1.5) * turn(DVec3::X, 20.0);
    let arm = shift(0.2, 0.0, 1.5) * turn(DVec3::Y, 90.0);
    // The rest pose: chest and arm relative to what is above them.
    let rest_chest = hips.inverse() * chest * turn(DVec3::X, 25.0);
    let rest_arm = chest.inverse() * arm * turn(DVec3::Z, 50.0);

    let grid = |from: DVec3, along: DVec3, across: DVec3| -> Vec<DVec3> {
        (0..6).map(|k| from + f64::from(k / 2) * along + f64::from(k % 2) * across).collect()
    };
    let body = grid(DVec3::new(-0.2, 0.0, 0.9), 0.3 * DVec3::Z, 0.4 * DVec3::X);
    let sleeve = grid(DVec3::new(0.2, 0.0, 1.4), 0.2 * DVec3::X, 0.2 * DVec3::Z);
    let hat = grid(DVec3::ZERO, 0.1 * DVec3::X, 0.1 * DVec3::Y);
    let shed = grid(DVec3::new(5.0, 0.0, 0.0), DVec3::X, DVec3::Y);
    let hat_on_chest = shift(0.0, 0.0, 0.4) * turn(DVec3::Z, 30.0);
    // The sleeve's mesh keeps its vertices a hundred times smaller and elsewhere.
    let sleeve_space = shift(0.3, 0.2, 0.1) * DAffine3::from_scale(DVec3::splat(0.01)) * turn(DVec3::X, 90.0);

    let mut file = Writer::default();
    let strip: Vec<u16> = (0..6).collect();
    let list = [0, 1, 2, 2, 1, 3, 2, 3, 4, 4, 3, 5];
    let binds = [hips, chest, arm];
    let inverse = |space: DAffine3, order: [usize; 3]| order.map(|j| binds[j].inverse() * space.inverse());
    let body_binds = file.matrices(&inverse(DAffine3::IDENTITY, [0, 1, 2]));
    let sleeve_binds = file.matrices(&inverse(sleeve_space, [2, 1, 0]));
    let body_primitive = |file: &mut Writer, corners: &[u16], mode: u32, material: u32| {
        let thirds = [[0.5, 0.25, 0.0, 0.0]; 6];
        let rest = [[0.25, 0.0, 0.0, 0.0]; 6];
        json!({
            "attributes": {
                "POSITION": file.positions(&body),
                "JOINTS_0": file.joints(&[[0, 1, 0, 0]; 6]),
                "WEIGHTS_0": file.weights(&thirds),
                // A second set, on a joint that the first has already.
                "JOINTS_1": file.joints(&[[1, 0, 0, 0]; 6]),
                "WEIGHTS_1": file.weights(&rest),
            },
            "indices": file.corners(corners), "mode": mode, "material": material,
        })
    };
    let primitives = [body_primitive(&mut file, &list[..6], 4, 0), body_primitive(&mut file, &strip[2..], 5, 1)];
    let carried: Vec<DVec3> = sleeve.iter().map(|&p| sleeve_space.transform_point3(p)).collect();
    let sleeve_primitive = json!({
        "attributes": {
            "POSITION": file.positions(&carried),
            "JOINTS_0": file.joints(&[[0, 1, 0, 0]; 6]),
            "WEIGHTS_0": file.weights(&[[0.75, 0.25, 0.0, 0.0]; 6]),
        },
        "indices": file.corners(&list),
    });
    let hat_primitive = json!({ "attributes": { "POSITION": file.positions(&hat) }, "indices": file.corners(&list) });
    let shed_primitive = json!({ "attributes": { "POSITION": file.positions(&shed) }, "mode": 5 });
    let nodes = json!([
        { "name": "Armature", "matrix": matrix(&armature), "children": [1, 5, 6] },
        { "name": "Hips", "matrix": matrix(&hips), "children": [2] },
        { "name": "Chest", "matrix": matrix(&rest_chest), "children": [3, 7] },
        { "name": "Arm", "matrix": matrix(&rest_arm), "children": [4] },
        { "name": "Arm_end", "matrix": matrix(&shift(0.0, 0.0, 0.6)) },
        { "name": "Body", "mesh": 0, "skin": 0 },
        // Where a node with a skin is says nothing.
        { "name": "Sleeve", "mesh": 1, "skin": 1, "matrix": matrix(&shift(7.0, 7.0, 7.0)) },
        { "name": "Hat", "mesh": 2, "matrix": matrix(&hat_on_chest) },
        { "name": "Shed", "mesh": 3, "matrix": matrix(&shift(0.0, 0.0, 2.0)) },
    ]);
    let document = json!({
        "scene": 0, "scenes": [{ "nodes": [0, 8] }], "nodes": nodes,
        "skins": [
            { "joints": [1, 2, 3], "inverseBindMatrices": body_binds },
            { "joints": [3, 2, 1], "inverseBindMatrices": sleeve_binds },
        ],
        "materials": [{ "name": "Skin" }, { "name": "Cloth" }],
        "meshes": [
            { "primitives": primitives }, { "primitives": [sleeve_primitive] },
            { "primitives": [hat_primitive] }, { "primitives": [shed_primitive] },
        ],
    });
    let carry = |points: &[DVec3]| points.iter().map(|&p| armature.transform_point3(p)).collect();
    let hat: Vec<DVec3> = hat.iter().map(|&p| (chest * hat_on_chest).transform_point3(p)).collect();
    let truth =
        Truth { binds: binds.map(|b| armature * b), body: carry(&body), sleeve: carry(&sleeve), hat: carry(&hat) };
    (file.file(document), truth)
}

fn scene(file: &[u8]) -> Scene {
    open(file).scene().unwrap_or_else(|error| panic!("{error}"))
}

/// The meshes at the nodes "Hat", "Body", "Sleeve" and "Shed".
fn meshes(scene: &Scene) -> [&Instance; 4] {
    let all = || scene.characters[0].meshes.iter().chain(&scene.loose);
    ["Hat", "Body", "Sleeve", "Shed"].map(|name| all().find(|mesh| mesh.name == name).expect("a mesh of that name"))
}

#[test]
fn joints_and_meshes_stand_in_one_space_as_they_were_bound() {
    for scale in [DVec3::splat(100.0), DVec3::ONE, DVec3::new(1.0, 2.0, 0.5), DVec3::new(-1.0, 1.0, 1.0)] {
        let (file, truth) = two_skins(scale);
        let scene = scene(&file);
        let joints = &scene.characters[0].joints;
        assert_eq!(scene.characters.len(), 1);
        let names: Vec<&str> = joints.iter().map(|joint| joint.name.as_str()).collect();
        assert_eq!(names, ["Hips", "Chest", "Arm", "Arm_end"]);
        let parents: Vec<_> = joints.iter().map(|joint| joint.parent).collect();
        assert_eq!(parents, [None, Some(0), Some(1), Some(2)]);
        let bind = |k: usize| DAffine3::from_mat4(DMat4::from_cols_array_2d(&joints[k].bind));
        for (k, truth) in truth.binds.iter().enumerate() {
            for p in [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z] {
                near(bind(k).transform_point3(p), truth.transform_point3(p), names[k]);
            }
        }
        let end = truth.binds[2].transform_point3(0.6 * DVec3::Z);
        near(bind(3).translation, end, "the end, beside the arm as it was bound");

        let [hat, body, sleeve, shed] = meshes(&scene);
        let twice = [truth.body.clone(), truth.body].concat();
        for (mesh, truth) in [(hat, &truth.hat), (body, &twice), (sleeve, &truth.sleeve)] {
            let positions = &mesh.geometry.positions;
            assert_eq!(positions.len(), truth.len());
            positions.iter().zip(truth).for_each(|(p, q)| near(DVec3::from_array(*p), *q, &mesh.name));
        }
        near(DVec3::from_array(shed.geometry.positions[0]), DVec3::new(5.0, 0.0, 2.0), "the shed");
        assert!(shed.geometry.influences.iter().all(Vec::is_empty));

        let alike = |a: &[(u32, f64)], b: &[(u32, f64)]| {
            a.iter().zip(b).all(|((i, w), (j, v))| i == j && (w - v).abs() < 1e-4) && a.len() == b.len()
        };
        let all = |mesh: &Instance, row: &[(u32, f64)]| mesh.geometry.influences.iter().all(|v| alike(v, row));
        assert!(all(hat, &[(1, 1.0)]), "{:?}", hat.geometry.influences[0]);
        assert!(all(body, &[(0, 0.5), (1, 0.5)]), "{:?}", body.geometry.influences[0]);
        assert!(all(sleeve, &[(2, 0.75), (1, 0.25)]), "{:?}", sleeve.geometry.influences[0]);
    }
}

#[test]
fn triangles_of_all_kinds_keep_their_front_and_their_material() {
    let normals = |scale: DVec3| -> Vec<Vec<DVec3>> {
        let scene = scene(&two_skins(scale).0);
        let normal = |mesh: &Instance, t: [u32; 3]| {
            let [a, b, c] = t.map(|v| DVec3::from_array(mesh.geometry.positions[v as usize]));
            (b - a).cross(c - a).normalize()
        };
        meshes(&scene).map(|mesh| mesh.geometry.triangles.iter().map(|&t| normal(mesh, t)).collect::<Vec<_>>()).to_vec()
    };
    let plain = normals(DVec3::ONE);
    assert_eq!(plain.iter().map(Vec::len).collect::<Vec<_>>(), [4, 4, 4, 4]);
    for normals in &plain {
        normals.iter().for_each(|normal| near(*normal, normals[0], "one side of a sheet"));
    }
    // A mirror image of an outside is an outside; the shed is not beneath the mirror.
    let mirror = DVec3::new(-1.0, 1.0, 1.0);
    for (plain, mirrored) in plain.iter().zip(normals(mirror)).take(3) {
        plain.iter().zip(mirrored).for_each(|(a, b)| near(b, *a * mirror, "a normal"));
    }

    let document = open(&two_skins(DVec3::ONE).0);
    let scene = document.scene().expect("a scene");
    let materials = document.materials().expect("materials");
    let cloth =
        meshes(&scene)[1].geometry.primitives.iter().find(|p| p.material.is_some_and(|m| materials[m] == "Cloth"));
    let cloth = cloth.expect("a primitive of cloth");
    assert_eq!((cloth.triangles.len(), cloth.vertices.len()), (2, 6));
}

#[test]
fn a_scale_of_nothing_is_read_and_a_broken_bind_matrix_is_not() {
    // Nothing rests where a scale of 0 leaves no room, and the bind matrices say where it was bound all the same.
    let flat = scene(&two_skins(DVec3::ZERO).0);
    assert!(flat.characters[0].joints.iter().all(|joint| joint.bind.as_flattened().iter().all(|x| x.is_finite())));
    let (mut file, _) = two_skins(DVec3::ONE);
    // The binary chunk begins with the bind matrices.
    let text = u32::from_le_bytes(file[12..16].try_into().expect("four bytes")) as usize;
    file[28 + text..][..64].fill(0);
    let said = open(&file).scene().expect_err("a matrix of zeros").to_string();
    assert!(said.contains("/skins/0") && said.contains("bind matrix"), "{said}");
}

/// The real characters beside the checkout.
fn real() -> Vec<PathBuf> {
    let mut folders = vec![root().join("../shared/rigs")];
    let mut files = Vec::new();
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(&folder).into_iter().flatten() {
            let path = entry.expect("an entry").path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|end| end == "glb") {
                files.push(path);
            }
        }
    }
    files.sort();
    files
}

/// The smallest and largest coordinates of all meshes on a rig, and of all joints that have weights.
fn boxes(character: &Character) -> [[DVec3; 2]; 2] {
    let bound = |points: &mut dyn Iterator<Item = DVec3>| {
        points.fold([DVec3::INFINITY, DVec3::NEG_INFINITY], |[low, high], p| [low.min(p), high.max(p)])
    };
    let meshes = character.meshes.iter().map(|mesh| &mesh.geometry);
    let used = meshes.clone().flat_map(|m| m.influences.iter().flatten().map(|(joint, _)| *joint as usize));
    [
        bound(&mut meshes.flat_map(|mesh| mesh.positions.iter().copied().map(DVec3::from_array))),
        bound(&mut used.map(|joint| DVec3::from_slice(&character.joints[joint].bind[3]))),
    ]
}

#[test]
fn real_characters_stand_in_their_joints() {
    let files = real();
    if files.is_empty() {
        println!("SKIPPED: there are no characters in ../shared/rigs");
    }
    for file in files {
        let name = file.display();
        let scene = Document::open(&file).and_then(|document| document.scene()).unwrap_or_else(|e| panic!("{e}"));
        let character = &scene.characters[0];
        assert!(character.joints.len() > 10 && !character.meshes.is_empty(), "{name}");
        let [[low, high], [first, last]] = boxes(character);
        let size = (high - low).max_element();
        assert!((0.5..20.0).contains(&size), "{name}: {size} high");
        let inside = (first - low).min(high - last).min_element() > -0.02 * size;
        assert!(inside, "{name}: joints from {first} to {last}, meshes from {low} to {high}");
        for mesh in &character.meshes {
            assert!(!mesh.geometry.triangles.is_empty(), "{name}: {}", mesh.name);
            let sums = mesh.geometry.influences.iter().map(|v| v.iter().map(|(_, weight)| weight).sum::<f64>());
            assert!(sums.into_iter().all(|sum| (sum - 1.0).abs() < 1e-6), "{name}: {}", mesh.name);
        }
    }
}
