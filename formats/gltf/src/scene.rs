//! All that a file shows, in one space: rigs, the meshes on them in their bind pose, and meshes on none.

use std::collections::HashMap;

use glam::{DAffine3, DMat3, DVec3};

use crate::bind::binds;
use crate::document::Document;
use crate::error::{Error, Result};
use crate::humanoid::Humanoid;
use crate::mesh::{self, Mesh};
use crate::nodes::{Matrix, Nodes, affine, columns};
use crate::reader::Reader;
use crate::skin::Skin;

/// A joint: a node of a skin, a bone of the humanoid map, or a node without a mesh below such a one.
#[derive(Clone, Debug)]
pub struct Joint {
    /// Its node.
    pub node: usize,
    /// Name of the node; empty where it has none.
    pub name: String,
    /// Index of the nearest joint among the nodes above it; it comes before this one.
    pub parent: Option<usize>,
    /// From the joint's own space to the file's, in the bind pose: the inverse of its bind matrix, put where the skin stood.
    pub bind: Matrix,
    /// The same in the pose in which the file's nodes stand.
    pub rest: Matrix,
    /// Whether it is in a skin; the bind transforms of others follow from those.
    pub in_skin: bool,
    /// Its bone in the file's humanoid map, by the names of VRM 1.
    pub bone: Option<String>,
}

/// A mesh at a node.
#[derive(Clone, Debug)]
pub struct Instance {
    /// The node.
    pub node: usize,
    /// Its name, or that of the mesh where it has none.
    pub name: String,
    /// Index of the mesh.
    pub mesh: usize,
    /// Index of its skin; none where it hangs on a joint, or on none.
    pub skin: Option<usize>,
    /// Its vertices and triangles. Positions and morph deltas are in the file's space in the bind pose (of a mesh on no rig,
    /// in the rest pose); influences are indices of the rig's joints, weights sum to 1, and there are none on no rig.
    pub geometry: Mesh,
    /// From the mesh's own space to the file's. Where joints were bound in several spaces it differs from vertex to vertex,
    /// and there is none.
    pub placed: Option<Matrix>,
    /// Whether the file's triangles are turned around here, because its transform mirrors.
    pub mirrored: bool,
}

/// A rig: the joints of one tree of nodes, and the meshes on it.
#[derive(Clone, Debug)]
pub struct Character {
    /// The top of the tree.
    pub root: usize,
    /// Parents before their children.
    pub joints: Vec<Joint>,
    /// The meshes with a skin, and those that hang on a joint.
    pub meshes: Vec<Instance>,
}

impl Character {
    /// The joint that a node is.
    #[must_use]
    pub fn joint_of(&self, node: usize) -> Option<usize> {
        self.joints.iter().position(|joint| joint.node == node)
    }
}

/// What a file shows.
#[derive(Clone, Debug)]
pub struct Scene {
    /// The nodes.
    pub nodes: Nodes,
    /// The skins.
    pub skins: Vec<Skin>,
    /// The humanoid map of a VRM file.
    pub humanoid: Option<Humanoid>,
    /// The rigs, those with most vertices first.
    pub characters: Vec<Character>,
    /// Meshes on no rig.
    pub loose: Vec<Instance>,
    /// What was passed over or put right, in sentences.
    pub notes: Vec<String>,
}

impl Document {
    /// Reads all that the default scene shows.
    ///
    /// Vertices are placed by the bind matrices, not by the pose in which the nodes rest: where the two differ, the bind pose
    /// is the one in which weights and shape belong together. The whole rig is put where most of its joints rest as they were
    /// bound.
    ///
    /// # Errors
    /// Where anything that is read for it is wrong, see [`Document::mesh`], [`Document::nodes`], [`Document::skins`].
    pub fn scene(&self) -> Result<Scene> {
        let (nodes, skins, humanoid) = (self.nodes()?, self.skins()?, self.humanoid()?);
        let mut placed = Placed::new(&nodes, &skins, humanoid.as_ref());
        let reader = Reader::new(self);
        let mut read: HashMap<usize, Mesh> = HashMap::new();
        let (mut by_root, mut loose): (HashMap<usize, Vec<Instance>>, Vec<Instance>) = Default::default();
        let mut notes = Vec::new();
        for &node in &nodes.order {
            let Some(mesh) = nodes.all[node].mesh.filter(|_| nodes.all[node].in_scene) else { continue };
            let mesh_at = self.entry("meshes", mesh)?;
            let geometry = match read.entry(mesh) {
                std::collections::hash_map::Entry::Occupied(known) => known.into_mut(),
                std::collections::hash_map::Entry::Vacant(new) => {
                    let mut geometry = mesh::read(&reader, mesh)?;
                    notes.append(&mut geometry.notes);
                    new.insert(geometry)
                }
            };
            reader.take(&mesh_at, memory(geometry))?;
            let mut geometry = geometry.clone();
            for (k, weight) in self.entry("nodes", node)?.list_of("weights")?.iter().enumerate() {
                if let Some(morph) = geometry.morphs.get_mut(k) {
                    morph.weight = weight.number()?;
                }
            }
            let instance = placed.instance(node, mesh, geometry).map_err(|reason| mesh_at.error(reason))?;
            match placed.joint_at[node].is_some() || instance.skin.is_some() {
                true => by_root.entry(placed.rig_of(node, instance.skin)).or_default().push(instance),
                false => loose.push(instance),
            }
        }
        let mut characters: Vec<Character> = Vec::new();
        for (root, joints) in std::mem::take(&mut placed.joints) {
            let shown = joints.iter().any(|joint| nodes.all[joint.node].in_scene);
            let meshes = by_root.remove(&root).unwrap_or_default();
            if shown || !meshes.is_empty() {
                characters.push(Character { root, joints, meshes });
            }
        }
        let vertices = |c: &Character| c.meshes.iter().map(|m| m.geometry.positions.len()).sum::<usize>();
        characters.sort_by_key(|c| (std::cmp::Reverse(vertices(c)), c.root));
        Ok(Scene { nodes, skins, humanoid, characters, loose, notes })
    }
}

