//! Turns the limbs of a body into the directions that another's have, by its own skin weights, and back along a path.
//!
//! Each joint at which a limb begins turns about its own place by the least rotation that brings the limb's bone into the
//! direction of the other's, from the trunk outwards. Directions are compared in the frame of each trunk, so that where the
//! bodies stand and which way they face does not matter. Vertices follow by linear blend skinning:
//!
//! ```text
//! M_j(p) = M_parent(j)( c_j + Q_j (p - c_j) ),     v' = sum_j w_j M_j(v) / sum_j w_j
//! ```
//!
//! with the joint's place `c_j` and its turn `Q_j`. At share s of the way each turn is the rotation by s times its angle.

use glam::{DAffine3, DMat3, DQuat, DVec3};
use rayon::prelude::*;

use super::body_part::Side;
use super::landmark::Landmark;
use super::places::{Character, index};
use super::reading::Reading;
use crate::geometry::turn;
use crate::input::skin::SkinWeights;

/// A limb that points elsewhere by less than this many degrees stays as it is; the inflation takes it along.
const HARMLESS: f64 = 20.0;
/// From here on the body is posed before anything else is tried: below, as with an A-pose against a T-pose, 49 degrees, the
/// inflation mostly takes all limbs along, which costs less.
const LARGE: f64 = 60.0;

/// The bones that are turned, by the landmarks at their ends; each after the one that it hangs on, if any.
pub const LIMBS: [[Landmark; 2]; 8] = [
    [Landmark::Shoulder(Side::Left), Landmark::Elbow(Side::Left)],
    [Landmark::Elbow(Side::Left), Landmark::Wrist(Side::Left)],
    [Landmark::Shoulder(Side::Right), Landmark::Elbow(Side::Right)],
    [Landmark::Elbow(Side::Right), Landmark::Wrist(Side::Right)],
    [Landmark::Hip(Side::Left), Landmark::Knee(Side::Left)],
    [Landmark::Knee(Side::Left), Landmark::Ankle(Side::Left)],
    [Landmark::Hip(Side::Right), Landmark::Knee(Side::Right)],
    [Landmark::Knee(Side::Right), Landmark::Ankle(Side::Right)],
];

/// How a body gets from its bind pose into another's pose.
#[derive(Clone, Debug)]
pub struct Posing {
    /// Each joint after the one that moves it.
    order: Vec<u32>,
    parents: Vec<Option<u32>>,
    places: Vec<DVec3>,
    turns: Vec<DQuat>,
    /// For each landmark, the joint that moves it.
    movers: [Option<u32>; Landmark::COUNT],
    /// The joint that moves what has no weights.
    base: u32,
    /// The angle between the directions of each of [`LIMBS`].
    differences: [f64; LIMBS.len()],
}

impl Posing {
    /// The way from `character`'s pose, whose landmarks are at `own`, into that in which they are at `others`. None where no
    /// limb differs much, or where the body has no weights to follow with.
    pub fn new(
        character: Character<'_>,
        reading: &Reading,
        order: &[u32],
        own: &[Option<DVec3>; Landmark::COUNT],
        others: &[Option<DVec3>; Landmark::COUNT],
    ) -> Option<Self> {
        character.skin?;
        let rig = character.rig;
        let frames = [frame(own)?, frame(others)?];
        let into_own = frames[0] * frames[1].transpose();
        let direction = |places: &[Option<DVec3>; Landmark::COUNT], [a, b]: [Landmark; 2]| {
            (places[index(b)]? - places[index(a)]?).try_normalize()
        };
        let joint_of = |landmark: Landmark| landmark.part().and_then(|part| reading.joint_of(part));
        let mut posing = Self {
            order: Vec::new(),
            parents: parents(rig.joints.iter().map(|joint| joint.parent).collect(), &joint_of),
            places: (0..rig.joints.len() as u32).map(|joint| rig.place(joint)).collect(),
            turns: vec![DQuat::IDENTITY; rig.joints.len()],
            movers: Landmark::ALL.map(|landmark| mover(landmark, reading)),
            base: joint_of(Landmark::Pelvis).or(order.first().copied())?,
            differences: [0.0; LIMBS.len()],
        };
        posing.order = sorted(&posing.parents);
        let mut whole = [DQuat::IDENTITY; Landmark::COUNT];
        for (k, limb) in LIMBS.into_iter().enumerate() {
            let [from, _] = limb;
            // The turn of the limb that this one goes on from.
            let before = match from {
                Landmark::Elbow(side) => whole[index(Landmark::Shoulder(side))],
                Landmark::Knee(side) => whole[index(Landmark::Hip(side))],
                _ => DQuat::IDENTITY,
            };
            whole[index(from)] = before;
            let (Some(joint), Some(have), Some(want)) = (joint_of(from), direction(own, limb), direction(others, limb))
            else {
                continue;
            };
            let want = (into_own * want).normalize_or(have);
            posing.differences[k] = turn::angle_between(have, want);
            let carried = before * have;
            if turn::angle_between(carried, want).to_degrees() < HARMLESS {
                continue;
            }
            let turned = turn::arc(carried, want) * before;
            whole[index(from)] = turned;
            posing.turns[joint as usize] = (before.inverse() * turned).normalize();
        }
        posing.turns.iter().any(|&turn| turn != DQuat::IDENTITY).then_some(posing)
    }

    /// The largest angle between the directions that a limb has in the two poses, in degrees.
    pub fn difference(&self) -> f64 {
        self.differences.into_iter().fold(0.0, f64::max).to_degrees()
    }

