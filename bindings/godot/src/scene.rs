//! What a scene holds: meshes with their places, skeletons, bone maps.

use std::collections::HashMap;

use glam::DAffine3;
use godot::builtin::{AnyArray, StringName, Transform3D, Variant};
use godot::classes::{Mesh, Node, Node3D, Object, Resource};
use godot::obj::Gd;

use crate::engine::{self, affine, ask, ask_object, is};
use crate::session::{Failure, Joint, Result};

/// A mesh that the user gave, and the node that shows it.
#[derive(Clone)]
pub struct Shown {
    /// The node, where it is one.
    pub node: Option<engine::Node>,
    /// The mesh.
    pub mesh: Gd<Mesh>,
    /// In words, for messages.
    pub name: String,
}

/// The meshes in `value`: a MeshInstance3D, a mesh, or an array of these.
///
/// # Errors
/// It is none of them, was freed, or has no mesh. `what` says which input it is.
pub fn meshes(value: &Variant, what: &str) -> Result<Vec<Shown>> {
    if let Ok(list) = value.try_to::<AnyArray>() {
        let all = list.iter_shared().map(|one| meshes(&one, what)).collect::<Result<Vec<_>>>()?;
        return Ok(all.into_iter().flatten().collect());
    }
    let no_mesh =
        || Failure::mesh(format!("{what}: it is no MeshInstance3D and no mesh, or it was freed; set it again"));
    let object = value.try_to::<Gd<Object>>().map_err(|_| no_mesh())?;
    if !object.is_instance_valid() {
        return Err(no_mesh());
    }
    if let Ok(mesh) = object.clone().try_cast::<Mesh>() {
        return Ok(vec![Shown { node: None, mesh, name: what.to_string() }]);
    }
    if !is(&object, "MeshInstance3D") {
        return Err(no_mesh());
    }
    let node = object.try_cast::<Node3D>().map_err(|_| no_mesh())?;
    let name = format!("{what} '{}'", node.get_name());
    let mesh = ask_object::<Mesh>(&node, "get_mesh", &[])
        .ok_or_else(|| Failure::mesh(format!("{name}: the node has no mesh")))?;
    Ok(vec![Shown { node: Some(engine::Node::new(&node)), mesh, name }])
}

/// The Skeleton3D that moves a MeshInstance3D: by its skin, or by a BoneAttachment3D above it.
pub fn skeleton_of(node: &Gd<Node3D>) -> Option<Gd<Node3D>> {
    let path = node.get("skeleton");
    let named = match path.to_string().is_empty() {
        true => None,
        false => ask_object::<Node3D>(node, "get_node_or_null", &[path]),
    };
    if let Some(named) = named.filter(|found| is(found, "Skeleton3D")) {
        return Some(named);
    }
    let above = |node: &Gd<Node3D>| node.get_parent().and_then(|parent| parent.try_cast::<Node3D>().ok());
    let parent = above(node)?;
    if is(&parent, "Skeleton3D") {
        return Some(parent);
    }
    let mut attachment = parent;
    while !is(&attachment, "BoneAttachment3D") {
        attachment = above(&attachment)?;
    }
    above(&attachment).filter(|found| is(found, "Skeleton3D"))
}

/// From `node` to `skeleton`, where both are in one tree; else they are taken to share their space.
pub fn place(node: engine::Node, skeleton: engine::Node) -> DAffine3 {
    let (Some(node), Some(skeleton)) = (node.get(), skeleton.get()) else { return DAffine3::IDENTITY };
    let (node_place, node_top) = to_top(&node);
    let (skeleton_place, skeleton_top) = to_top(&skeleton);
    if node_top == skeleton_top { skeleton_place.inverse() * node_place } else { DAffine3::IDENTITY }
}

fn to_top(node: &Gd<Node3D>) -> (DAffine3, Gd<Node>) {
    let mut place = affine(node.get_transform());
    let mut top = node.clone().upcast::<Node>();
    let mut is_placed = true;
    while let Some(parent) = top.get_parent() {
        // A node between them without a place of its own begins anew.
        match parent.clone().try_cast::<Node3D>() {
            Ok(parent) if is_placed => place = affine(parent.get_transform()) * place,
            _ => is_placed = false,
        }
        top = parent;
    }
    (place, top)
}

/// The bone that a node without a skin hangs on by a BoneAttachment3D, and from the node to the skeleton as the bone rests.
pub fn hung(node: engine::Node, skeleton: &Skeleton) -> Option<(usize, DAffine3)> {
    let mut below = node.get()?;
    let mut place = affine(below.get_transform());
    loop {
        let above = below.get_parent()?.try_cast::<Node3D>().ok()?;
        if is(&above, "BoneAttachment3D") {
            let name: StringName = ask(&above, "get_bone_name", &[]);
            let bone = skeleton.find(&name.to_string())?;
            return Some((bone, skeleton.rests[bone] * place));
        }
        place = affine(above.get_transform()) * place;
        below = above;
    }
}

/// A skeleton: its bones where they rest.
#[derive(Clone)]
pub struct Skeleton {
    /// The node.
    pub node: engine::Node,
    /// Its name.
    pub name: String,
    /// Names of the bones.
    pub names: Vec<String>,
    /// The bones as the library takes them, named as the bone map says.
    pub joints: Vec<Joint>,
    /// Where the bones rest, in the space of the skeleton.
    pub rests: Vec<DAffine3>,
}

