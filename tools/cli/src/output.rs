//! The dressed avatar as a file: that of the avatar with the garments appended, everything else as it was.

use std::collections::{BTreeMap, HashMap};

use bespoke_gltf::{Edit, Form, Import, VERTICES};
use glam::{DAffine3, DMat4, DVec3};
use serde_json::{Value, json};

use crate::args::{Dress, Keep};
use crate::caps;
use crate::dress::Dressed;
use crate::failure::{Failure, Result};
use crate::figure::{Figure, Part};
use crate::obj::is_obj;
use crate::parts::Kind;

/// The skin of all garments that this program writes has this name: by it they are known again, whatever they are called.
pub const SKIN: &str = "bespoke";

/// What the result is written as.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Written {
    /// A glTF file.
    Gltf(Form),
    /// An OBJ file.
    Obj,
}

/// What the result is written as, by the ending of its name.
///
/// # Errors
/// Where the name has none of the endings, or the avatar's file is not of that kind.
pub fn written(args: &Dress) -> Result<Written> {
    let ending = args.output.extension().map(|e| e.to_string_lossy().to_lowercase());
    match ending.as_deref() {
        Some("glb" | "vrm") => Ok(Written::Gltf(Form::Glb)),
        Some("gltf") => Ok(Written::Gltf(Form::Gltf)),
        Some("obj") if is_obj(&args.avatar) => Ok(Written::Obj),
        Some("obj") => Err(Failure::usage(format!(
            "{}: an OBJ file is written where the avatar is one; this avatar has a skeleton and materials that OBJ cannot hold, so \
             the name has to end in .glb, .vrm or .gltf",
            args.output.display()
        ))),
        _ => {
            let or_obj = if is_obj(&args.avatar) { ", or in .obj as the avatar's" } else { "" };
            Err(Failure::usage(format!(
                "{}: the result is glTF, so its name has to end in .glb, .vrm or .gltf{or_obj}",
                args.output.display()
            )))
        }
    }
}

/// # Errors
/// Where the result is to have skin weights, and the avatar has none.
pub fn need_weights(written: Written, args: &Dress, avatar: &Figure) -> Result<()> {
    if written == Written::Obj || avatar.has_skin() {
        return Ok(());
    }
    Err(Failure::no_result(format!(
        "{}: it has no skin weights, which a glTF file needs for its skeleton; give them with --target-skin, put them beside it as \
         skin.txt, or let the result be an OBJ file (-o {})",
        args.avatar.display(),
        args.output.with_extension("obj").display()
    )))
}

/// Writes the avatar with what it wears now.
///
/// # Errors
/// Where the file cannot be written; nothing half-written stays.
pub fn write(args: &Dress, form: Form, outfit: &Figure, avatar: &Figure, dressed: &[Dressed]) -> Result<()> {
    let fail = |e: bespoke_gltf::Error| Failure::no_result(e.to_string());
    let mut edit = Edit::new(&avatar.document, form).map_err(fail)?;
    take_off(&mut edit, avatar, args.keep).map_err(fail)?;
    let mut garments = Garments { outfit, avatar, import: Import::new(&outfit.document), joints: BTreeMap::new() };
    garments.write(&mut edit, dressed).map_err(fail)?;
    let stem = args.output.file_stem().unwrap_or_default().to_string_lossy();
    edit.output(&stem).and_then(|output| output.save(&args.output)).map_err(fail)
}

/// Takes off the avatar what does not stay: whole meshes at their node, or some primitives of one, in a mesh of its own.
fn take_off(edit: &mut Edit, avatar: &Figure, keep: Keep) -> bespoke_gltf::Result<()> {
    let stays = |kind: Kind| match keep {
        Keep::Both => true,
        Keep::Body => kind != Kind::Garment,
        Keep::Outfit => false,
    };
    let mut by_node: BTreeMap<usize, Vec<&Part>> = BTreeMap::new();
    avatar.parts.iter().for_each(|part| by_node.entry(part.node).or_default().push(part));
    for (node, parts) in by_node {
        let gone: Vec<&&Part> = parts.iter().filter(|part| !stays(part.sorted.kind)).collect();
        if gone.len() == parts.len() {
            edit.take_off(node)?;
        } else if !gone.is_empty() {
            let mut mesh = edit.json()["meshes"][parts[0].mesh].clone();
            if let Some(primitives) = mesh["primitives"].as_array_mut() {
                let mut index = 0;
                primitives.retain(|_| {
                    index += 1;
                    gone.iter().all(|part| part.primitive.index != index - 1)
                });
            }
            let mesh = edit.push("meshes", mesh)?;
            edit.json_mut()["nodes"][node]["mesh"] = mesh.into();
        }
    }
    Ok(())
}

