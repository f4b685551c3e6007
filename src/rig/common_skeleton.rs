//! The skeleton that two rigs have in common, at its places in both, and the skin weights on it.
//!
//! Of two people these are the landmarks that both have, with the joints that a caller adds to them, and the fingers that the
//! garment is worn on; of other creatures the joints that correspond. All other joints are contracted into the nearest one above them.

use glam::{DAffine3, DVec3};

use super::body_part::{BodyPart, Side};
use super::hands::worn_fingers;
use super::joint_map::{JointMap, Reason};
use super::landmark::Landmark;
use super::places::{self, Character, index, places};
use super::posing::Posing;
use super::reading::moves;
use super::worn::Worn;
use crate::error::{Error, ErrorKind, Result};
use crate::input::diagnostic::Diagnostic;
use crate::input::rig::Rig;
use crate::input::skeleton::{MAX_JOINTS, Skeleton};
use crate::input::skin::SkinWeights;

/// What a joint of the common skeleton stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CommonJoint {
    /// A place of a body.
    Landmark(Landmark),
    /// A joint of the source rig and one of the target rig.
    Pair(u32, u32),
    /// The end of what these two move.
    Tip(u32, u32),
}

/// The skeleton that two rigs have in common.
#[derive(Clone, Debug)]
pub struct CommonSkeleton {
    /// What each of its joints is.
    pub joints: Vec<CommonJoint>,
    /// In the source.
    pub source: Skeleton,
    /// In the target, with the same bones.
    pub target: Skeleton,
    /// The joint of the common skeleton that each joint of the target rig belongs to.
    pub owner: Vec<Option<u32>>,
    /// The joints of the common skeleton at which limbs end, for each joint of source and target rig that moves what comes
    /// out of clothes there: a head, and not the neck, or a hand.
    ends: [Vec<Option<u32>>; 2],
    /// The landmarks in source and target, in the order of [`Landmark::ALL`].
    pub landmarks: [[Option<DVec3>; Landmark::COUNT]; 2],
    /// The garment has tubes for fingers that the rigs do not both know.
    pub lacks_fingers: bool,
}

