//! What each joint of a rig is, by its names and else by its structure.

use super::body_part::BodyPart;
use super::names::{self, Named};
use super::structure;
use crate::input::rig::Rig;
use crate::input::skin::SkinWeights;

/// How a joint's part was found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FoundBy {
    /// By its name.
    Name,
    /// By where it is in the tree and in space.
    Structure,
    /// The caller said so.
    Caller,
}

/// A rig, read.
#[derive(Clone, Debug)]
pub struct Reading {
    /// The table of names that the rig follows, if it follows one.
    pub profile: Option<&'static str>,
    /// What each joint is.
    pub named: Vec<Named>,
    /// How sure that is, from 0 to 1.
    pub confidence: Vec<f64>,
    /// What says so.
    pub found_by: Vec<FoundBy>,
}

impl Reading {
    /// Reads a rig; `skin` says which of its joints move anything, where it is known.
    pub fn new(rig: &Rig, skin: Option<&SkinWeights>) -> Self {
        let names: Vec<&str> = rig.joints.iter().map(|joint| joint.name.as_str()).collect();
        let parents: Vec<Option<u32>> = rig.joints.iter().map(|joint| joint.parent).collect();
        let naming = names::read(&names, &parents);
        let mut reading = Self {
            profile: naming.profile,
            found_by: vec![FoundBy::Name; naming.joints.len()],
            named: naming.joints,
            confidence: naming.confidence,
        };
        if !reading.has_limbs() {
            reading.read_structure(rig, &parents, skin);
        }
        reading
    }

    /// Whether upper and lower legs or arms are known on both sides.
    fn has_limbs(&self) -> bool {
        use super::body_part::Side::{Left, Right};
        let has = |part: BodyPart| self.joint_of(part).is_some();
        let both = |part: fn(super::body_part::Side) -> BodyPart| has(part(Left)) && has(part(Right));
        (both(BodyPart::UpperLeg) && both(BodyPart::LowerLeg)) || (both(BodyPart::UpperArm) && both(BodyPart::LowerArm))
    }

    /// Fills in what the structure says.
    fn read_structure(&mut self, rig: &Rig, parents: &[Option<u32>], skin: Option<&SkinWeights>) {
        let places: Vec<_> = (0..rig.joints.len() as u32).map(|joint| rig.place(joint)).collect();
        let mut used = vec![true; places.len()];
        let moved = skin.map(moved_by).filter(|moved| moved.iter().any(|&sum| sum > 0.0));
        if let Some(skin) = skin.filter(|_| moved.is_some()) {
            used = moves(skin, parents);
        }
        for (joint, named) in self.named.iter().enumerate() {
            used[joint] &= !matches!(named, Named::Control | Named::Prop);
        }
        let joints = structure::Joints { places: &places, parents, used: &used, moved: moved.as_deref() };
        let Some(found) = structure::read(&joints) else { return };
        for (joint, part) in found.into_iter().enumerate() {
            if let Some((part, sure)) = part {
                self.named[joint] = Named::Part(part);
                self.confidence[joint] = sure;
                self.found_by[joint] = FoundBy::Structure;
            }
        }
    }

    /// The joints of `part`, ascending: several for spine and neck.
    pub fn joints_of(&self, part: BodyPart) -> impl Iterator<Item = u32> + '_ {
        (0u32..).zip(&self.named).filter(move |(_, named)| **named == Named::Part(part)).map(|(joint, _)| joint)
    }

    /// The joint of `part`, the first of several.
    pub fn joint_of(&self, part: BodyPart) -> Option<u32> {
        self.joints_of(part).next()
    }

    /// The part that a joint is.
    pub fn part(&self, joint: u32) -> Option<BodyPart> {
        match self.named[joint as usize] {
            Named::Part(part) => Some(part),
            _ => None,
        }
    }

    /// Says that `joint` is `part` and no other joint is, because the caller said so.
    pub fn set(&mut self, joint: u32, part: BodyPart) {
        if !matches!(part, BodyPart::Spine | BodyPart::Neck) {
            for other in self.joints_of(part).collect::<Vec<_>>() {
                self.named[other as usize] = Named::Unknown;
                self.confidence[other as usize] = 0.0;
            }
        }
        self.named[joint as usize] = Named::Part(part);
        self.confidence[joint as usize] = 1.0;
        self.found_by[joint as usize] = FoundBy::Caller;
    }
}

/// The joints that move a vertex, and those above them.
pub fn moves(skin: &SkinWeights, parents: &[Option<u32>]) -> Vec<bool> {
    let mut moves = vec![false; parents.len()];
    for vertex in 0..skin.vertex_count() {
        for &(joint, _) in skin.weights(vertex) {
            let mut up = Some(joint);
            while let Some(joint) = up
                && !moves[joint as usize]
            {
                moves[joint as usize] = true;
                up = parents[joint as usize];
            }
        }
    }
    moves
}

/// The sum of the weights of each joint.
fn moved_by(skin: &SkinWeights) -> Vec<f64> {
    let mut moved = vec![0.0; skin.joint_count()];
    for vertex in 0..skin.vertex_count() {
        skin.weights(vertex).iter().for_each(|&(joint, weight)| moved[joint as usize] += weight);
    }
    moved
}
