//! Rigs as tools and engines have them: joints with a name, a parent and a bind transform.

use glam::{DMat4, DVec3};

use super::MAX_COORDINATE;
use super::skeleton::Skeleton;
use crate::error::{Error, ErrorKind, Result};
use crate::memory::bytes;

/// The largest number of joints of a rig that is accepted.
pub const MAX_RIG_JOINTS: usize = 65_535;

/// A joint of a rig.
#[derive(Clone, Debug, PartialEq)]
pub struct RigJoint {
    /// Its name, as the tool has it. May be empty, and several joints may share one.
    pub name: String,
    /// The joint that moves it; none for a root.
    pub parent: Option<u32>,
    /// From the joint's own space to that of the mesh, in the pose in which the mesh is given. May scale and mirror; only
    /// a transform that moves vertices must be invertible.
    pub bind: DMat4,
}

/// Joints that move a mesh, parents in any order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Rig {
    /// All joints.
    pub joints: Vec<RigJoint>,
}

fn fail<T>(message: String) -> Result<T> {
    Err(Error::new(ErrorKind::InvalidSkeleton, message))
}

impl Rig {
    /// Refuses a rig that cannot be used; `name` names it in error messages ("target rig").
    ///
    /// # Errors
    /// [`ErrorKind::InvalidSkeleton`]: no joints, more than [`MAX_RIG_JOINTS`], a parent that is no joint or leads back to the
    /// joint itself, a transform with a number that is not finite or beyond [`MAX_COORDINATE`], or whose last row is not
    /// (0, 0, 0, 1).
    pub fn check(&self, name: &str) -> Result<()> {
        let count = self.joints.len();
        if count == 0 {
            return fail(format!("{name}: there are no joints"));
        }
        if count > MAX_RIG_JOINTS {
            return fail(format!("{name}: there are {count} joints, at most {MAX_RIG_JOINTS} can be used"));
        }
        for (index, joint) in self.joints.iter().enumerate() {
            if let Some(parent) = joint.parent.filter(|&parent| parent as usize >= count) {
                return fail(format!("{name}: {} has parent {parent}, the rig has {count} joints", self.called(index)));
            }
            let numbers = joint.bind.to_cols_array();
            if let Some(k) = numbers.iter().position(|n| n.is_nan() || n.abs() > MAX_COORDINATE) {
                return fail(format!(
                    "{name}: number {k} of the bind transform of {} is {}, it must be finite and at most \
                     {MAX_COORDINATE:e} in size",
                    self.called(index),
                    numbers[k]
                ));
            }
            let last = joint.bind.row(3).to_array();
            if last.iter().zip([0.0, 0.0, 0.0, 1.0]).any(|(&n, want)| (n - want).abs() > 1e-6) {
                return fail(format!(
                    "{name}: the bind transform of {} has {last:?} in its last row, which must be 0, 0, 0, 1: a transform is \
                     16 numbers, column after column, and numbers 12 to 14 (from 0) are the joint's place",
                    self.called(index)
                ));
            }
        }
        self.parents_first(name).map(|_| ())
    }

    /// All joints, each after its parent; among those that could come next, the lower index first.
    ///
    /// # Errors
    /// [`ErrorKind::InvalidSkeleton`] where parents go round in a circle.
    pub fn parents_first(&self, name: &str) -> Result<Vec<u32>> {
        let children = self.children();
        let mut order: Vec<u32> =
            (0..self.joints.len() as u32).filter(|&j| self.joints[j as usize].parent.is_none()).collect();
        let mut next = 0;
        while next < order.len() {
            order.extend(&children[order[next] as usize]);
            next += 1;
        }
        if order.len() == self.joints.len() {
            return Ok(order);
        }
        let mut reached = vec![false; self.joints.len()];
        order.iter().for_each(|&j| reached[j as usize] = true);
        let first = reached.iter().position(|reached| !reached).unwrap_or_default();
        // Behind some steps up lies the circle itself.
        let up = |j: usize| self.joints[j].parent.map_or(j, |parent| parent as usize);
        let on_circle = (0..self.joints.len()).fold(first, |j, _| up(j));
        fail(format!(
            "{name}: {} is its own ancestor: its parents go round in a circle, by way of {}",
            self.called(on_circle),
            self.called(up(on_circle))
        ))
    }

    /// The children of each joint, ascending.
    pub fn children(&self) -> Vec<Vec<u32>> {
        let mut children = vec![Vec::new(); self.joints.len()];
        for (index, joint) in (0u32..).zip(&self.joints) {
            if let Some(list) = joint.parent.and_then(|parent| children.get_mut(parent as usize)) {
                list.push(index);
            }
        }
        children
    }

    /// Where a joint is.
    pub fn place(&self, joint: u32) -> DVec3 {
        self.joints[joint as usize].bind.w_axis.truncate()
    }

    /// A joint as messages name it: `joint 7 ("LeftArm")`.
    pub fn called(&self, joint: usize) -> String {
        match self.joints.get(joint).map(|j| j.name.as_str()) {
            Some(name) if !name.is_empty() => format!("joint {joint} (\"{}\")", shortened(name)),
            _ => format!("joint {joint}"),
        }
    }

    /// This rig with each transform carried over by `map`, an affine map of the space that it stands in.
    pub fn mapped(&self, map: DMat4) -> Self {
        let joint = |j: &RigJoint| RigJoint { bind: map * j.bind, ..j.clone() };
        Self { joints: self.joints.iter().map(joint).collect() }
    }

    /// The rig of a skeleton, whose joints have no names: its joints hang on the one in the middle, from which the longest
    /// way along bones is shortest, the lowest of several.
    ///
    /// The skeleton has passed [`Skeleton::check`]; a bone that closes a circle is no parent of anything.
    pub fn of_skeleton(skeleton: &Skeleton) -> Self {
        let graph = super::skeleton::BoneGraph::new(skeleton);
        let count = skeleton.joints.len() as u32;
        let farthest = |j: u32| (0..count).map(|k| graph.joint_distance(j, k)).max();
        let middle = (0..count).min_by_key(|&j| farthest(j)).unwrap_or_default();
        let parent = |j: u32| {
            let towards = |&bone: &u32| {
                let [a, b] = skeleton.bones[bone as usize];
                let other = if a == j { b } else { a };
                (graph.joint_distance(other, middle) < graph.joint_distance(j, middle)).then_some(other)
            };
            graph.bones_at(j).iter().find_map(towards)
        };
        let joint = |j: u32| RigJoint {
            name: String::new(),
            parent: parent(j),
            bind: DMat4::from_translation(skeleton.joints[j as usize]),
        };
        Self { joints: (0..count).map(joint).collect() }
    }

    /// Bytes that it holds.
    pub fn memory(&self) -> u64 {
        bytes(&self.joints) + self.joints.iter().map(|joint| joint.name.len() as u64).sum::<u64>()
    }
}

/// A name short enough for a message, and on one line.
fn shortened(name: &str) -> String {
    const LONGEST: usize = 60;
    let plain = |c: char| if c.is_control() { ' ' } else { c };
    match name.char_indices().nth(LONGEST) {
        Some((end, _)) => name[..end].chars().map(plain).chain("...".chars()).collect(),
        None => name.chars().map(plain).collect(),
    }
}
