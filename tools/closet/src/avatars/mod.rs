//! The bodies to dress, and the mannequin.

mod child;
mod clay;
mod dinosaur;
mod elemental;
mod extremities;
mod figure;
mod giant;
mod head;
mod heavy;
mod long_arms;
mod robot;
mod skeleton;
mod slim;
mod sweep;
mod tall;
mod two_headed;

use super::Sample;

/// A body of the closet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Avatar {
    /// Slender.
    Slim,
    /// Much heavier, with shorter arms.
    Heavy,
    /// Long legs, long trunk.
    Tall,
    /// Large head, short limbs.
    Child,
    /// The trunk an inverted triangle, fists like hammers.
    Giant,
    /// A creature with very long arms.
    LongArms,
    /// Bones, hardly connected.
    Skeleton,
    /// Floating stones.
    Elemental,
    /// Two heads on one trunk.
    TwoHeaded,
    /// Boxes and thin wires.
    Robot,
    /// Bent forward, with a tail: the hard case.
    Dinosaur,
}

impl Avatar {
    /// All of them, in the order of the gallery's columns.
    pub const ALL: [Self; 11] = [
        Self::Slim,
        Self::Heavy,
        Self::Tall,
        Self::Child,
        Self::Giant,
        Self::LongArms,
        Self::Skeleton,
        Self::Elemental,
        Self::TwoHeaded,
        Self::Robot,
        Self::Dinosaur,
    ];

    /// A name for files and tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::Slim => "slim",
            Self::Heavy => "heavy",
            Self::Tall => "tall",
            Self::Child => "child",
            Self::Giant => "giant",
            Self::LongArms => "long-arms",
            Self::Skeleton => "skeleton",
            Self::Elemental => "elemental",
            Self::TwoHeaded => "two-headed",
            Self::Robot => "robot",
            Self::Dinosaur => "dinosaur",
        }
    }
}

/// Models a body. The result depends on `avatar` alone.
pub fn avatar(avatar: Avatar) -> Sample {
    match avatar {
        Avatar::Slim => slim::slim(),
        Avatar::Heavy => heavy::heavy(),
        Avatar::Tall => tall::tall(),
        Avatar::Child => child::child(),
        Avatar::Giant => giant::giant(),
        Avatar::LongArms => long_arms::long_arms(),
        Avatar::TwoHeaded => two_headed::two_headed(),
        Avatar::Skeleton => skeleton::skeleton(),
        Avatar::Elemental => elemental::elemental(),
        Avatar::Robot => robot::robot(),
        Avatar::Dinosaur => dinosaur::dinosaur(),
    }
}