impl CommonSkeleton {
    /// The common skeleton of two characters by the map between their rigs, for `garment`, which is worn by the source.
    ///
    /// # Errors
    /// [`ErrorKind::InvalidSkeleton`] where fewer than two joints correspond, or all of them are in one place.
    pub fn new(
        source: Character<'_>,
        target: Character<'_>,
        map: &JointMap,
        garment: Option<Worn<'_>>,
    ) -> Result<Self> {
        let order = [source.rig.parents_first("source rig")?, target.rig.parents_first("target rig")?];
        let on_source = places(source, &map.readings[0], &order[0]);
        let on_target = places(target, &map.readings[1], &order[1]);
        let mut build = Builder::default();
        let mut of_landmark = [None; Landmark::COUNT];
        let parents: Vec<Option<Landmark>> = Landmark::ALL.iter().map(|landmark| landmark.parent()).collect();
        let feet = match garment {
            Some(garment) => garment.feet(&places::owners(source.rig, &map.readings[0], &order[0]), &on_source),
            None => Vec::new(),
        };
        let is_common = |landmark: Landmark| {
            let is_worn = !matches!(landmark, Landmark::Toes(_)) || feet.contains(&landmark);
            is_worn && on_source[index(landmark)].is_some() && on_target[index(landmark)].is_some()
        };
        let person = Landmark::ALL.iter().filter(|&&landmark| is_common(landmark)).count() >= LEAST_LANDMARKS;
        for (k, landmark) in Landmark::ALL.into_iter().enumerate() {
            let (Some(from), Some(to)) = (on_source[k], on_target[k]) else { continue };
            if person && is_common(landmark) {
                let above = std::iter::successors(parents[k], |above| above.parent()).find(|&above| is_common(above));
                of_landmark[k] =
                    Some(build.push(CommonJoint::Landmark(landmark), [from, to], above.map(Node::Landmark)));
            }
        }
        let mut pairs: [Vec<Option<u32>>; 2] = [source.rig, target.rig].map(|rig| vec![None; rig.joints.len()]);
        let (fingers, lacks_fingers) = match garment.filter(|_| person) {
            Some(garment) => worn_fingers(garment.mesh, [source, target], &map.readings),
            None => Default::default(),
        };
        for finger in fingers {
            let wrist = Some(Landmark::Wrist(finger.side)).filter(|&wrist| of_landmark[index(wrist)].is_some());
            let mut above = wrist.map(Node::Landmark);
            let mut nodes = Vec::new();
            for &[joint, other] in &finger.joints {
                let places = [source.rig.place(joint), target.rig.place(other)];
                let node = build.push(CommonJoint::Pair(joint, other), places, above);
                (pairs[0][joint as usize], pairs[1][other as usize]) = (Some(node), Some(node));
                above = Some(Node::Joint(joint));
                nodes.push(node);
            }
            if let Some(&[joint, other]) = finger.joints.last() {
                build.push(CommonJoint::Tip(joint, other), finger.tips, above);
            }
            // The other fingers of a mitten go along.
            for (joint, with) in finger.others {
                pairs[1][joint as usize] = Some(nodes[with]);
            }
        }
        let is_moved = match target.skin {
            Some(skin) => moves(skin, &target.rig.joints.iter().map(|joint| joint.parent).collect::<Vec<_>>()),
            None => vec![true; target.rig.joints.len()],
        };
        for &joint in &order[0] {
            let mapped = map.joints[joint as usize];
            let Some(other) = mapped.target else { continue };
            let of_person = person && (mapped.part.is_some() || mapped.reason != Reason::Caller);
            let own = mapped.reason != Reason::Ancestor && mapped.reason != Reason::Nothing;
            if of_person || !own || !is_moved[other as usize] || pairs[1][other as usize].is_some() {
                continue;
            }
            let node = build.push(
                CommonJoint::Pair(joint, other),
                [source.rig.place(joint), target.rig.place(other)],
                source.rig.joints[joint as usize].parent.map(Node::Joint),
            );
            pairs[0][joint as usize] = Some(node);
            pairs[1][other as usize] = Some(node);
        }
        let readings = &map.readings;
        let owners = |side: usize, rig: &Rig, order: &[u32]| {
            let landmarks = places::owners(rig, &readings[side], order);
            let mut owners: Vec<Option<u32>> = vec![None; rig.joints.len()];
            for &joint in order {
                let above = rig.joints[joint as usize].parent.and_then(|parent| owners[parent as usize]);
                let own = landmarks[joint as usize].filter(|_| readings[side].part(joint).is_some());
                let nearest = std::iter::successors(own, |landmark| landmark.parent());
                let own = nearest.map(|landmark| of_landmark[index(landmark)]).find(Option::is_some).flatten();
                owners[joint as usize] = pairs[side][joint as usize].or(own).or(above);
            }
            owners
        };
        let (from, owner) = (owners(0, source.rig, &order[0]), owners(1, target.rig, &order[1]));
        let ends = |side: usize, rig: &Rig, order: &[u32], owner: &[Option<u32>]| {
            let mut is_end = vec![false; rig.joints.len()];
            for &joint in order {
                let above = rig.joints[joint as usize].parent.is_some_and(|parent| is_end[parent as usize]);
                is_end[joint as usize] = readings[side].part(joint).map_or(above, BodyPart::is_beyond_clothes);
            }
            owner.iter().zip(is_end).map(|(owner, is_end)| owner.filter(|_| person && is_end)).collect()
        };
        let ends = [ends(0, source.rig, &order[0], &from), ends(1, target.rig, &order[1], &owner)];
        let (source, target, joints) = build.finish(&of_landmark, &from)?;
        Ok(Self { joints, source, target, owner, ends, landmarks: [on_source, on_target], lacks_fingers })
    }

    /// What its joints are in messages: "left knee", or the names that pairs have in the source rig.
    pub fn names(&self, source: &Rig) -> Vec<String> {
        let name = |joint: &CommonJoint| match *joint {
            CommonJoint::Landmark(landmark) => landmark.name().to_string(),
            CommonJoint::Pair(joint, _) => source.called(joint as usize),
            CommonJoint::Tip(joint, _) => format!("tip of {}", source.called(joint as usize)),
        };
        self.joints.iter().map(name).collect()
    }

    /// From the ankles to the toes, in source and target: the mean of those feet of which both are known.
    pub fn feet(&self) -> Option<[DVec3; 2]> {
        let foot = |places: &[Option<DVec3>; Landmark::COUNT], side: Side| {
            Some(places[index(Landmark::Toes(side))]? - places[index(Landmark::Ankle(side))]?)
        };
        let [own, others] = &self.landmarks;
        let feet: Vec<_> =
            [Side::Left, Side::Right].into_iter().filter_map(|s| Some([foot(own, s)?, foot(others, s)?])).collect();
        let mean = |side: usize| feet.iter().map(|foot| foot[side]).sum::<DVec3>() / feet.len() as f64;
        (!feet.is_empty()).then(|| [mean(0), mean(1)])
    }

    /// The target skeleton after these motions of the joints of the target rig.
    pub fn posed_target(&self, posing: &Posing, motions: &[DAffine3]) -> Skeleton {
        let landmarks = posing.moved_landmarks(motions, &self.landmarks[1]);
        let place = |(joint, place): (&CommonJoint, &DVec3)| match *joint {
            CommonJoint::Landmark(landmark) => landmarks[index(landmark)].unwrap_or(*place),
            CommonJoint::Pair(_, target) | CommonJoint::Tip(_, target) => {
                motions[target as usize].transform_point3(*place)
            }
        };
        let joints = self.joints.iter().zip(&self.target.joints).map(place).collect();
        Skeleton { joints, bones: self.target.bones.clone() }
    }

