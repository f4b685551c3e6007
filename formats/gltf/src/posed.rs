//! Where the vertices of a mesh are in a pose, as a program that shows the file would draw them.

use glam::{DAffine3, DVec3};

use crate::animation::Pose;
use crate::document::Document;
use crate::error::{Error, Result};
use crate::mesh::Mesh;
use crate::nodes::affine;
use crate::scene::{Instance, Scene};

/// A mesh at a node, as the file holds it: vertices, morph targets and influences in its own space, with its skin.
#[derive(Clone, Debug)]
pub struct Posable {
    node: usize,
    index: usize,
    mesh: Mesh,
    /// For each joint of its skin, the node and the transform from the mesh's space to the joint's.
    joints: Vec<(usize, DAffine3)>,
}

impl Document {
    /// What `instance` of this file's `scene` is made of, to be posed.
    ///
    /// # Errors
    /// Those of [`Document::mesh`], and where a weight is on a joint that its skin does not have.
    pub fn posable(&self, scene: &Scene, instance: &Instance) -> Result<Posable> {
        let mut mesh = self.mesh(instance.mesh)?;
        // The weights of the morph targets may be the node's own.
        for (morph, own) in mesh.morphs.iter_mut().zip(&instance.geometry.morphs) {
            morph.weight = own.weight;
        }
        let joints: Vec<(usize, DAffine3)> = match instance.skin {
            Some(skin) => {
                let skin = &scene.skins[skin];
                skin.joints.iter().copied().zip(skin.inverse_binds.iter().map(affine)).collect()
            }
            None => Vec::new(),
        };
        if instance.skin.is_some()
            && let Some(v) = mesh.influences.iter().position(|own| own.iter().any(|&(j, _)| j as usize >= joints.len()))
        {
            return Err(
                instance.error(format!("vertex {v} has a weight on a joint beyond its skin's {}", joints.len()))
            );
        }
        Ok(Posable { node: instance.node, index: instance.mesh, mesh, joints })
    }
}

impl Posable {
    /// The positions of all vertices in the file's space: morph targets by their weights, then linear blend skinning.
    ///
    /// # Errors
    /// Where one is not finite.
    pub fn positions(&self, pose: &Pose) -> Result<Vec<[f64; 3]>> {
        let mut positions: Vec<DVec3> = self.mesh.positions.iter().copied().map(DVec3::from_array).collect();
        let animated = pose.weights.get(&self.node);
        for (k, morph) in self.mesh.morphs.iter().enumerate() {
            let weight = animated.and_then(|weights| weights.get(k)).copied().unwrap_or(morph.weight);
            if weight != 0.0 {
                morph.deltas.iter().for_each(|(v, delta)| positions[*v as usize] += weight * DVec3::from_array(*delta));
            }
        }
        if self.joints.is_empty() {
            let place = affine(&pose.world[self.node]);
            positions.iter_mut().for_each(|p| *p = place.transform_point3(*p));
        } else {
            let moves: Vec<DAffine3> =
                self.joints.iter().map(|(node, inverse)| affine(&pose.world[*node]) * *inverse).collect();
            for (p, own) in positions.iter_mut().zip(&self.mesh.influences) {
                *p = own.iter().map(|&(joint, weight)| weight * moves[joint as usize].transform_point3(*p)).sum();
            }
        }
        if let Some(v) = positions.iter().position(|p| !p.is_finite()) {
            return Err(Error::json(format!("/meshes/{}", self.index), format!("vertex {v} is nowhere in this pose")));
        }
        Ok(positions.into_iter().map(DVec3::into).collect())
    }
}
