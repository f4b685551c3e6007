//! Rigged characters: the closet's bodies on full rigs, in the names and habits of different tools, in any pose.
//!
//! ```text
//! body -> places of all roles -> weights by role -> naming: joints and influences -> pose -> habits of the tool
//! ```

mod bodies;
mod names;
mod places;
mod pose;
mod role;
mod weights;

use std::collections::BTreeMap;

use glam::{DAffine3, DMat3, DVec3};

pub use bodies::Body;
pub use names::Naming;
pub use pose::{Motions, Pose};
pub use role::{FINGERS, Role, SIDES, Side};
pub use weights::INFLUENCES;

use super::Sample;
use super::files::RigLine;
use super::mesh::Mesh;
use weights::largest;

/// A joint of a rig.
#[derive(Clone, Debug, PartialEq)]
pub struct Joint {
    /// As the convention has it; empty where that has none.
    pub name: String,
    /// Index of the joint on which it hangs; that comes before it.
    pub parent: Option<usize>,
    /// From the joint's own space to that of the mesh, in the pose in which the mesh is.
    pub bind: DAffine3,
    /// What it is.
    pub role: Role,
}

/// A mesh on a rig, in a pose that is its bind pose.
#[derive(Clone, Debug)]
pub struct Character {
    /// A body, or what one wears.
    pub mesh: Mesh,
    /// Parents before their children.
    pub joints: Vec<Joint>,
    /// For each vertex at most [`INFLUENCES`] joints with their weights, which sum to 1.
    pub influences: Vec<Vec<(usize, f64)>>,
    /// Where each role is, in the closet's space.
    places: BTreeMap<Role, DVec3>,
    /// From the closet's space (z up, facing -y, metres) to that of the mesh.
    frame: DAffine3,
}

/// The motion from the closet's axes to y up, facing +z.
pub fn y_up() -> DAffine3 {
    DAffine3::from_mat3(DMat3::from_cols(DVec3::X, DVec3::NEG_Z, DVec3::Y))
}

/// Rigs a body as a tool would, in the pose in which it was modelled.
pub fn character(body: &Sample, naming: Naming) -> Character {
    let places = places::places(body);
    let mut joints: Vec<Joint> = Vec::new();
    let mut number: BTreeMap<Role, usize> = BTreeMap::new();
    for role in Role::all() {
        let Some(name) = naming.name(role) else { continue };
        let mut above = naming.hangs_on(role);
        while let Some(missing) = above.filter(|role| !number.contains_key(role)) {
            above = naming.hangs_on(missing);
        }
        number.insert(role, joints.len());
        let bind = DAffine3::from_mat3_translation(axes(naming, role, &places), places[&role]);
        joints.push(Joint { name, parent: above.map(|role| number[&role]), bind, role });
    }
    // What a role would move that the convention lacks, the next one above it moves.
    let present = |role: Role| {
        let mut role = role;
        loop {
            match number.get(&role) {
                Some(joint) => break *joint,
                None => role = role.above().expect("every convention has hips"),
            }
        }
    };
    let influences = weights::weights(body, &places).into_iter().map(|weights| {
        let mut sums = BTreeMap::new();
        for (role, weight) in weights {
            *sums.entry(present(role)).or_insert(0.0) += weight;
        }
        largest(sums)
    });
    Character { influences: influences.collect(), mesh: body.mesh.clone(), joints, places, frame: DAffine3::IDENTITY }
}

/// The axes of a joint, as the tools behind a naming turn them.
fn axes(naming: Naming, role: Role, places: &BTreeMap<Role, DVec3>) -> DMat3 {
    let Some(ahead) = role.ahead() else { return DMat3::IDENTITY };
    let along = (places[&ahead] - places[&role]).normalize();
    let side = if along.y.abs() < 0.9 { DVec3::Y } else { DVec3::X };
    let across = side.reject_from_normalized(along).normalize();
    match naming {
        // x along the bone.
        Naming::Unreal => DMat3::from_cols(along, across, along.cross(across)),
        // Along the world.
        Naming::Vrm | Naming::Unnamed => DMat3::IDENTITY,
        // y along the bone.
        Naming::Mixamo | Naming::Rigify | Naming::FeetOnRoot | Naming::Controls => {
            DMat3::from_cols(along.cross(across), along, across)
        }
    }
}

