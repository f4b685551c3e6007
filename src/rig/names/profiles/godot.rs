//! Godot's SkeletonProfileHumanoid.
//!
//! Names: docs.godotengine.org, class SkeletonProfileHumanoid, which lists all 56 with their parents.

use super::Profile;
use crate::rig::body_part::Finger::{Index, Little, Middle, Ring, Thumb};
use crate::rig::names::slot::Slot::{
    Clavicle, Control, Eye, Finger, Foot, Hand, Head, Hips, Jaw, LowerArm, LowerLeg, Neck, Spine, Toes, UpperArm,
    UpperLeg,
};

pub const PROFILE: Profile = Profile {
    name: "Godot SkeletonProfileHumanoid",
    prefixes: &[],
    rows: &[
        (Control, "Root"),
        (Hips, "Hips"),
        (Spine, "Spine, Chest, UpperChest"),
        (Neck, "Neck"),
        (Head, "Head"),
        (Jaw, "Jaw"),
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
