//! Unity's humanoid avatar: the names of its muscle editor and of HumanBodyBones, for rigs that are named after them.
//!
//! Names: docs.unity3d.com, `ScriptReference/HumanBodyBones` and `HumanTrait.BoneName`.

use super::Profile;
use crate::rig::body_part::Finger::{Index, Little, Middle, Ring, Thumb};
use crate::rig::names::slot::Slot::{
    Clavicle, Eye, Finger, Foot, Hand, Head, Hips, Jaw, LowerArm, LowerLeg, Neck, Spine, Toes, UpperArm, UpperLeg,
};

pub const PROFILE: Profile = Profile {
    name: "Unity humanoid",
    prefixes: &[],
    rows: &[
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
        (Finger(Thumb), "*Thumb Proximal, *Thumb Intermediate, *Thumb Distal"),
        (Finger(Index), "*Index Proximal, *Index Intermediate, *Index Distal"),
        (Finger(Middle), "*Middle Proximal, *Middle Intermediate, *Middle Distal"),
        (Finger(Ring), "*Ring Proximal, *Ring Intermediate, *Ring Distal"),
        (Finger(Little), "*Little Proximal, *Little Intermediate, *Little Distal"),
    ],
};
