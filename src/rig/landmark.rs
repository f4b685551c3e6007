//! The joints of the skeleton that two rigs of people have in common, whatever else is in either.
//!
//! The ends of the feet are among them only for a garment that is worn there: for all others they would be bones that stick out
//! of trousers and skirts.

use super::body_part::{BodyPart, Side};

/// A joint of the common skeleton of two people: those of the published skeletons, the top of the head, and the ends of the feet.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Landmark {
    /// Where the trunk begins.
    Pelvis,
    /// In the trunk, nearer to the pelvis.
    Waist,
    /// Where the trunk ends, above the shoulders.
    Neck,
    /// The top of the head.
    HeadTop,
    /// Where an upper arm begins.
    Shoulder(Side),
    /// Between upper and lower arm.
    Elbow(Side),
    /// Where a hand begins.
    Wrist(Side),
    /// Where an upper leg begins.
    Hip(Side),
    /// Between upper and lower leg.
    Knee(Side),
    /// Where a foot begins.
    Ankle(Side),
    /// Among the toes, for what is worn on the feet.
    Toes(Side),
}

use Landmark::{Ankle, Elbow, HeadTop, Hip, Knee, Neck, Pelvis, Shoulder, Toes, Waist, Wrist};
use Side::{Left, Right};

impl Landmark {
    /// How many there are.
    pub const COUNT: usize = 18;

    /// All, in the order of the published skeletons, each after its parent.
    pub const ALL: [Self; Self::COUNT] = [
        Pelvis,
        Waist,
        Neck,
        Shoulder(Left),
        Elbow(Left),
        Wrist(Left),
        Shoulder(Right),
        Elbow(Right),
        Wrist(Right),
        Hip(Left),
        Knee(Left),
        Ankle(Left),
        Hip(Right),
        Knee(Right),
        Ankle(Right),
        HeadTop,
        Toes(Left),
        Toes(Right),
    ];

    /// The landmark at the other end of the bone that leads to this one.
    pub fn parent(self) -> Option<Self> {
        match self {
            Pelvis => None,
            Waist => Some(Pelvis),
            Neck => Some(Waist),
            HeadTop => Some(Neck),
            Shoulder(_) => Some(Neck),
            Elbow(side) => Some(Shoulder(side)),
            Wrist(side) => Some(Elbow(side)),
            Hip(_) => Some(Pelvis),
            Knee(side) => Some(Hip(side)),
            Ankle(side) => Some(Knee(side)),
            Toes(side) => Some(Ankle(side)),
        }
    }

    /// The joint of a rig that lies in this place; none for those that a rig may have no joint for.
    pub fn part(self) -> Option<BodyPart> {
        match self {
            Pelvis => Some(BodyPart::Hips),
            // A joint of that name is nearer to the ankle.
            Waist | Toes(_) => None,
            Neck => Some(BodyPart::Neck),
            HeadTop => Some(BodyPart::HeadTop),
            Shoulder(side) => Some(BodyPart::UpperArm(side)),
            Elbow(side) => Some(BodyPart::LowerArm(side)),
            Wrist(side) => Some(BodyPart::Hand(side)),
            Hip(side) => Some(BodyPart::UpperLeg(side)),
            Knee(side) => Some(BodyPart::LowerLeg(side)),
            Ankle(side) => Some(BodyPart::Foot(side)),
        }
    }

    /// The landmark at whose bones a part of the body lies: that of the trunk for collar bones, the top of the head for all of
    /// head and neck, the wrist for a hand with its fingers, the toes for a foot.
    pub fn of(part: BodyPart) -> Self {
        match part {
            BodyPart::Hips => Pelvis,
            BodyPart::Spine | BodyPart::Clavicle(_) => Waist,
            BodyPart::Neck | BodyPart::Head | BodyPart::HeadTop | BodyPart::Jaw | BodyPart::Eye(_) => HeadTop,
            BodyPart::UpperArm(side) => Shoulder(side),
            BodyPart::LowerArm(side) => Elbow(side),
            BodyPart::Hand(side) | BodyPart::Finger { side, .. } => Wrist(side),
            BodyPart::UpperLeg(side) => Hip(side),
            BodyPart::LowerLeg(side) => Knee(side),
            BodyPart::Foot(side) | BodyPart::Toes(side) | BodyPart::ToeTip(side) => Toes(side),
        }
    }

    /// It and the one on the other side, in messages.
    pub fn both(self) -> &'static str {
        match self {
            Shoulder(_) => "shoulders",
            Elbow(_) => "elbows",
            Wrist(_) => "wrists",
            Hip(_) => "hips",
            Knee(_) => "knees",
            Ankle(_) => "ankles",
            Toes(_) => "toes",
            other => other.name(),
        }
    }

    /// Its name in messages.
    pub fn name(self) -> &'static str {
        match self {
            Pelvis => "pelvis",
            Waist => "waist",
            Neck => "neck",
            HeadTop => "top of the head",
            Shoulder(Left) => "left shoulder",
            Shoulder(Right) => "right shoulder",
            Elbow(Left) => "left elbow",
            Elbow(Right) => "right elbow",
            Wrist(Left) => "left wrist",
            Wrist(Right) => "right wrist",
            Hip(Left) => "left hip",
            Hip(Right) => "right hip",
            Knee(Left) => "left knee",
            Knee(Right) => "right knee",
            Ankle(Left) => "left ankle",
            Ankle(Right) => "right ankle",
            Toes(Left) => "left toes",
            Toes(Right) => "right toes",
        }
    }
}
