//! VRM 0.x and 1.0: the names of the humanoid bones, for files whose nodes have them.
//!
//! Names: github.com/vrm-c/vrm-specification, `specification/VRMC_vrm-1.0/humanoid.md` and `specification/0.0/README.md`. The
//! thumb's first bone is thumbProximal in 0.x and thumbMetacarpal in 1.0.

use super::Profile;
use crate::rig::body_part::Finger::{Index, Little, Middle, Ring, Thumb};
use crate::rig::names::slot::Slot::{
    Clavicle, Eye, Finger, Foot, Hand, Head, Hips, Jaw, LowerArm, LowerLeg, Neck, Spine, Toes, UpperArm, UpperLeg,
};

pub const PROFILE: Profile = Profile {
    name: "VRM humanoid",
    prefixes: &[],
    rows: &[
        (Hips, "hips"),
        (Spine, "spine, chest, upperChest"),
        (Neck, "neck"),
        (Head, "head"),
        (Jaw, "jaw"),
        (Eye, "*Eye"),
        (Clavicle, "*Shoulder"),
        (UpperArm, "*UpperArm"),
        (LowerArm, "*LowerArm"),
        (Hand, "*Hand"),
        (UpperLeg, "*UpperLeg"),
        (LowerLeg, "*LowerLeg"),
        (Foot, "*Foot"),
        (Toes, "*Toes"),
        (Finger(Thumb), "*ThumbMetacarpal, *ThumbProximal, *ThumbDistal"),
        (Finger(Index), "*IndexProximal, *IndexIntermediate, *IndexDistal"),
        (Finger(Middle), "*MiddleProximal, *MiddleIntermediate, *MiddleDistal"),
        (Finger(Ring), "*RingProximal, *RingIntermediate, *RingDistal"),
        (Finger(Little), "*LittleProximal, *LittleIntermediate, *LittleDistal"),
    ],
};
