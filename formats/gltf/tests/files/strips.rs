//! Strips and fans of triangles.

use bespoke_gltf::{Change, Document, Edit, Form, Import};

use crate::everything::{glb, open};

/// A file with one primitive of seven vertices in a `mode`, with `corners` as indices.
fn file(mode: u32, corners: &[u16]) -> Document {
    let positions: Vec<u8> = (0..7u32)
        .flat_map(|k| [f64::from(k / 2), f64::from(k % 2), 0.0])
        .flat_map(|x| (x as f32).to_le_bytes())
        .collect();
    let indices: Vec<u8> = corners.iter().flat_map(|v| v.to_le_bytes()).collect();
    let json = format!(
        r#"{{"asset":{{"version":"2.0"}},"nodes":[{{"mesh":0}}],"meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"indices":1,"mode":{mode}}}]}}],
        "accessors":[{{"bufferView":0,"componentType":5126,"type":"VEC3","count":7,"min":[0,0,0],"max":[3,1,0]}},
        {{"bufferView":1,"componentType":5123,"type":"SCALAR","count":{}}}],
        "bufferViews":[{{"buffer":0,"byteLength":84}},{{"buffer":0,"byteOffset":84,"byteLength":{}}}],"buffers":[{{"byteLength":{}}}]}}"#,
        corners.len(),
        indices.len(),
        84 + indices.len()
    );
    open(&glb(&json, &[positions, indices].concat(), &[]))
}

fn triangles(document: &Document) -> Vec<[u32; 3]> {
    document.mesh(0).expect("a mesh").triangles
}

#[test]
fn all_triangles_of_a_strip_have_one_front() {
    let strip = file(5, &[0, 1, 2, 3, 4]);
    assert_eq!(triangles(&strip), [[0, 1, 2], [2, 1, 3], [2, 3, 4]]);
    // Two strips are joined by triangles without area, after which the sides alternate as before.
    let joined = file(5, &[0, 1, 2, 3, 3, 4, 4, 5, 6]);
    assert_eq!(triangles(&joined), [[0, 1, 2], [2, 1, 3], [4, 5, 6]]);
    let fan = file(6, &[0, 2, 4, 5, 3]);
    assert_eq!(triangles(&fan), [[0, 2, 4], [0, 4, 5], [0, 5, 3]]);
    // All of a flat one look the same way.
    let positions = strip.mesh(0).expect("a mesh").positions;
    for [a, b, c] in triangles(&strip) {
        let [a, b, c] = [a, b, c].map(|v| positions[v as usize]);
        assert!((b[0] - a[0]) * (c[1] - a[1]) < (b[1] - a[1]) * (c[0] - a[0]));
    }
}

/// Taken over, a strip stays one; turned inside out, it becomes a list of the same triangles.
#[test]
fn a_strip_is_taken_over() {
    for (mode, corners) in [(5, &[0u16, 1, 2, 3, 3, 4, 4, 5, 6][..]), (6, &[0, 2, 4, 5, 3])] {
        let document = file(mode, corners);
        for turned in [false, true] {
            let mut edit = Edit::new(&document, Form::Glb).expect("a file to append to");
            let change = Change { turned, ..Change::default() };
            let mesh = Import::new(&document).mesh(&mut edit, 0, &change).expect("a mesh");
            let after = open(&edit.output("out").expect("a file").file);
            let kept = after.json()["meshes"][mesh]["primitives"][0]["mode"].as_u64();
            assert_eq!(kept, (!turned).then_some(u64::from(mode)));
            let expected: Vec<[u32; 3]> =
                triangles(&document).into_iter().map(|[a, b, c]| if turned { [a, c, b] } else { [a, b, c] }).collect();
            assert_eq!(after.mesh(mesh).expect("a mesh").triangles, expected);
        }
    }
}
