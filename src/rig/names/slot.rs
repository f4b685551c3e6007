//! What a row of a table of names can stand for.

use super::super::body_part::{BodyPart, Finger, Side};

/// A part of the body without its side, or what else a joint can be.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Slot {
    /// [`BodyPart::Hips`].
    Hips,
    /// [`BodyPart::Spine`].
    Spine,
    /// A joint of the trunk or of what is above it: which one, only the tree says.
    Trunk,
    /// A joint of an arm: which one, only the tree says.
    Arm,
    /// A joint of a leg: which one, only the tree says.
    Leg,
    /// [`BodyPart::Neck`].
    Neck,
    /// [`BodyPart::Head`].
    Head,
    /// [`BodyPart::HeadTop`].
    HeadTop,
    /// [`BodyPart::Jaw`].
    Jaw,
    /// [`BodyPart::Eye`].
    Eye,
    /// [`BodyPart::Clavicle`].
    Clavicle,
    /// [`BodyPart::UpperArm`].
    UpperArm,
    /// [`BodyPart::LowerArm`].
    LowerArm,
    /// [`BodyPart::Hand`].
    Hand,
    /// [`BodyPart::UpperLeg`].
    UpperLeg,
    /// [`BodyPart::LowerLeg`].
    LowerLeg,
    /// [`BodyPart::Foot`].
    Foot,
    /// [`BodyPart::Toes`].
    Toes,
    /// [`BodyPart::ToeTip`].
    ToeTip,
    /// The bones of a finger. In a table: in order from the first that is free to the tip.
    Finger(Finger),
    /// The bone of a finger that is in the palm.
    Palm(Finger),
    /// A helper along a limb.
    Twist,
    /// Moves other joints, or nothing.
    Control,
    /// Where a thing is held or carried.
    Prop,
    /// Hair, clothes, face and what else hangs on a body.
    Secondary,
}

impl Slot {
    /// The part of the body, where there is one and it needs no more than its side.
    pub fn part(self, side: Option<Side>) -> Option<BodyPart> {
        Some(match self {
            Self::Hips => BodyPart::Hips,
            Self::Spine => BodyPart::Spine,
            Self::Neck => BodyPart::Neck,
            Self::Head => BodyPart::Head,
            Self::HeadTop => BodyPart::HeadTop,
            Self::Jaw => BodyPart::Jaw,
            Self::Eye => BodyPart::Eye(side?),
            Self::Clavicle => BodyPart::Clavicle(side?),
            Self::UpperArm => BodyPart::UpperArm(side?),
            Self::LowerArm => BodyPart::LowerArm(side?),
            Self::Hand => BodyPart::Hand(side?),
            Self::UpperLeg => BodyPart::UpperLeg(side?),
            Self::LowerLeg => BodyPart::LowerLeg(side?),
            Self::Foot => BodyPart::Foot(side?),
            Self::Toes => BodyPart::Toes(side?),
            Self::ToeTip => BodyPart::ToeTip(side?),
            Self::Trunk | Self::Arm | Self::Leg | Self::Finger(_) | Self::Palm(_) => return None,
            Self::Twist | Self::Control | Self::Prop | Self::Secondary => return None,
        })
    }
}
