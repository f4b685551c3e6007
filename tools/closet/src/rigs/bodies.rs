//! Bodies to rig: those of the closet, and two in the proportions of toys.

use crate::avatars::{Avatar, avatar};
use crate::body::{self, Build};
use crate::skeleton::Proportions;
use crate::texture::Texture;
use crate::{Kind, Sample, body_mesh, sample, shape, skin};

/// A body that can be rigged.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Body {
    /// The one on which the closet's garments are designed.
    Mannequin,
    /// One of those to dress.
    Avatar(Avatar),
    /// A head that is wider than the shoulders, on short limbs.
    BigHead,
    /// Arms and legs as thick as they can be.
    ThickLimbs,
}

impl Body {
    /// The body with this name.
    pub fn named(name: &str) -> Option<Self> {
        match name {
            "mannequin" => Some(Self::Mannequin),
            "big-head" => Some(Self::BigHead),
            "thick-limbs" => Some(Self::ThickLimbs),
            name => Avatar::ALL.into_iter().find(|avatar| avatar.name() == name).map(Self::Avatar),
        }
    }

    /// Models the body. The result depends on `self` alone.
    pub fn model(self) -> Sample {
        match self {
            Self::Mannequin => sample(Kind::Mannequin),
            Self::Avatar(name) => avatar(name),
            Self::BigHead => modelled(big_head()),
            Self::ThickLimbs => modelled(thick_limbs()),
        }
    }
}

fn modelled((proportions, build): (Proportions, Build)) -> Sample {
    let skeleton = proportions.skeleton();
    let solid = body::body(&skeleton, &build);
    let mesh = body_mesh(&skeleton, &build, &solid);
    let skin = skin::skin(&mesh, &solid);
    Sample { mesh, skeleton, skin, texture: Texture::default(), no_fit: Vec::new() }
}

fn big_head() -> (Proportions, Build) {
    let (proportions, build) = shape(Kind::Mannequin);
    let proportions = Proportions {
        ankle: 0.070,
        shin: 0.180,
        thigh: 0.190,
        leg_angle: 6.0,
        hip: 0.085,
        belly: 0.070,
        chest: 0.290,
        shoulder: 0.150,
        shoulder_drop: 0.095,
        upper_arm: 0.170,
        forearm: 0.160,
        arm_angle: 40.0,
        ..proportions
    };
    let build = Build { hips: 0.9, waist: 1.05, chest: 0.95, bust: 0.5, head: 2.5, hands: 1.4, feet: 1.1, ..build };
    (proportions, build)
}

fn thick_limbs() -> (Proportions, Build) {
    let (proportions, build) = shape(Kind::Mannequin);
    let proportions = Proportions {
        shin: 0.360,
        thigh: 0.360,
        leg_angle: 12.0,
        hip: 0.150,
        shoulder: 0.240,
        upper_arm: 0.260,
        forearm: 0.240,
        arm_angle: 40.0,
        ..proportions
    };
    let build = Build {
        hips: 1.5,
        waist: 1.5,
        chest: 1.6,
        depth: 1.3,
        arms: 2.0,
        legs: 1.6,
        neck: 1.5,
        head: 1.1,
        hands: 1.7,
        feet: 1.6,
        ..build
    };
    (proportions, build)
}