/// About how many bytes a mesh takes.
fn memory(mesh: &Mesh) -> usize {
    let influences: usize = mesh.influences.iter().map(|own| 24 + 16 * own.len()).sum();
    let deltas: usize = mesh.morphs.iter().map(|morph| 32 * morph.deltas.len()).sum();
    24 * mesh.positions.len() + 12 * mesh.triangles.len() + influences + deltas
}

/// The joints of all rigs, and what meshes are placed with.
struct Placed<'a> {
    nodes: &'a Nodes,
    skins: &'a [Skin],
    /// For each root the joints of its tree.
    joints: Vec<(usize, Vec<Joint>)>,
    /// Index in `joints` by root.
    rig: HashMap<usize, usize>,
    /// For each node, the joint at it or nearest above.
    joint_at: Vec<Option<usize>>,
}

impl<'a> Placed<'a> {
    fn new(nodes: &'a Nodes, skins: &'a [Skin], humanoid: Option<&Humanoid>) -> Self {
        let shown = nodes.all.iter().filter(|node| node.in_scene && node.mesh.is_some());
        let mut used: Vec<usize> = shown.filter_map(|node| node.skin).collect();
        used.sort_unstable();
        used.dedup();
        let binds = binds(nodes, skins, &used);
        let bones: HashMap<usize, &str> =
            humanoid.iter().flat_map(|map| map.bones.iter().map(|(bone, node)| (*node, bone.as_str()))).collect();
        let above = bound_below(nodes, &binds);

        let mut placed =
            Self { nodes, skins, joints: Vec::new(), rig: HashMap::new(), joint_at: vec![None; nodes.all.len()] };
        for &node in &nodes.order {
            let here = &nodes.all[node];
            let parent = here.parent.and_then(|parent| placed.joint_at[parent]);
            let rest = affine(&here.world);
            let root = nodes.root[node];
            // Nodes of the tree that are in no skin follow the joint above, or the one below.
            let follow = |own: &DAffine3, bind: &DAffine3| {
                let moved = *bind * own.inverse() * rest;
                if moved.is_finite() { moved } else { rest }
            };
            let parent_joint = parent.map(|parent| &placed.joints[placed.rig[&root]].1[parent]);
            let bone = bones.get(&node).map(|bone| (*bone).to_owned());
            let is_end = parent.is_some() && here.mesh.is_none();
            let bind = match (binds.get(&node), parent_joint) {
                (Some(bind), _) => *bind,
                (None, Some(parent)) if is_end || bone.is_some() => {
                    follow(&affine(&parent.rest), &affine(&parent.bind))
                }
                (None, None) if bone.is_some() => {
                    let below = above.get(&node).map(|below| follow(&affine(&nodes.all[*below].world), &binds[below]));
                    below.unwrap_or(rest)
                }
                _ => {
                    placed.joint_at[node] = parent;
                    continue;
                }
            };
            let rig = *placed.rig.entry(root).or_insert_with(|| {
                placed.joints.push((root, Vec::new()));
                placed.joints.len() - 1
            });
            let joints = &mut placed.joints[rig].1;
            placed.joint_at[node] = Some(joints.len());
            joints.push(Joint {
                node,
                name: here.name.clone(),
                parent,
                bind: columns(&bind),
                rest: columns(&rest),
                in_skin: binds.contains_key(&node),
                bone,
            });
        }
        placed
    }

    /// The root of the rig that a mesh is on: that of its skin's joints, else that of its node.
    fn rig_of(&self, node: usize, skin: Option<usize>) -> usize {
        self.nodes.root[skin.map_or(node, |skin| self.skins[skin].joints[0])]
    }

