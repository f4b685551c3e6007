//! What a joint is to a body, whatever its name: the fullest rig, of which each naming leaves some joints out.

/// Left (+x) or right.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Side {
    /// At +x, for the body faces -y.
    Left,
    /// At -x.
    Right,
}

/// Left and right.
pub const SIDES: [Side; 2] = [Side::Left, Side::Right];

/// Fingers from the thumb on.
pub const FINGERS: usize = 5;

/// What a joint is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Role {
    /// On the floor; nothing is weighted to it.
    Root,
    /// The root of the body.
    Hips,
    /// From 0, above the hips, to 2, between the shoulders.
    Spine(usize),
    /// Below the head.
    Neck,
    /// Where the head begins.
    Head,
    /// Top of the head.
    HeadEnd,
    /// Between the spine and a shoulder.
    Clavicle(Side),
    /// At the shoulder.
    UpperArm(Side),
    /// Half-way to the elbow.
    UpperArmTwist(Side),
    /// At the elbow.
    LowerArm(Side),
    /// Half-way to the wrist.
    LowerArmTwist(Side),
    /// At the wrist.
    Wrist(Side),
    /// A little beyond the wrist, where a rig has a joint for each.
    Hand(Side),
    /// A finger from 0, the thumb, and its joint from 0, at the knuckle, to 2.
    Finger(Side, usize, usize),
    /// What a hand holds.
    Slot(Side),
    /// At the hip.
    Thigh(Side),
    /// Half-way to the knee.
    ThighTwist(Side),
    /// At the knee.
    Calf(Side),
    /// At the ankle.
    Foot(Side),
    /// At the ball of the foot.
    Toe(Side),
    /// Tip of the toes.
    ToeEnd(Side),
    /// What the feet's inverse kinematics hang on, on the floor.
    FeetControl,
    /// What the hands' inverse kinematics hang on, on the floor.
    HandsControl,
    /// Target of a foot.
    FootTarget(Side),
    /// Target of a hand.
    HandTarget(Side),
    /// In front of a knee.
    KneePole(Side),
    /// Behind an elbow.
    ElbowPole(Side),
}

impl Role {
    /// All of them, each after the one that moves it.
    pub fn all() -> Vec<Self> {
        let mut all = vec![Self::Root, Self::Hips, Self::Spine(0), Self::Spine(1), Self::Spine(2)];
        all.extend([Self::Neck, Self::Head, Self::HeadEnd]);
        for side in SIDES {
            all.extend([Self::Clavicle(side), Self::UpperArm(side), Self::UpperArmTwist(side), Self::LowerArm(side)]);
            all.extend([Self::LowerArmTwist(side), Self::Wrist(side), Self::Hand(side)]);
            all.extend((0..FINGERS).flat_map(|finger| (0..3).map(move |k| Self::Finger(side, finger, k))));
            all.push(Self::Slot(side));
        }
        for side in SIDES {
            all.extend([Self::Thigh(side), Self::ThighTwist(side), Self::Calf(side), Self::Foot(side)]);
            all.extend([Self::Toe(side), Self::ToeEnd(side)]);
        }
        all.extend([Self::FeetControl, Self::HandsControl]);
        for side in SIDES {
            all.extend([Self::FootTarget(side), Self::HandTarget(side), Self::KneePole(side), Self::ElbowPole(side)]);
        }
        all
    }

    /// The role that this one moves with.
    pub fn above(self) -> Option<Self> {
        Some(match self {
            Self::Root => return None,
            Self::Hips | Self::FeetControl | Self::HandsControl => Self::Root,
            Self::Spine(0) | Self::Thigh(_) => Self::Hips,
            Self::Spine(k) => Self::Spine(k - 1),
            Self::Neck | Self::Clavicle(_) => Self::Spine(2),
            Self::Head => Self::Neck,
            Self::HeadEnd => Self::Head,
            Self::UpperArm(side) => Self::Clavicle(side),
            Self::UpperArmTwist(side) | Self::LowerArm(side) => Self::UpperArm(side),
            Self::LowerArmTwist(side) | Self::Wrist(side) => Self::LowerArm(side),
            Self::Hand(side) => Self::Wrist(side),
            Self::Finger(side, _, 0) | Self::Slot(side) => Self::Hand(side),
            Self::Finger(side, finger, k) => Self::Finger(side, finger, k - 1),
            Self::ThighTwist(side) | Self::Calf(side) => Self::Thigh(side),
            Self::Foot(side) => Self::Calf(side),
            Self::Toe(side) => Self::Foot(side),
            Self::ToeEnd(side) => Self::Toe(side),
            Self::FootTarget(_) | Self::KneePole(_) => Self::FeetControl,
            Self::HandTarget(_) | Self::ElbowPole(_) => Self::HandsControl,
        })
    }

    /// The role towards which a joint's bone points; none at the ends.
    pub fn ahead(self) -> Option<Self> {
        Some(match self {
            Self::Hips => Self::Spine(0),
            Self::Spine(2) => Self::Neck,
            Self::Spine(k) => Self::Spine(k + 1),
            Self::Neck => Self::Head,
            Self::Head => Self::HeadEnd,
            Self::Clavicle(side) => Self::UpperArm(side),
            Self::UpperArm(side) | Self::UpperArmTwist(side) => Self::LowerArm(side),
            Self::LowerArm(side) | Self::LowerArmTwist(side) => Self::Wrist(side),
            Self::Wrist(side) | Self::Hand(side) => Self::Finger(side, 2, 0),
            Self::Finger(side, finger, k) if k < 2 => Self::Finger(side, finger, k + 1),
            Self::Thigh(side) | Self::ThighTwist(side) => Self::Calf(side),
            Self::Calf(side) => Self::Foot(side),
            Self::Foot(side) => Self::Toe(side),
            Self::Toe(side) => Self::ToeEnd(side),
            _ => return None,
        })
    }

    /// The side of a limb; none for the trunk.
    pub fn side(self) -> Option<Side> {
        match self {
            Self::Root | Self::Hips | Self::Spine(_) | Self::Neck | Self::Head | Self::HeadEnd => None,
            Self::FeetControl | Self::HandsControl => None,
            Self::Clavicle(side)
            | Self::UpperArm(side)
            | Self::UpperArmTwist(side)
            | Self::LowerArm(side)
            | Self::LowerArmTwist(side)
            | Self::Wrist(side)
            | Self::Hand(side)
            | Self::Finger(side, ..)
            | Self::Slot(side)
            | Self::Thigh(side)
            | Self::ThighTwist(side)
            | Self::Calf(side)
            | Self::Foot(side)
            | Self::Toe(side)
            | Self::ToeEnd(side)
            | Self::FootTarget(side)
            | Self::HandTarget(side)
            | Self::KneePole(side)
            | Self::ElbowPole(side) => Some(side),
        }
    }

    /// True for what moves no flesh: targets, poles, what stands on the floor, what a hand holds.
    pub fn is_control(self) -> bool {
        matches!(
            self,
            Self::Root
                | Self::FeetControl
                | Self::HandsControl
                | Self::FootTarget(_)
                | Self::HandTarget(_)
                | Self::KneePole(_)
                | Self::ElbowPole(_)
                | Self::Slot(_)
        )
    }
}
