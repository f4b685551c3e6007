//! The parts of a person's body that a joint of a rig can stand for.

/// A side of the body, the person's own.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Side {
    /// The person's left.
    Left,
    /// The person's right.
    Right,
}

impl Side {
    /// Both.
    pub const BOTH: [Self; 2] = [Self::Left, Self::Right];

    /// The other one.
    pub fn other(self) -> Self {
        match self {
            Self::Left => Self::Right,
            Self::Right => Self::Left,
        }
    }
}

/// A finger.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Finger {
    /// The thumb.
    Thumb,
    /// The finger beside the thumb.
    Index,
    /// The third.
    Middle,
    /// The fourth.
    Ring,
    /// The smallest.
    Little,
}

/// A part of the body, named after the bone that begins at the joint: [`BodyPart::LowerArm`] is the elbow.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum BodyPart {
    /// Where trunk and legs meet.
    Hips,
    /// The trunk between hips and neck; a rig may have several, in order from the hips.
    Spine,
    /// A rig may have several, in order from the spine.
    Neck,
    /// The head, from the first joint that turns it.
    Head,
    /// The end of the head, which moves nothing.
    HeadTop,
    /// The lower jaw.
    Jaw,
    /// An eyeball.
    Eye(Side),
    /// The collar bone.
    Clavicle(Side),
    /// Begins at the shoulder.
    UpperArm(Side),
    /// Begins at the elbow.
    LowerArm(Side),
    /// Begins at the wrist.
    Hand(Side),
    /// A bone of a finger.
    Finger {
        /// Which hand.
        side: Side,
        /// Which finger.
        finger: Finger,
        /// 0 is in the palm (metacarpal), 1 the first bone that is free, 2 and 3 those after it, 4 the tip. The three bones of
        /// a thumb are 1 to 3, whatever a rig calls them.
        segment: u8,
    },
    /// Begins at the hip.
    UpperLeg(Side),
    /// Begins at the knee.
    LowerLeg(Side),
    /// Begins at the ankle.
    Foot(Side),
    /// Begins at the ball of the foot.
    Toes(Side),
    /// The end of the foot, which moves nothing.
    ToeTip(Side),
}

impl BodyPart {
    /// Whether a rig may have several joints of this part.
    pub fn is_repeated(self) -> bool {
        matches!(self, Self::Spine | Self::Neck)
    }

    /// Whether it is what comes out of a collar or a cuff: the head, and not the neck, or a hand.
    pub fn is_beyond_clothes(self) -> bool {
        matches!(self, Self::Head | Self::HeadTop | Self::Jaw | Self::Eye(_) | Self::Hand(_) | Self::Finger { .. })
    }

    /// Which side it is on; none for what lies in the middle.
    pub fn side(self) -> Option<Side> {
        match self {
            Self::Hips | Self::Spine | Self::Neck | Self::Head | Self::HeadTop | Self::Jaw => None,
            Self::Eye(side)
            | Self::Clavicle(side)
            | Self::UpperArm(side)
            | Self::LowerArm(side)
            | Self::Hand(side)
            | Self::Finger { side, .. }
            | Self::UpperLeg(side)
            | Self::LowerLeg(side)
            | Self::Foot(side)
            | Self::Toes(side)
            | Self::ToeTip(side) => Some(side),
        }
    }
}
