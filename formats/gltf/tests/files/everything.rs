//! A file with all that a file may hold: what is read and written with additions keeps the rest, byte for byte.

use bespoke_gltf::{Change, Document, Edit, Form, Import, nothing_outside};
use serde_json::Value;

/// The JSON of the file, as a person would write it: spaces, escapes, digits and keys that no library would write so.
const JSON: &str = r#"{
  "asset" : { "version":"2.0", "generator": "by hand \u00e9", "copyright":"us", "extras": { "big": 12345678901234567890, "e": 1.50E+2 } },
  "extensionsUsed": ["VRMC_vrm", "VRMC_springBone", "VRMC_materials_mtoon", "KHR_materials_sheen", "KHR_texture_transform", "ACME_x"],
  "scene": 0,
  "scenes": [ { "nodes": [0, 3, 4], "name": "s", "extras": {"of": "scene"}, "extensions": {"ACME_x": {"s": 1}} } ],
  "nodes": [
    { "name": "hips", "children": [1], "translation": [0, 1, 0], "extras": {"n": [1,2 , 3]} },
    { "name": "chest", "children": [2], "translation": [0, 0.5, 0], "extensions": {"ACME_x": {"n": 1}} },
    { "name": "head", "translation": [0, 0.25, 0] },
    { "name": "body", "mesh": 0, "skin": 0 },
    { "name": "coat", "mesh": 1, "skin": 0, "weights": [0.5] }
  ],
  "meshes": [
    { "name": "body", "primitives": [ { "attributes": { "POSITION": 0, "JOINTS_0": 1, "WEIGHTS_0": 2 }, "indices": 3, "material": 0 } ] },
    { "name": "coat", "weights": [0.25], "extras": {"targetNames": ["wide"], "mine": "yes"}, "extensions": {"ACME_x": {"m": 1}},
      "primitives": [ { "attributes": { "POSITION": 0, "JOINTS_0": 1, "WEIGHTS_0": 2, "TEXCOORD_0": 5, "_FIT": 4 }, "indices": 3,
        "material": 1, "targets": [ { "POSITION": 6 } ], "extras": {"p": true}, "extensions": {"ACME_x": {"p": 1}} } ] }
  ],
  "materials": [
    { "name": "skin" },
    { "name": "cloth", "pbrMetallicRoughness": { "baseColorTexture": { "index": 0, "extensions": {"KHR_texture_transform": {"scale": [2, 2]}} } },
      "extensions": { "KHR_materials_sheen": { "sheenColorTexture": { "index": 0 }, "sheenRoughnessFactor": 0.30 },
        "VRMC_materials_mtoon": { "specVersion": "1.0", "shadeMultiplyTexture": { "index": 0 } } }, "extras": { "washing": 30, "index": 7 } }
  ],
  "textures": [ { "sampler": 0, "source": 0, "extras": {"t": 1} } ],
  "samplers": [ { "magFilter": 9729 } ],
  "images": [ { "bufferView": 7, "mimeType": "image/png", "name": "dot" } ],
  "skins": [ { "joints": [0, 1, 2], "inverseBindMatrices": 7, "skeleton": 0, "extras": {"k": 1} } ],
  "animations": [ { "name": "nod", "channels": [ { "sampler": 0, "target": { "node": 2, "path": "rotation" } } ],
    "samplers": [ { "input": 8, "output": 9 } ] } ],
  "extensions": { "VRMC_vrm": { "specVersion": "1.0", "humanoid": { "humanBones": { "hips": {"node": 0}, "chest": {"node": 1}, "head": {"node": 2} } } },
    "VRMC_springBone": { "specVersion": "1.0", "springs": [ { "joints": [ {"node": 2} ] } ] }, "ACME_x": { "r": 1e0 } },
  "unknownProperty": { "kept" : [ true,null ] },
"#;

/// Positions of the mesh: a square and what hangs over.
const POSITIONS: [[f32; 3]; 4] = [[-0.5, 1.0, 0.0], [0.5, 1.0, 0.0], [-0.5, 1.75, 0.0], [0.5, 1.75, 0.125]];