/// Garments on their way into the avatar's file.
struct Garments<'a> {
    outfit: &'a Figure,
    avatar: &'a Figure,
    import: Import<'a>,
    /// The place in the skin of each joint that moves something: the avatar's, then those of the outfit that come along.
    joints: BTreeMap<Joint, u32>,
}

/// A joint of the avatar, or one that came with a garment.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
enum Joint {
    /// A joint of the avatar's rig.
    Avatar(u32),
    /// A joint of the outfit's rig, which several garments may share.
    Own(u32),
}

impl Garments<'_> {
    fn write(&mut self, edit: &mut Edit, dressed: &[Dressed]) -> bespoke_gltf::Result<()> {
        let count = self.avatar.rig.joints.len() as u32;
        let joint = |garment: &Dressed, joint: u32| match joint.checked_sub(count) {
            None => Joint::Avatar(joint),
            Some(added) => Joint::Own(garment.fitted.added[added as usize].source),
        };
        for garment in dressed {
            for v in 0..garment.fitted.skin.vertex_count() {
                for &(j, _) in garment.fitted.skin.weights(v) {
                    self.joints.insert(joint(garment, j), 0);
                }
            }
        }
        (0..).zip(self.joints.values_mut()).for_each(|(index, place)| *place = index);
        let skin = self.skin(edit, dressed, &joint)?;
        for garment in dressed {
            let place = |j: u32| self.joints[&joint(garment, j)];
            let rows: Vec<Vec<(u32, f64)>> = (0..garment.fitted.skin.vertex_count())
                .map(|v| garment.fitted.skin.weights(v).iter().map(|&(j, weight)| (place(j), weight)).collect())
                .collect();
            let mesh = self.mesh(edit, garment, &rows)?;
            edit.add_node(&garment.garment.name, mesh, Some(skin), None)?;
        }
        Ok(())
    }

    /// One skin for all garments, with the joints that move them. Joints that came along become nodes below the avatar's.
    fn skin(
        &self,
        edit: &mut Edit,
        dressed: &[Dressed],
        joint: &impl Fn(&Dressed, u32) -> Joint,
    ) -> bespoke_gltf::Result<usize> {
        let mut nodes: HashMap<Joint, usize> = HashMap::new();
        let mut binds: HashMap<Joint, DAffine3> = HashMap::new();
        for (index, (&node, rig)) in (0..).zip(self.avatar.joint_nodes.iter().zip(&self.avatar.rig.joints)) {
            nodes.insert(Joint::Avatar(index), node);
            binds.insert(Joint::Avatar(index), DAffine3::from_mat4(rig.bind));
        }
        for garment in dressed {
            for added in &garment.fitted.added {
                let own = Joint::Own(added.source);
                if nodes.contains_key(&own) {
                    continue;
                }
                let parent = added.parent.map(|parent| joint(garment, parent));
                let above = parent.map_or(DAffine3::IDENTITY, |parent| binds[&parent]);
                let (scale, rotation, translation) = (above.inverse() * added.bind).to_scale_rotation_translation();
                let name = &self.outfit.rig.joints[added.source as usize].name;
                let node = json!({
                    "name": name,
                    "translation": translation.to_array(),
                    "rotation": rotation.to_array(),
                    "scale": scale.to_array(),
                });
                nodes.insert(own, edit.hang(node, parent.map(|parent| nodes[&parent]))?);
                binds.insert(own, added.bind);
            }
        }
        let used: Vec<usize> = self.joints.keys().map(|joint| nodes[joint]).collect();
        let inverse = |joint: &Joint| DMat4::from(binds[joint].inverse()).to_cols_array_2d();
        let inverses: Vec<_> = self.joints.keys().map(inverse).collect();
        edit.add_skin(SKIN, &used, &inverses)
    }

    /// The mesh of one garment: primitives as the outfit has them, with new positions, normals and weights.
    fn mesh(&mut self, edit: &mut Edit, dressed: &Dressed, rows: &[Vec<(u32, f64)>]) -> bespoke_gltf::Result<usize> {
        let parts: Vec<&Part> = dressed.garment.parts.iter().map(|&part| &self.outfit.parts[part]).collect();
        let mut first = 0;
        let mut firsts = Vec::with_capacity(parts.len());
        for part in &parts {
            firsts.push(first);
            first += part.vertices.len();
        }
        // Primitives with the same vertices share their attributes, here as in the outfit's file.
        let mut shared: HashMap<usize, Attributes> = HashMap::new();
        let mut primitives = Vec::new();
        let mut triangle = 0;
        for part in &parts {
            let range = part.primitive.vertices.clone();
            let attributes = match shared.get(&range.start) {
                Some(known) => known.clone(),
                None => {
                    let of_range = parts
                        .iter()
                        .zip(&firsts)
                        .filter(|(p, _)| p.instance == part.instance && p.primitive.vertices.start == range.start);
                    let made = self.attributes(edit, dressed, rows, part, of_range.map(|(p, &f)| (*p, f)))?;
                    shared.insert(range.start, made.clone());
                    made
                }
            };
            let local: Vec<[u32; 3]> =
                part.triangles.iter().map(|t| t.map(|v| part.vertices[v as usize] - range.start as u32)).collect();
            let mut primitive = json!({ "attributes": attributes.vertices, "indices": edit.add_triangles(&local)? });
            if !attributes.targets.is_empty() {
                primitive["targets"] = attributes.targets.into();
            }
            if let Some(material) = part.primitive.material {
                primitive["material"] = self.import.material(edit, material)?.into();
            }
            let source = &self.outfit.document.json()["meshes"][part.mesh]["primitives"][part.primitive.index];
            if let Some(extras) = source.get("extras") {
                primitive["extras"] = extras.clone();
            }
            let last = triangle + part.triangles.len() as u32;
            let caps = dressed.fitted.caps.iter().filter(|t| (triangle..last).contains(t)).map(|t| t - triangle);
            caps::write(&mut primitive, caps.collect());
            triangle = last;
            primitives.push(primitive);
        }
        let mut mesh = json!({ "name": dressed.garment.name, "primitives": primitives });
        let source = &self.outfit.document.json()["meshes"][parts[0].mesh];
        // Names and weights of the morph targets are here.
        for key in ["weights", "extras"] {
            if let Some(value) = source.get(key) {
                mesh[key] = value.clone();
            }
        }
        edit.push("meshes", mesh)
    }

    /// The attributes of the vertices of `part` in its file: new ones from the parts that share them, each with the place of its
    /// first vertex in the garment, and the others as they are.
    fn attributes<'p>(
        &mut self,
        edit: &mut Edit,
        dressed: &Dressed,
        rows: &[Vec<(u32, f64)>],
        part: &Part,
        sharing: impl Iterator<Item = (&'p Part, usize)>,
    ) -> bespoke_gltf::Result<Attributes> {
        let range = part.primitive.vertices.clone();
        // Which vertex of the garment each vertex is. One that no triangle uses goes with the part's first.
        let mut of_garment = vec![None; range.len()];
        for (other, first) in sharing {
            for (k, &v) in other.vertices.iter().enumerate() {
                of_garment[v as usize - range.start].get_or_insert(first + k);
            }
        }
        let some = of_garment.iter().flatten().next().copied().unwrap_or(0);
        let of_garment: Vec<usize> = of_garment.into_iter().map(|v| v.unwrap_or(some)).collect();
        let fitted = &dressed.fitted;
        let mut attributes = serde_json::Map::new();
        let positions: Vec<[f64; 3]> = of_garment.iter().map(|&v| fitted.positions[v].to_array()).collect();
        attributes.insert("POSITION".into(), edit.add_positions(&positions)?.into());
        let normals: Vec<[f64; 3]> = of_garment.iter().map(|&v| fitted.normals[v].to_array()).collect();
        attributes.insert("NORMAL".into(), edit.add_attribute(&normals)?.into());
        if !fitted.tangents.is_empty() {
            let tangents: Vec<[f64; 4]> = of_garment.iter().map(|&v| fitted.tangents[v].to_array()).collect();
            attributes.insert("TANGENT".into(), edit.add_attribute(&tangents)?.into());
        }
        for (name, accessor) in &part.primitive.attributes {
            let is_new = ["POSITION", "NORMAL", "TANGENT"].contains(&name.as_str());
            if !is_new && !name.starts_with("JOINTS_") && !name.starts_with("WEIGHTS_") {
                attributes.insert(name.clone(), self.import.accessor(edit, *accessor, Some(VERTICES))?.into());
            }
        }
        let influences: Vec<Vec<(u32, f64)>> = of_garment.iter().map(|&v| rows[v].clone()).collect();
        for (set, (joints, weights)) in edit.add_influences(&influences)?.into_iter().enumerate() {
            attributes.insert(format!("JOINTS_{set}"), joints.into());
            attributes.insert(format!("WEIGHTS_{set}"), weights.into());
        }
        let mut targets = Vec::with_capacity(fitted.morphs.len());
        for offsets in &fitted.morphs {
            let moved = (0u32..).zip(&of_garment).filter(|(_, v)| offsets[**v] != DVec3::ZERO);
            let deltas: Vec<(u32, [f64; 3])> = moved.map(|(row, &v)| (row, offsets[v].to_array())).collect();
            targets.push(json!({ "POSITION": edit.add_deltas(of_garment.len(), &deltas)? }));
        }
        Ok(Attributes { vertices: Value::Object(attributes), targets })
    }
}

/// The attributes of vertices that primitives share.
#[derive(Clone)]
struct Attributes {
    vertices: Value,
    /// What each morph target adds.
    targets: Vec<Value>,
}
