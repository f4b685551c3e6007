//! The tree of nodes, with where each stands in the file's rest pose.

use glam::{DAffine3, DMat4, DQuat, DVec3};

use crate::document::Document;
use crate::error::Result;
use crate::json::At;

/// A transform to columns, each of four numbers, as glTF writes it.
pub type Matrix = [[f64; 4]; 4];

/// Where a node stands beside its parent.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Local {
    /// Its translation.
    pub translation: [f64; 3],
    /// Its rotation, a quaternion x, y, z, w of length 1.
    pub rotation: [f64; 4],
    /// Its scale.
    pub scale: [f64; 3],
}

/// A node.
#[derive(Clone, Debug)]
pub struct Node {
    /// Empty where it has none.
    pub name: String,
    /// The node above.
    pub parent: Option<usize>,
    /// The nodes below, in the file's order.
    pub children: Vec<usize>,
    /// Its mesh.
    pub mesh: Option<usize>,
    /// The skin of its mesh.
    pub skin: Option<usize>,
    /// Beside its parent; none where the file has a matrix.
    pub local: Option<Local>,
    /// The same as a matrix.
    pub local_matrix: Matrix,
    /// From its own space to the file's, in the rest pose.
    pub world: Matrix,
    /// Whether the default scene shows it (the first one where the file names none; every node where it has no scene).
    pub in_scene: bool,
}

/// All nodes of a file.
#[derive(Clone, Debug, Default)]
pub struct Nodes {
    /// By their index in the file.
    pub all: Vec<Node>,
    /// Their indices, parents before their children, trees and children in the file's order.
    pub order: Vec<usize>,
    /// For each, the top of its tree.
    pub root: Vec<usize>,
}

impl Local {
    /// As a matrix.
    #[must_use]
    pub fn matrix(&self) -> Matrix {
        columns(&DAffine3::from_scale_rotation_translation(
            DVec3::from_array(self.scale),
            DQuat::from_array(self.rotation),
            DVec3::from_array(self.translation),
        ))
    }
}

pub(crate) fn affine(matrix: &Matrix) -> DAffine3 {
    DAffine3::from_mat4(DMat4::from_cols_array_2d(matrix))
}

pub(crate) fn columns(transform: &DAffine3) -> Matrix {
    DMat4::from(*transform).to_cols_array_2d()
}

/// Sixteen numbers as a transform; none where they are no affine one.
pub(crate) fn from_sixteen(numbers: &[f64; 16]) -> Option<DAffine3> {
    let matrix = DMat4::from_cols_array(numbers);
    let last = matrix.row(3) - glam::DVec4::W;
    (last.abs().max_element() < 1e-4).then(|| DAffine3::from_mat4(matrix))
}

fn read_local(node: &At) -> Result<(Option<Local>, DAffine3)> {
    if let Some(at) = node.get("matrix") {
        let transform = from_sixteen(&at.numbers()?);
        return Ok((None, transform.ok_or_else(|| at.error("is no affine transform: its last row is not 0 0 0 1"))?));
    }
    let translation = node.get("translation").map_or(Ok([0.0; 3]), |at| at.numbers())?;
    let scale = node.get("scale").map_or(Ok([1.0; 3]), |at| at.numbers())?;
    let rotation = match node.get("rotation") {
        Some(at) => {
            let turn = DQuat::from_array(at.numbers()?);
            // Its length is 1 but for the rounding of 32 bits.
            if !(0.9..1.1).contains(&turn.length()) {
                return Err(at.error(format!("is no rotation: its length is {}, not 1", turn.length())));
            }
            turn.normalize().to_array()
        }
        None => [0.0, 0.0, 0.0, 1.0],
    };
    let local = Local { translation, rotation, scale };
    Ok((Some(local), affine(&local.matrix())))
}

impl Document {
    /// The nodes of the file.
    ///
    /// # Errors
    /// Where an index is none, a node lies below itself or below two others, or a transform is not finite.
    pub fn nodes(&self) -> Result<Nodes> {
        let entries = self.root().list_of("nodes")?;
        let (meshes, skins) = (self.count("meshes")?, self.count("skins")?);
        let mut all = Vec::with_capacity(entries.len());
        let mut transforms = Vec::with_capacity(entries.len());
        for at in &entries {
            let (local, transform) = read_local(at)?;
            let child = |at: At| at.index_into("nodes", entries.len());
            let children = at.list_of("children")?.into_iter().map(child).collect::<Result<_>>()?;
            transforms.push(transform);
            all.push(Node {
                name: at.text_of("name").to_owned(),
                parent: None,
                children,
                mesh: at.index("mesh", "meshes", meshes)?,
                skin: at.index("skin", "skins", skins)?,
                local,
                local_matrix: columns(&transform),
                world: columns(&transform),
                in_scene: false,
            });
        }
        for node in 0..all.len() {
            for place in 0..all[node].children.len() {
                let child = all[node].children[place];
                let at = |message| crate::Error::json(format!("/nodes/{node}/children/{place}"), message);
                if let Some(other) = all[child].parent.replace(node) {
                    return Err(at(format!("node {child} is below node {other} too; the nodes must be trees")));
                }
            }
        }
        let mut nodes = Nodes { order: Vec::with_capacity(all.len()), root: vec![usize::MAX; all.len()], all };
        let mut open: Vec<usize> =
            (0..nodes.all.len()).rev().filter(|&node| nodes.all[node].parent.is_none()).collect();
        while let Some(node) = open.pop() {
            nodes.order.push(node);
            let mut world = transforms[node];
            nodes.root[node] = node;
            if let Some(parent) = nodes.all[node].parent {
                world = affine(&nodes.all[parent].world) * world;
                nodes.root[node] = nodes.root[parent];
            }
            if !world.is_finite() {
                return Err(entries[node].error("its place, through all nodes above it, is not finite"));
            }
            nodes.all[node].world = columns(&world);
            open.extend(nodes.all[node].children.iter().rev());
        }
        // What has a parent and is below no root goes round in a circle.
        if let Some(node) = (0..nodes.all.len()).find(|&node| nodes.root[node] == usize::MAX) {
            return Err(entries[node].error("lies below itself; the nodes must be trees"));
        }
        self.mark_scene(&mut nodes)?;
        Ok(nodes)
    }

    fn mark_scene(&self, nodes: &mut Nodes) -> Result<()> {
        let scenes = self.count("scenes")?;
        let shown = self.root().index("scene", "scenes", scenes)?.unwrap_or(0);
        let roots: Vec<usize> = match self.root().entry("scenes", shown) {
            None => nodes.order.iter().copied().filter(|&node| nodes.all[node].parent.is_none()).collect(),
            Some(scene) => {
                let root = |at: At| at.index_into("nodes", nodes.all.len());
                scene.list_of("nodes")?.into_iter().map(root).collect::<Result<_>>()?
            }
        };
        let mut open = roots;
        while let Some(node) = open.pop() {
            if !std::mem::replace(&mut nodes.all[node].in_scene, true) {
                open.extend(&nodes.all[node].children);
            }
        }
        Ok(())
    }
}
