//! Which joints are the bones of the fingers.

use std::collections::BTreeMap;

use super::claims::Reader;
use super::vocabulary::Place;
use crate::rig::body_part::{BodyPart, Finger, Side};

const BY_TABLE: f64 = 0.9;
const BY_WORD: f64 = 0.8;
/// Where the first number of a finger is above 1, the bones before may be missing, or the rig counts so.
const SHIFTED: f64 = 0.85;
/// A finger that does not hang on its hand.
const ASTRAY: f64 = 0.6;

/// Finds the fingers of both hands, which have been found.
pub fn read(reader: &mut Reader) {
    let mut fingers: BTreeMap<(Side, Finger), Vec<u32>> = BTreeMap::new();
    for &joint in &reader.tree.order {
        let says = &reader.joints[joint as usize];
        if let (Some(side), Some((bone, _)), None) = (says.side, says.finger, reader.found[joint as usize]) {
            fingers.entry((side, bone.finger)).or_default().push(joint);
        }
    }
    for ((side, finger), joints) in fingers {
        let hand = reader.joint_of(BodyPart::Hand(side));
        let hangs = |joint: u32| hand.is_none_or(|hand| reader.tree.is_above(hand, joint));
        // Those on the hand first: a control may have the same name.
        let mut joints: Vec<(bool, u32)> = joints.into_iter().map(|joint| (!hangs(joint), joint)).collect();
        joints.sort_by_key(|&(is_astray, joint)| (is_astray, reader.tree.depth[joint as usize]));
        let on_hand: Vec<u32> = joints.iter().filter(|(is_astray, _)| !is_astray).map(|&(_, joint)| joint).collect();
        let all: Vec<u32> = joints.iter().map(|&(_, joint)| joint).collect();
        let count = Count::new(reader, finger, if on_hand.is_empty() { &all } else { &on_hand });
        for (is_astray, joint) in joints {
            let Some((bone, by_table)) = reader.joints[joint as usize].finger else { continue };
            let segment = match bone.place {
                Place::Segment(segment @ 0..=1) if count.is_from_palm => Some(segment + 1),
                Place::Segment(segment) => Some(segment),
                Place::Number(number) => count.segment(number),
                Place::Unsaid => {
                    let is_same =
                        |above: &u32| reader.joints[*above as usize].finger.is_some_and(|(b, _)| b.finger == finger);
                    u8::try_from(reader.tree.above(joint).filter(is_same).count() + 1).ok()
                }
            };
            let Some(segment) = segment.filter(|&segment| segment <= 4) else { continue };
            let shifted = if matches!(bone.place, Place::Number(_)) && count.least > 1 { SHIFTED } else { 1.0 };
            let astray = if is_astray { ASTRAY } else { 1.0 };
            let sure = if by_table { BY_TABLE } else { BY_WORD };
            reader.set(joint, BodyPart::Finger { side, finger, segment }, sure * shifted * astray);
        }
    }
}

/// How the bones of a finger are numbered.
struct Count {
    least: u32,
    /// The segment of the least number.
    first: u8,
    /// A thumb whose first bone is called metacarpal, and two others.
    is_from_palm: bool,
}

impl Count {
    fn new(reader: &Reader, finger: Finger, joints: &[u32]) -> Self {
        let places = || joints.iter().filter_map(|&joint| reader.joints[joint as usize].finger);
        let mut numbers: Vec<u32> = places()
            .filter_map(|(bone, _)| match bone.place {
                Place::Number(number) => Some(number),
                _ => None,
            })
            .collect();
        numbers.sort_unstable();
        numbers.dedup();
        let least = numbers.first().copied().unwrap_or(1);
        let has_palm = places().any(|(bone, by_table)| bone.place == Place::Segment(0) && !by_table);
        let is_thumb = finger == Finger::Thumb;
        // Three bones and a tip, or with the bone in the palm: those that count from 0, and those that count five.
        let from_palm = !is_thumb && (numbers.len() >= 5 || (least == 0 && numbers.len() == 4));
        let free = places().filter(|(bone, _)| matches!(bone.place, Place::Segment(1..=3))).count();
        let is_from_palm = is_thumb && has_palm && numbers.len() < 3 && free < 3;
        Self { least, first: if from_palm { 0 } else { 1 + u8::from(is_from_palm) }, is_from_palm }
    }

    fn segment(&self, number: u32) -> Option<u8> {
        u8::try_from(number.checked_sub(self.least)?).ok()?.checked_add(self.first)
    }
}