    /// A mesh in its place.
    fn instance(&self, node: usize, mesh: usize, geometry: Mesh) -> std::result::Result<Instance, String> {
        let here = &self.nodes.all[node];
        let name = if here.name.is_empty() { geometry.name.clone() } else { here.name.clone() };
        let mut instance = Instance { node, name, mesh, skin: here.skin, geometry, placed: None, mirrored: false };
        let rest = affine(&here.world);
        let count = instance.geometry.positions.len();
        match here.skin {
            // A skin without weights does nothing.
            Some(skin) if !instance.geometry.influences.is_empty() => self.skinned(&mut instance, skin)?,
            _ => {
                instance.skin = None;
                let mut place = rest;
                instance.geometry.influences = Vec::new();
                if let Some(joint) = self.joint_at[node] {
                    let joint_of = &self.joints[self.rig[&self.nodes.root[node]]].1[joint];
                    let moved = affine(&joint_of.bind) * affine(&joint_of.rest).inverse() * rest;
                    if moved.is_finite() {
                        place = moved;
                    }
                    instance.geometry.influences = vec![vec![(joint as u32, 1.0)]; count];
                }
                instance.place(|_| place);
                instance.placed = Some(columns(&place));
                instance.turn(place.matrix3.determinant() < 0.0);
            }
        }
        Ok(instance)
    }

    fn skinned(&self, instance: &mut Instance, skin: usize) -> std::result::Result<(), String> {
        let skin = &self.skins[skin];
        let root = self.nodes.root[skin.joints[0]];
        if let Some(other) = skin.joints.iter().find(|joint| self.nodes.root[**joint] != root) {
            return Err(format!("the joints {} and {other} of its skin are nodes of two trees", skin.joints[0]));
        }
        let joints = self.rig.get(&root).map(|rig| &self.joints[*rig].1);
        // For each joint of the skin: its place in the rig's list, and from the mesh's space to the world.
        let of_joint = |(&node, inverse): (&usize, &Matrix)| {
            let joint = self.joint_at[node].filter(|&joint| joints.is_some_and(|all| all[joint].node == node))?;
            Some((joint as u32, affine(&joints?[joint].bind) * affine(inverse)))
        };
        let moves: Vec<Option<(u32, DAffine3)>> = skin.joints.iter().zip(&skin.inverse_binds).map(of_joint).collect();
        let known: Vec<DAffine3> = moves.iter().flatten().map(|(_, place)| *place).collect();
        let first = *known.first().ok_or("no bind matrix of its skin has an inverse")?;
        let apart = |place: &DAffine3| !place.abs_diff_eq(first, 1e-6 * (1.0 + first.translation.length()));
        let in_one_place = !known.iter().any(apart);

        let mut vertex_place = Vec::with_capacity(if in_one_place { 0 } else { instance.geometry.positions.len() });
        for (v, own) in instance.geometry.influences.iter_mut().enumerate() {
            let mut blend = DAffine3 { matrix3: DMat3::ZERO, translation: DVec3::ZERO };
            for (joint, weight) in own.iter_mut() {
                let Some(entry) = moves.get(*joint as usize) else {
                    let said = format!("vertex {v} has a weight on joint {joint}, and its skin has {}", moves.len());
                    return Err(said);
                };
                // A joint without a bind transform does not move.
                let (rig, place) = entry.unwrap_or((0, first));
                *joint = rig;
                blend = DAffine3 {
                    matrix3: blend.matrix3 + *weight * place.matrix3,
                    translation: blend.translation + *weight * place.translation,
                };
            }
            if !in_one_place {
                vertex_place.push(blend);
            }
        }
        if in_one_place {
            instance.placed = Some(columns(&first));
            instance.place(|_| first);
        } else {
            instance.place(|v| vertex_place[v]);
        }
        instance.turn(first.matrix3.determinant() < 0.0);
        Ok(())
    }
}

/// For each node above a joint, a joint below it: the first in the file's order.
fn bound_below(nodes: &Nodes, binds: &HashMap<usize, DAffine3>) -> HashMap<usize, usize> {
    let mut below = HashMap::new();
    for &joint in nodes.order.iter().filter(|node| binds.contains_key(node)) {
        let mut at = nodes.all[joint].parent;
        // Where one is known already, those above it are too.
        while let Some(node) = at.filter(|node| !below.contains_key(node)) {
            below.insert(node, joint);
            at = nodes.all[node].parent;
        }
    }
    below
}

impl Instance {
    /// Takes positions and deltas to another space, for each vertex by its own transform.
    fn place(&mut self, to: impl Fn(usize) -> DAffine3) {
        for (v, p) in self.geometry.positions.iter_mut().enumerate() {
            *p = to(v).transform_point3(DVec3::from_array(*p)).to_array();
        }
        for (v, delta) in self.geometry.morphs.iter_mut().flat_map(|morph| &mut morph.deltas) {
            *delta = to(*v as usize).transform_vector3(DVec3::from_array(*delta)).to_array();
        }
    }

    /// Turns the triangles around where the transform mirrors.
    fn turn(&mut self, mirrored: bool) {
        self.mirrored = mirrored;
        if mirrored {
            self.geometry.triangles.iter_mut().for_each(|[_, b, c]| std::mem::swap(b, c));
        }
    }

    /// An error of this mesh.
    #[must_use]
    pub fn error(&self, message: impl Into<String>) -> Error {
        Error::json(format!("/meshes/{}", self.mesh), message)
    }
}