impl Skeleton {
    /// Reads a Skeleton3D, and the bone map for it.
    ///
    /// # Errors
    /// It has no bones, or the bone map is none.
    pub fn read(node: &Gd<Node3D>, bone_map: Option<&Gd<Resource>>, what: &str) -> Result<Self> {
        let count: i64 = ask(node, "get_bone_count", &[]);
        if count == 0 {
            return Err(Failure::skeleton(format!("{what}: skeleton '{}' has no bones", node.get_name())));
        }
        let humanoid = bone_map.map(|map| profile_names(map, what)).transpose()?.unwrap_or_default();
        let (mut names, mut joints, mut rests) = (Vec::new(), Vec::new(), Vec::new());
        for bone in 0..count {
            let bone = [Variant::from(bone)];
            let name = node.clone().upcast::<Object>().call("get_bone_name", &bone).to_string();
            let parent: i64 = ask(node, "get_bone_parent", &bone);
            let rest = affine(ask::<Transform3D>(node, "get_bone_global_rest", &bone));
            joints.push(Joint {
                name: humanoid.get(&name).unwrap_or(&name).clone(),
                parent: u32::try_from(parent).ok(),
                bind: columns(rest),
            });
            names.push(name);
            rests.push(rest);
        }
        Ok(Self { node: engine::Node::new(node), name: node.get_name().to_string(), names, joints, rests })
    }

    /// The bone of this name.
    pub fn find(&self, name: &str) -> Option<usize> {
        self.names.iter().position(|other| other == name)
    }

    /// For each bone the one of the same name in `other`; one that is not there goes with the one above.
    pub fn onto(&self, other: &Self) -> Vec<u32> {
        let there = |mut bone: usize| loop {
            match (other.find(&self.names[bone]), self.joints[bone].parent) {
                (Some(found), _) => return found as u32,
                (None, Some(parent)) => bone = parent as usize,
                (None, None) => return 0,
            }
        };
        (0..self.names.len()).map(there).collect()
    }
}

/// Column after column.
fn columns(affine: DAffine3) -> [f64; 16] {
    glam::DMat4::from(affine).to_cols_array()
}

/// Names of a profile for the bones of a skeleton, by a BoneMap.
fn profile_names(map: &Gd<Resource>, what: &str) -> Result<HashMap<String, String>> {
    if !is(map, "BoneMap") {
        return Err(Failure::argument(format!("{what}: what is set as its bone map is no BoneMap")));
    }
    let profile = ask_object::<Resource>(map, "get_profile", &[]).ok_or_else(|| {
        Failure::argument(format!("{what}: its bone map has no profile; give it a SkeletonProfileHumanoid"))
    })?;
    let count: i64 = ask(&profile, "get_bone_size", &[]);
    let mut names = HashMap::new();
    for k in 0..count {
        let name: StringName = ask(&profile, "get_bone_name", &[Variant::from(k)]);
        let bone: StringName = ask(map, "get_skeleton_bone_name", &[Variant::from(name.clone())]);
        if !bone.is_empty() {
            names.insert(bone.to_string(), name.to_string());
        }
    }
    Ok(names)
}

/// The binds of a MeshInstance3D: which bone each is, and from the mesh's space to that of the bone.
pub struct Binds {
    /// The bone of each bind.
    pub bones: Vec<usize>,
    /// From the mesh to the skeleton as it rests, by each bind.
    pub places: Vec<DAffine3>,
}

impl Binds {
    /// Those of `node`, or where it has no skin, or there is no node, those that the engine makes: one for each bone.
    ///
    /// # Errors
    /// A bind that is no bone.
    pub fn read(shown: &Shown, skeleton: &Skeleton) -> Result<Self> {
        let outer = shown.node.map_or(DAffine3::IDENTITY, |node| place(node, skeleton.node));
        let node = shown.node.and_then(engine::Node::get);
        let skin = node.and_then(|node| ask_object::<Resource>(&node, "get_skin", &[]));
        let Some(skin) = skin else {
            let count = skeleton.rests.len();
            return Ok(Self { bones: (0..count).collect(), places: vec![outer; count] });
        };
        let count: i64 = ask(&skin, "get_bind_count", &[]);
        let (mut bones, mut places) = (Vec::new(), Vec::new());
        for k in 0..count {
            let bind = [Variant::from(k)];
            let name: StringName = ask(&skin, "get_bind_name", &bind);
            let bone = match name.is_empty() {
                true => usize::try_from(ask::<i64>(&skin, "get_bind_bone", &bind)).ok(),
                false => skeleton.find(&name.to_string()),
            };
            let bone = bone.filter(|&bone| bone < skeleton.rests.len()).ok_or_else(|| {
                Failure::skeleton(format!(
                    "{}: bind {k} of its skin ('{name}') is no bone of skeleton '{}'; give it the skeleton that it was \
                     made with",
                    shown.name, skeleton.name
                ))
            })?;
            bones.push(bone);
            places.push(outer * skeleton.rests[bone] * affine(ask::<Transform3D>(&skin, "get_bind_pose", &bind)));
        }
        Ok(Self { bones, places })
    }
}
