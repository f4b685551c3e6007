//! The parts of a body by how a rig is built and where its joints are, for rigs whose names say nothing.
//!
//! A person is two joints from which a pair of limbs of equal length leaves, with the trunk between them: the limbs that go on
//! along the trunk are the legs, and what else leaves the other joint is the head. Which way the tree of parents runs does
//! not matter, so that a skeleton of bones is read like a rig.

mod head;
mod limbs;
mod person;
mod segments;
mod tree;

use glam::DVec3;

use super::body_part::BodyPart;
use person::Person;
use tree::Tree;

/// More joints than this are not read by their structure: the ways between all of them are compared.
const MOST_JOINTS: usize = 4096;

/// The joints of a rig.
#[derive(Clone, Copy, Debug)]
pub struct Joints<'a> {
    /// Where they are.
    pub places: &'a [DVec3],
    /// What each hangs on.
    pub parents: &'a [Option<u32>],
    /// Which of them count.
    pub used: &'a [bool],
    /// How much of the body each moves, in any unit, where that is known.
    pub moved: Option<&'a [f64]>,
}

/// What the structure says of each joint: a part and how sure that is, from 0 to 1, below 0.6 where something else is about as
/// likely. None where the rig is no person.
pub fn read(joints: &Joints<'_>) -> Option<Vec<Option<(BodyPart, f64)>>> {
    if joints.places.len() > MOST_JOINTS {
        return None;
    }
    let tree = Tree::new(joints)?;
    let person = Person::find(&tree)?;
    Some(person.parts(&tree))
}
