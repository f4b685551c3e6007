//! Bodies put together from parts: each a closed mesh that moves with a joint of its own.

use glam::{DAffine3, DMat3, DVec3};

use super::Sample;
use super::implicit::Field;
use super::mesh::Mesh;
use super::skeleton::{ARMS, JOINTS, LEGS, Skeleton};
use super::surface::Design;
use super::texture::Texture;

/// The parts so far.
#[derive(Clone, Debug)]
pub struct Parts {
    mesh: Mesh,
    skin: Vec<Vec<f64>>,
}

impl Default for Parts {
    fn default() -> Self {
        Self { mesh: Mesh::default(), skin: vec![Vec::new(); JOINTS] }
    }
}

impl Parts {
    /// Adds a part that moves with one joint.
    pub fn add(&mut self, part: &Mesh, joint: usize) {
        self.add_between(part, [joint, joint], |_| 0.0);
    }

    /// Adds a part of the left side and its mirror image, which moves with the joint across.
    pub fn add_pair(&mut self, left: &Mesh, joint: usize) {
        self.add(left, joint);
        self.add(&mirrored(left), across(joint));
    }

    /// Adds a part that hangs between two joints: `weight` of the second, from 0 to 1, at each point.
    pub fn add_between(&mut self, part: &Mesh, joints: [usize; 2], weight: impl Fn(DVec3) -> f64) {
        for &p in &part.positions {
            let t = weight(p).clamp(0.0, 1.0);
            for row in &mut self.skin {
                row.push(0.0);
            }
            let last = self.skin[0].len() - 1;
            self.skin[joints[0]][last] += 1.0 - t;
            self.skin[joints[1]][last] += t;
        }
        self.mesh.append(part);
    }

    /// Adds a part of the left side that hangs between two joints, and its mirror image.
    pub fn add_pair_between(&mut self, left: &Mesh, joints: [usize; 2], weight: impl Fn(DVec3) -> f64) {
        self.add_between(left, joints, &weight);
        self.add_between(&mirrored(left), joints.map(across), |p| weight(DVec3::new(-p.x, p.y, p.z)));
    }

    /// Adds a part with skin weights of its own, one row a joint.
    pub fn add_skinned(&mut self, part: &Mesh, skin: Vec<Vec<f64>>) {
        for (row, more) in self.skin.iter_mut().zip(skin) {
            row.extend(more);
        }
        self.mesh.append(part);
    }

    /// The body.
    pub fn sample(self, skeleton: Skeleton) -> Sample {
        let (mesh, skin) = (self.mesh, self.skin);
        Sample { mesh, skeleton, skin, texture: Texture::default(), no_fit: Vec::new() }
    }
}

/// The joint on the other side; joints of the trunk are their own.
pub fn across(joint: usize) -> usize {
    let pairs = ARMS[0].into_iter().zip(ARMS[1]).chain(LEGS[0].into_iter().zip(LEGS[1]));
    let mut both = pairs.flat_map(|(left, right)| [(left, right), (right, left)]);
    both.find(|(from, _)| *from == joint).map_or(joint, |(_, to)| to)
}

/// The mirror image on the other side of the body.
pub fn mirrored(mesh: &Mesh) -> Mesh {
    Mesh {
        positions: mesh.positions.iter().map(|p| DVec3::new(-p.x, p.y, p.z)).collect(),
        triangles: mesh.triangles.iter().map(|&[a, b, c]| [a, c, b]).collect(),
    }
}

/// The mesh after a motion.
pub fn moved(mesh: &Mesh, motion: &DAffine3) -> Mesh {
    let positions = mesh.positions.iter().map(|&p| motion.transform_point3(p)).collect();
    Mesh { positions, triangles: mesh.triangles.clone() }
}

/// The motion that brings the origin to `place`, z to `along` and x as near to `side` as can be.
pub fn placed(place: DVec3, along: DVec3, side: DVec3) -> DAffine3 {
    let z = along.normalize();
    let x = side.reject_from_normalized(z).normalize();
    DAffine3::from_mat3_translation(DMat3::from_cols(x, z.cross(x), z), place)
}

/// Meshes the largest component of a (finished) solid with edges of about `edge_length` metres at each point.
pub fn modelled(solid: &Field, cell: f64, edge_length: impl Fn(DVec3) -> f64 + Sync) -> Mesh {
    let function = |p: DVec3| solid.value(p);
    let (bounds, cuts) = (solid.bounds(), Vec::new());
    Design { solid: Box::new(function), cuts, edge_length: Box::new(edge_length), bounds, cell, rounds: 3 }.mesh()
}
