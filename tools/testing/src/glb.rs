//! Characters of the closet as GLB files.

use bespoke_gltf::{Document, Edit, Form, nothing_outside};
use closet::rigs::Character;
use glam::DMat4;
use serde_json::json;

/// A mesh of a file: its node, its material, and what it is.
pub struct Part<'a> {
    /// Name of the node and of the mesh.
    pub node: &'a str,
    /// Name of the material.
    pub material: &'a str,
    /// The mesh on its joints.
    pub mesh: &'a Character,
}

/// A GLB file with the joints of the first part as nodes that rest in the bind pose, and a skinned mesh for each part.
///
/// # Panics
/// Never with a character of the closet.
pub fn glb(parts: &[Part]) -> Vec<u8> {
    let empty =
        br#"{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[]}],"extras":{"kept":12345678901234567890}}"#;
    let document = Document::from_bytes(empty.to_vec(), nothing_outside()).unwrap();
    let mut edit = Edit::new(&document, Form::Glb).unwrap();
    let rig = &parts[0].mesh.joints;
    for joint in rig {
        let above = joint.parent.map_or(DMat4::IDENTITY, |parent| DMat4::from(rig[parent].bind));
        let local = (above.inverse() * DMat4::from(joint.bind)).to_cols_array();
        edit.hang(json!({ "name": joint.name, "matrix": local }), joint.parent).unwrap();
    }
    let joints: Vec<usize> = (0..rig.len()).collect();
    let inverse: Vec<_> = rig.iter().map(|joint| DMat4::from(joint.bind.inverse()).to_cols_array_2d()).collect();
    let skin = edit.add_skin("rig", &joints, &inverse).unwrap();
    for part in parts {
        let Character { mesh, influences, .. } = part.mesh;
        let positions: Vec<[f64; 3]> = mesh.positions.iter().map(|p| p.to_array()).collect();
        let rows: Vec<Vec<(u32, f64)>> =
            influences.iter().map(|row| row.iter().map(|&(joint, weight)| (joint as u32, weight)).collect()).collect();
        let mut attributes = json!({
            "POSITION": edit.add_positions(&positions).unwrap(),
            "TEXCOORD_0": edit.add_attribute(&positions.iter().map(|p| [p[0], p[1]]).collect::<Vec<_>>()).unwrap(),
        });
        for (set, (joints, weights)) in edit.add_influences(&rows).unwrap().into_iter().enumerate() {
            attributes[format!("JOINTS_{set}")] = joints.into();
            attributes[format!("WEIGHTS_{set}")] = weights.into();
        }
        let indices = edit.add_triangles(&mesh.triangles).unwrap();
        let material = edit.push("materials", json!({ "name": part.material })).unwrap();
        let primitive = json!({ "attributes": attributes, "indices": indices, "material": material });
        let mesh = edit.push("meshes", json!({ "name": part.node, "primitives": [primitive] })).unwrap();
        edit.add_node(part.node, mesh, Some(skin), None).unwrap();
    }
    edit.output("character").unwrap().file
}