    /// Weights on the joints of the target rig, as weights on those of the common skeleton. What belongs to none of them, such as
    /// a root on the floor, is left out: the nearest bone decides there.
    pub fn skin(&self, skin: &SkinWeights) -> SkinWeights {
        skin.contracted(&self.owner, self.joints.len())
    }

    /// Weights on the joints of the source rig, side 0, or the target rig, as weights on the ends of limbs: of its joints that at
    /// which the limb ends, and one more after them for all that is no end.
    pub fn ends(&self, side: usize, skin: &SkinWeights) -> SkinWeights {
        let rest = self.joints.len();
        let owner: Vec<Option<u32>> = self.ends[side].iter().map(|end| end.or(Some(rest as u32))).collect();
        skin.contracted(&owner, rest + 1)
    }
}

/// A part of the body that was recognised with less than this is told.
const SURE: f64 = 0.6;

impl CommonSkeleton {
    /// A finding about the landmarks, and the fingers of the garment, of which the map is not sure, if there are any.
    pub fn unsure(&self, map: &JointMap) -> Option<Diagnostic> {
        let is_unsure = |landmark: &Landmark| {
            let joint_of = |side: usize| Some((side, map.readings[side].joint_of(landmark.part()?)?));
            (0..2).filter_map(joint_of).any(|(side, joint)| map.readings[side].confidence[joint as usize] < SURE)
        };
        let landmarks = self.joints.iter().filter_map(|joint| match joint {
            CommonJoint::Landmark(landmark) => Some(*landmark),
            CommonJoint::Pair(..) | CommonJoint::Tip(..) => None,
        });
        let mut places: Vec<&'static str> = landmarks.filter(is_unsure).map(Landmark::both).collect();
        places.extend(self.lacks_fingers.then_some("fingers"));
        places.sort_unstable();
        places.dedup();
        (!places.is_empty()).then_some(Diagnostic::JointsUnsure { places })
    }
}

/// Fewer landmarks than this make no person.
const LEAST_LANDMARKS: usize = 5;

/// What a new joint hangs on.
#[derive(Clone, Copy)]
enum Node {
    Landmark(Landmark),
    /// The first joint of the source rig from here up that belongs to something.
    Joint(u32),
}

#[derive(Default)]
struct Builder {
    joints: Vec<CommonJoint>,
    places: [Vec<DVec3>; 2],
    above: Vec<Option<Node>>,
}

impl Builder {
    fn push(&mut self, joint: CommonJoint, [from, to]: [DVec3; 2], above: Option<Node>) -> u32 {
        self.joints.push(joint);
        self.places[0].push(from);
        self.places[1].push(to);
        self.above.push(above);
        self.joints.len() as u32 - 1
    }

    fn finish(
        self,
        of_landmark: &[Option<u32>; Landmark::COUNT],
        from: &[Option<u32>],
    ) -> Result<(Skeleton, Skeleton, Vec<CommonJoint>)> {
        let Self { joints, places: [source, target], above } = self;
        if joints.len() < 2 {
            return Err(Error::new(
                ErrorKind::InvalidSkeleton,
                format!(
                    "rigs: {} of the source rig and the target rig correspond, which makes no skeleton: neither the names of \
                     the joints nor their places say what they are; say which joints correspond, as pairs",
                    match joints.len() {
                        0 => "no joints",
                        _ => "only one joint",
                    }
                ),
            ));
        }
        if joints.len() > MAX_JOINTS {
            return Err(Error::new(
                ErrorKind::InvalidSkeleton,
                format!(
                    "rigs: {} joints of the source rig and the target rig correspond, at most {MAX_JOINTS} can be used; leave \
                     out joints that move nothing",
                    joints.len()
                ),
            ));
        }
        let mut bones = Vec::new();
        for (joint, above) in (0u32..).zip(&above) {
            let above = above.and_then(|above| match above {
                Node::Landmark(landmark) => of_landmark[index(landmark)],
                Node::Joint(joint) => from[joint as usize],
            });
            // What hangs on nothing hangs on the first: a skeleton is in one piece.
            if let Some(above) = above.filter(|&above| above != joint).or(Some(0).filter(|_| joint != 0)) {
                bones.push([above, joint]);
            }
        }
        let source = Skeleton { joints: source, bones: bones.clone() };
        let target = Skeleton { joints: target, bones };
        source.longest_side("source rig")?;
        target.longest_side("target rig")?;
        Ok((source, target, joints))
    }
}