    /// Whether limbs differ so much that the body has to be posed, before anything else is tried; for each of [`LIMBS`] it is asked
    /// whether the garment is on it.
    pub fn is_large(&self, clothed: impl FnOnce() -> [bool; LIMBS.len()]) -> bool {
        let is_large = |difference: f64| difference.to_degrees() >= LARGE;
        // Without large turns nobody has to look.
        self.differences.into_iter().any(is_large)
            && self.differences.into_iter().zip(clothed()).any(|(difference, on)| on && is_large(difference))
    }

    /// The largest angle by which a joint turns.
    pub fn largest_turn(&self) -> f64 {
        self.turns.iter().map(|&turn| turn::angle(turn)).fold(0.0, f64::max)
    }

    /// The motion of each joint at `share` of the way: 0 is the bind pose, 1 the other's.
    pub fn motions(&self, share: f64) -> Vec<DAffine3> {
        let mut motions = vec![DAffine3::IDENTITY; self.places.len()];
        for &joint in &self.order {
            let j = joint as usize;
            let above = self.parents[j].map_or(DAffine3::IDENTITY, |parent| motions[parent as usize]);
            let turn = turn::between(DQuat::IDENTITY, self.turns[j], share);
            let place = self.places[j];
            let own = DAffine3::from_rotation_translation(turn, place - turn * place);
            motions[j] = above * own;
        }
        motions
    }

    /// Points with their weights after these motions; what has no weights goes with the pelvis.
    pub fn moved(&self, motions: &[DAffine3], skin: &SkinWeights, points: &[DVec3]) -> Vec<DVec3> {
        let point = |(vertex, &p): (usize, &DVec3)| {
            let weights = skin.weights(vertex);
            let sum: f64 = weights.iter().map(|&(_, weight)| weight).sum();
            if sum == 0.0 {
                return motions[self.base as usize].transform_point3(p);
            }
            weights.iter().map(|&(j, weight)| weight / sum * motions[j as usize].transform_point3(p)).sum()
        };
        points.par_iter().enumerate().map(point).collect()
    }

    /// The places of the landmarks after these motions.
    pub fn moved_landmarks(
        &self,
        motions: &[DAffine3],
        places: &[Option<DVec3>; Landmark::COUNT],
    ) -> [Option<DVec3>; Landmark::COUNT] {
        let mut moved = *places;
        for (place, mover) in moved.iter_mut().zip(self.movers) {
            let motion = motions[mover.unwrap_or(self.base) as usize];
            *place = place.map(|p| motion.transform_point3(p));
        }
        moved
    }
}

/// The frame of a trunk: up, across and forward, as columns.
fn frame(places: &[Option<DVec3>; Landmark::COUNT]) -> Option<DMat3> {
    let at = |landmark: Landmark| places[index(landmark)];
    let up = (at(Landmark::Neck)? - at(Landmark::Pelvis)?).try_normalize()?;
    let pair = |part: fn(Side) -> Landmark| Some(at(part(Side::Left))? - at(part(Side::Right))?);
    let across = pair(Landmark::Hip).or_else(|| pair(Landmark::Shoulder))?;
    let across = (across - across.dot(up) * up).try_normalize()?;
    Some(DMat3::from_cols(across, up, across.cross(up)))
}

/// The joint that moves each joint: its parent, but for parts of a limb the part before, from which some rigs take hands and
/// feet away, to hang them on a control.
fn parents(mut parents: Vec<Option<u32>>, joint_of: &impl Fn(Landmark) -> Option<u32>) -> Vec<Option<u32>> {
    for landmark in Landmark::ALL {
        let (Landmark::Elbow(_) | Landmark::Wrist(_) | Landmark::Knee(_) | Landmark::Ankle(_)) = landmark else {
            continue;
        };
        let (Some(joint), Some(before)) = (joint_of(landmark), landmark.parent().and_then(joint_of)) else { continue };
        let above = std::iter::successors(parents[joint as usize], |&above| parents[above as usize]);
        if !above.take(parents.len()).any(|above| above == before) && !is_above(&parents, joint, before) {
            parents[joint as usize] = Some(before);
        }
    }
    parents
}

/// Whether `joint` is above `other`.
fn is_above(parents: &[Option<u32>], joint: u32, other: u32) -> bool {
    std::iter::successors(Some(other), |&above| parents[above as usize]).take(parents.len()).any(|above| above == joint)
}

/// All joints, each after its parent.
fn sorted(parents: &[Option<u32>]) -> Vec<u32> {
    let mut children = vec![Vec::new(); parents.len()];
    let mut order = Vec::new();
    for (joint, parent) in (0u32..).zip(parents) {
        match parent {
            Some(parent) => children[*parent as usize].push(joint),
            None => order.push(joint),
        }
    }
    let mut next = 0;
    while next < order.len() {
        order.extend(&children[order[next] as usize]);
        next += 1;
    }
    order
}

/// The joint that moves a landmark.
fn mover(landmark: Landmark, reading: &Reading) -> Option<u32> {
    use super::body_part::BodyPart;
    match landmark {
        Landmark::Waist => reading.joint_of(BodyPart::Hips),
        Landmark::HeadTop => reading.joint_of(BodyPart::Head).or_else(|| reading.joint_of(BodyPart::Neck)),
        // An estimated last joint goes with the part before it.
        other => other
            .part()
            .and_then(|part| reading.joint_of(part))
            .or_else(|| other.parent()?.part().and_then(|part| reading.joint_of(part))),
    }
}