impl Character {
    /// The joints as [`files::write_rig`](super::files::write_rig) takes them.
    pub fn rig(&self) -> impl Iterator<Item = RigLine<'_>> {
        self.joints.iter().map(|joint| (joint.name.as_str(), joint.parent, joint.bind))
    }

    /// A garment around this body on the same rig, each vertex weighted like the flesh nearest to it.
    pub fn wears(&self, garment: &Mesh) -> Self {
        const NEAREST: usize = 6;
        let vertex = |p: &DVec3| {
            let mut near: Vec<(f64, usize)> =
                self.mesh.positions.iter().enumerate().map(|(v, q)| (p.distance_squared(*q), v)).collect();
            near.select_nth_unstable_by(NEAREST - 1, |a, b| a.0.total_cmp(&b.0));
            let mut sums = BTreeMap::new();
            for &(distance, v) in &near[..NEAREST] {
                for (joint, weight) in &self.influences[v] {
                    *sums.entry(*joint).or_insert(0.0) += weight / (distance + 1e-9);
                }
            }
            let total: f64 = sums.values().sum();
            largest(sums.into_iter().map(|(joint, weight)| (joint, weight / total)))
        };
        Self { influences: garment.positions.iter().map(vertex).collect(), mesh: garment.clone(), ..self.clone() }
    }

    /// How each role moves to a pose, the feet on the floor. A garment moves with the motions of the body in it.
    pub fn motions(&self, pose: &Pose) -> Motions {
        let mut motions = pose::motions(&self.places, pose);
        let to_closet = self.frame.inverse();
        let lowest = |positions: &[DVec3]| {
            positions.iter().map(|&p| to_closet.transform_point3(p).z).fold(f64::INFINITY, f64::min)
        };
        let floor = lowest(&self.mesh.positions) - lowest(&self.moved(&motions).mesh.positions);
        for (role, motion) in &mut motions {
            if ![Role::Root, Role::FeetControl, Role::HandsControl].contains(role) {
                motion.translation.z += floor;
            }
        }
        motions
    }

    /// The same in another pose, which is its bind pose then: joints moved, vertices by linear blend skinning.
    pub fn moved(&self, motions: &Motions) -> Self {
        let back = self.frame.inverse();
        let moves: Vec<DAffine3> = self.joints.iter().map(|joint| self.frame * motions[&joint.role] * back).collect();
        let vertex = |(&p, influences): (&DVec3, &Vec<(usize, f64)>)| {
            influences.iter().map(|&(joint, weight)| weight * moves[joint].transform_point3(p)).sum()
        };
        let positions = self.mesh.positions.iter().zip(&self.influences).map(vertex).collect();
        let moved = |(joint, motion): (&Joint, &DAffine3)| Joint { bind: *motion * joint.bind, ..joint.clone() };
        Self {
            mesh: Mesh { positions, triangles: self.mesh.triangles.clone() },
            joints: self.joints.iter().zip(&moves).map(moved).collect(),
            influences: self.influences.clone(),
            places: self.places.iter().map(|(role, &place)| (*role, motions[role].transform_point3(place))).collect(),
            frame: self.frame,
        }
    }

    /// The same in another pose.
    pub fn posed(&self, pose: &Pose) -> Self {
        self.moved(&self.motions(pose))
    }

    /// The same in another space: turned, in another unit, or mirrored (then its triangles are turned over).
    pub fn placed(&self, frame: DAffine3) -> Self {
        let mut placed = self.clone();
        placed.mesh.positions.iter_mut().for_each(|p| *p = frame.transform_point3(*p));
        if frame.matrix3.determinant() < 0.0 {
            placed.mesh.triangles.iter_mut().for_each(|triangle| triangle.swap(1, 2));
        }
        placed.joints.iter_mut().for_each(|joint| joint.bind = frame * joint.bind);
        placed.frame = frame * self.frame;
        placed
    }

    /// The same with a scale in the joints' transforms, as a node above the root with a scale of 100 leaves it; the mesh
    /// stays.
    pub fn with_joint_scale(mut self, scale: f64) -> Self {
        self.joints.iter_mut().for_each(|joint| joint.bind *= DAffine3::from_scale(DVec3::splat(scale)));
        self
    }

    /// The same with the joints of the right side mirrored, so that their scale is negative; the mesh stays.
    pub fn with_mirrored_joints(mut self) -> Self {
        let mirror = DAffine3::from_scale(DVec3::new(-1.0, 1.0, 1.0));
        for joint in self.joints.iter_mut().filter(|joint| joint.role.side() == Some(Side::Right)) {
            joint.bind *= mirror;
        }
        self
    }

    /// The same with a helper in the place of each joint that has weights, between it and its parent; no vertex is
    /// weighted to one.
    pub fn with_helpers(&self) -> Self {
        let mut joints = Vec::new();
        let mut new = Vec::new();
        for joint in &self.joints {
            let mut parent = joint.parent.map(|parent| new[parent]);
            if !joint.role.is_control() {
                let name = if joint.name.is_empty() { String::new() } else { format!("{}_offset", joint.name) };
                joints.push(Joint { name, parent, ..joint.clone() });
                parent = Some(joints.len() - 1);
            }
            new.push(joints.len());
            joints.push(Joint { parent, ..joint.clone() });
        }
        let influences = self.influences.iter();
        let influences = influences.map(|v| v.iter().map(|(joint, weight)| (new[*joint], *weight)).collect()).collect();
        Self { joints, influences, ..self.clone() }
    }
}