/// A picture of one dot.
const PNG: [u8; 67] = [
    0x89, b'P', b'N', b'G', 13, 10, 26, 10, 0, 0, 0, 13, b'I', b'H', b'D', b'R', 0, 0, 0, 1, 0, 0, 0, 1, 8, 0, 0, 0, 0,
    0x3A, 0x7E, 0x9B, 0x55, 0, 0, 0, 10, b'I', b'D', b'A', b'T', 0x78, 0x9C, 0x63, 0x60, 0, 0, 0, 2, 0, 1, 0x48, 0xAF,
    0xA4, 0x71, 0, 0, 0, 0, b'I', b'E', b'N', b'D', 0xAE, 0x42, 0x60, 0x82,
];

/// The file, as GLB with a chunk that nobody knows.
pub fn everything() -> Vec<u8> {
    let mut binary: Vec<u8> = Vec::new();
    let (mut views, mut accessors) = (Vec::new(), Vec::new());
    let mut view = |bytes: &[u8], more: &str| {
        binary.resize(binary.len().next_multiple_of(4), 0xEE);
        views.push(format!(r#"{{"buffer":0,"byteOffset":{},"byteLength":{}{more}}}"#, binary.len(), bytes.len()));
        binary.extend(bytes);
        views.len() - 1
    };
    let floats = |list: &[f32]| list.iter().flat_map(|x| x.to_le_bytes()).collect::<Vec<u8>>();
    let mut accessor = |view: usize, text: &str| accessors.push(format!(r#"{{"bufferView":{view},{text}}}"#));
    let vertices = r#","target":34962"#;
    let v = view(&floats(POSITIONS.as_flattened()), vertices);
    accessor(v, r#""componentType":5126,"count":4,"type":"VEC3","min":[-0.5,1,0],"max":[0.5,1.75,0.125]"#);
    let v = view(&[0, 1, 0, 0, 0, 1, 0, 0, 1, 2, 0, 0, 2, 1, 0, 0], vertices);
    accessor(v, r#""componentType":5121,"count":4,"type":"VEC4""#);
    let v = view(&[255, 0, 0, 0, 204, 51, 0, 0, 153, 102, 0, 0, 255, 0, 0, 0], vertices);
    accessor(v, r#""componentType":5121,"normalized":true,"count":4,"type":"VEC4""#);
    let v = view(&[0, 0, 1, 0, 2, 0, 2, 0, 1, 0, 3, 0], r#","target":34963"#);
    accessor(v, r#""componentType":5123,"count":6,"type":"SCALAR","name":"corners""#);
    let v = view(&floats(&[0.5, 0.25, 0.125, 1.0]), vertices);
    accessor(v, r#""componentType":5126,"count":4,"type":"SCALAR""#);
    // 16-bit texture coordinates, eight bytes apart.
    let uv: Vec<u8> = [0u16, 0, 9, 9, 65535, 0, 9, 9, 0, 65535, 9, 9, 65535, 65535, 9, 9]
        .iter()
        .flat_map(|x| x.to_le_bytes())
        .collect();
    let v = view(&uv, r#","byteStride":8,"target":34962"#);
    accessor(v, r#""componentType":5123,"normalized":true,"count":4,"type":"VEC2""#);
    let v = view(&[&[1, 0, 3, 0][..], &floats(&[0.25, 0.0, 0.0, 0.5, 0.0, 0.0])].concat(), "");
    accessors.push(format!(
        r#"{{"componentType":5126,"count":4,"type":"VEC3","min":[0,0,0],"max":[0.5,0,0],"sparse":{{"count":2,"indices":{{"bufferView":{v},"componentType":5123}},"values":{{"bufferView":{v},"byteOffset":4}}}}}}"#
    ));
    let image = view(&PNG, "");
    assert_eq!(image, 7);
    let mut accessor = |view: usize, text: &str| accessors.push(format!(r#"{{"bufferView":{view},{text}}}"#));
    let binds: Vec<f32> = [1.0f32, 1.5, 1.75]
        .iter()
        .flat_map(|y| [1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, -y, 0.0, 1.0])
        .collect();
    let v = view(&floats(&binds), "");
    accessor(v, r#""componentType":5126,"count":3,"type":"MAT4""#);
    let v = view(&floats(&[0.0, 1.0]), "");
    accessor(v, r#""componentType":5126,"count":2,"type":"SCALAR","min":[0],"max":[1]"#);
    let v = view(&floats(&[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.0]), "");
    accessor(v, r#""componentType":5126,"count":2,"type":"VEC4""#);
    let json = format!(
        "{JSON}  \"bufferViews\": [{}],\n  \"accessors\": [\n{}\n],\n  \"buffers\": [ {{ \"byteLength\": {}, \"extras\": 1 }} ]\n}}\n",
        views.join(","),
        accessors.join(",\n"),
        binary.len()
    );
    glb(&json, &binary, b"\x04\0\0\0ACMEkept")
}

/// A GLB file.
pub fn glb(json: &str, binary: &[u8], others: &[u8]) -> Vec<u8> {
    let padded = |bytes: &[u8], with: u8| {
        let mut bytes = bytes.to_vec();
        bytes.resize(bytes.len().next_multiple_of(4), with);
        bytes
    };
    let (json, binary) = (padded(json.as_bytes(), b' '), padded(binary, 0));
    let mut file = b"glTF\x02\0\0\0".to_vec();
    file.extend(((28 + json.len() + binary.len() + others.len()) as u32).to_le_bytes());
    for (kind, chunk) in [(b"JSON", json), (b"BIN\0", binary)] {
        file.extend((chunk.len() as u32).to_le_bytes());
        file.extend(kind);
        file.extend(chunk);
    }
    file.extend(others);
    file
}

pub fn open(bytes: &[u8]) -> Document {
    Document::from_bytes(bytes.to_vec(), nothing_outside()).unwrap_or_else(|error| panic!("{error}"))
}

/// The coat of the file taken into the file itself, moved, on a skin of its own.
pub fn with_another_coat(document: &Document) -> Vec<u8> {
    let mut edit = Edit::new(document, Form::Glb).expect("a file to append to");
    let moved: Vec<[f64; 3]> =
        document.mesh(1).expect("a coat").positions.iter().map(|p| [p[0], p[1], p[2] + 1.0]).collect();
    let own = [vec![(1, 1.0)], vec![(0, 0.25), (1, 0.75)], vec![(0, 1.0)], vec![(1, 0.5), (0, 0.5)]];
    let change = Change { positions: Some(&moved), influences: Some(&own), ..Change::default() };
    let mesh = Import::new(document).mesh(&mut edit, 1, &change).expect("a mesh");
    let skins = document.skins().expect("skins");
    let skin = edit.add_skin("coat", &skins[0].joints[..2], &skins[0].inverse_binds[..2]).expect("a skin");
    edit.add_node("another coat", mesh, Some(skin), None).expect("a node");
    edit.output("out").expect("a file").file
}

#[test]
fn what_is_not_touched_stays_byte_for_byte() {
    let bytes = everything();
    let document = open(&bytes);
    let unchanged = Edit::new(&document, Form::Glb).and_then(|edit| edit.output("out")).expect("a file");
    assert!(unchanged.file == bytes && unchanged.beside.is_empty(), "a file that is only read and written is another");

    let file = with_another_coat(&document);
    let after = open(&file);
    let (old, new) = (document.binary_chunk().expect("data"), after.binary_chunk().expect("data"));
    assert!(new.len() > old.len() && new[..old.len()] == *old, "the old data have changed");
    assert_eq!(after.other_chunks(), document.other_chunks());
    // Every line that is not the end of a list is there, letter by letter.
    for line in document.json_text().lines().filter(|line| line.trim_end().ends_with(',')) {
        let line = line.trim_end_matches(',').trim_end_matches([']', ' ']);
        let changes = ["extensionsUsed", "\"scenes\"", "\"buffers\""].iter().any(|list| line.contains(list));
        assert!(changes || after.json_text().contains(line), "no longer there: {line}");
    }
    same_entries(document.json(), after.json(), "");
}

/// Whether all of `old` is in `new`, in the same places; lists and objects may have more at their ends.
fn same_entries(old: &Value, new: &Value, path: &str) {
    match (old, new) {
        (Value::Object(old), Value::Object(new)) => {
            for (k, (key, value)) in old.iter().enumerate() {
                assert_eq!(new.keys().nth(k), Some(key), "{path}: the order of keys");
                if path != "/buffers/0" || key != "byteLength" {
                    same_entries(value, &new[key], &format!("{path}/{key}"));
                }
            }
        }
        (Value::Array(old), Value::Array(new)) => {
            assert!(new.len() >= old.len(), "{path} is shorter");
            old.iter().zip(new).enumerate().for_each(|(k, (a, b))| same_entries(a, b, &format!("{path}/{k}")));
        }
        // Numbers by their digits.
        (old, new) => assert_eq!(old.to_string(), new.to_string(), "{path}"),
    }
}

#[test]
fn what_is_taken_over_is_whole() {
    let document = open(&everything());
    let after = open(&with_another_coat(&document));
    let json = after.json();
    let coat = &json["meshes"][2];
    assert_eq!(coat["extras"], document.json()["meshes"][1]["extras"]);
    let material = &json["materials"][coat["primitives"][0]["material"].as_u64().expect("a material") as usize];
    let texture = material["pbrMetallicRoughness"]["baseColorTexture"]["index"].as_u64().expect("a texture");
    assert_eq!(texture, 1, "the texture was not taken over");
    assert_eq!(material["extensions"]["KHR_materials_sheen"]["sheenColorTexture"]["index"].as_u64(), Some(texture));
    assert_eq!(material["extensions"]["VRMC_materials_mtoon"]["shadeMultiplyTexture"]["index"].as_u64(), Some(texture));
    assert_eq!(material["extras"]["index"].as_u64(), Some(7), "extras are the user's own");
    let image = json["textures"][1]["source"].as_u64().expect("an image");
    let view = json["images"][image as usize]["bufferView"].as_u64().expect("a view");
    assert_eq!(after.view_bytes(view as usize).expect("bytes"), PNG);

    let (old, new) = (document.mesh(1).expect("a mesh"), after.mesh(2).expect("a mesh"));
    assert_eq!(new.triangles, old.triangles);
    assert_eq!(new.morphs[0].deltas, [(1, [0.25, 0.0, 0.0]), (3, [0.5, 0.0, 0.0])]);
    assert_eq!((new.morphs[0].name.as_str(), new.morphs[0].weight), ("wide", 0.25));
    assert!(new.positions.iter().zip(&old.positions).all(|(a, b)| a[2] == b[2] + 1.0 && a[0] == b[0]));
    assert_eq!(new.influences[1], [(1, 0.75), (0, 0.25)]);
    let of = |mesh: &bespoke_gltf::Mesh, name: &str| {
        mesh.primitives[0].attributes.iter().find(|(other, _)| other == name).expect("an attribute").1
    };
    let fit = |document: &Document, mesh| document.rows::<1>(of(mesh, "_FIT")).expect("an attribute of its own");
    assert_eq!(fit(&after, &new), fit(&document, &old));
    let uv = |document: &Document, mesh| document.rows::<2>(of(mesh, "TEXCOORD_0")).expect("texture coordinates");
    assert_eq!(uv(&after, &new), uv(&document, &old));
    assert_eq!(uv(&after, &new)[3], [1.0, 1.0]);

    let scene = after.scene().expect("a scene");
    assert_eq!(scene.characters.len(), 1, "two skins over one tree are one rig");
    assert_eq!(scene.characters[0].meshes.len(), 3);
    let bones: Vec<_> = scene.characters[0].joints.iter().map(|joint| joint.bone.as_deref()).collect();
    assert_eq!(bones, [Some("hips"), Some("chest"), Some("head")]);
}

#[test]
fn a_file_becomes_a_text_with_files_beside_it_and_comes_back() {
    let document = open(&everything());
    let text = Edit::new(&document, Form::Gltf).and_then(|edit| edit.output("all")).expect("a file");
    assert_eq!(text.beside.len(), 1);
    let (name, data) = text.beside[0].clone();
    assert_eq!((name.as_str(), Some(&data[..])), ("all.bin", document.binary_chunk()));
    let beside = move |uri: &str| if uri == name { Ok(data.clone()) } else { Err("is not there".to_owned()) };
    let again = Document::from_bytes(text.file, Box::new(beside)).expect("a text");
    let back = Edit::new(&again, Form::Glb).and_then(|edit| edit.output("all")).expect("a file");
    let back = open(&back.file);
    assert_eq!(back.binary_chunk(), document.binary_chunk());
    assert_eq!(back.json(), document.json());
}
