//! The parts of a body in words: "left upper arm", "right index finger 2".

use super::body_part::{BodyPart, Finger, Side};

/// A part in words, at most 31 bytes of ASCII.
pub fn name(part: BodyPart) -> String {
    let sided = |side: Side, word: &str| match side {
        Side::Left => format!("left {word}"),
        Side::Right => format!("right {word}"),
    };
    match part {
        BodyPart::Hips => "hips".to_string(),
        BodyPart::Spine => "spine".to_string(),
        BodyPart::Neck => "neck".to_string(),
        BodyPart::Head => "head".to_string(),
        BodyPart::HeadTop => "top of the head".to_string(),
        BodyPart::Jaw => "jaw".to_string(),
        BodyPart::Eye(side) => sided(side, "eye"),
        BodyPart::Clavicle(side) => sided(side, "collar bone"),
        BodyPart::UpperArm(side) => sided(side, "upper arm"),
        BodyPart::LowerArm(side) => sided(side, "lower arm"),
        BodyPart::Hand(side) => sided(side, "hand"),
        BodyPart::Finger { side, finger, segment } => {
            let finger = match finger {
                Finger::Thumb => "thumb",
                Finger::Index => "index finger",
                Finger::Middle => "middle finger",
                Finger::Ring => "ring finger",
                Finger::Little => "little finger",
            };
            sided(side, &format!("{finger} {segment}"))
        }
        BodyPart::UpperLeg(side) => sided(side, "upper leg"),
        BodyPart::LowerLeg(side) => sided(side, "lower leg"),
        BodyPart::Foot(side) => sided(side, "foot"),
        BodyPart::Toes(side) => sided(side, "toes"),
        BodyPart::ToeTip(side) => sided(side, "toe tip"),
    }
}
