//! Avatars for VRChat as the Cats plugin for Blender names them.
//!
//! Names: github.com/absolute-quantum/cats-blender-plugin, its list of renamed bones.

use super::Profile;
use crate::rig::body_part::Finger::{Index, Little, Middle, Ring, Thumb};
use crate::rig::names::slot::Slot::{
    Clavicle, Eye, Finger, Foot, Hand, Head, Hips, LowerArm, LowerLeg, Neck, Spine, Toes, UpperArm, UpperLeg,
};

pub const PROFILE: Profile = Profile {
    name: "VRChat",
    prefixes: &[],
    rows: &[
        (Hips, "Hips"),
        (Spine, "Spine, Chest, Upper Chest"),
        (Neck, "Neck"),
        (Head, "Head"),
        (Eye, "*Eye, Eye_*"),
        (Clavicle, "* shoulder"),
        (UpperArm, "* arm"),
        (LowerArm, "* elbow"),
        (Hand, "* wrist"),
        (UpperLeg, "* leg"),
        (LowerLeg, "* knee"),
        (Foot, "* ankle"),
        (Toes, "* toe"),
        (Finger(Thumb), "Thumb0_*, Thumb1_*, Thumb2_*"),
        (Finger(Index), "IndexFinger1_*, IndexFinger2_*, IndexFinger3_*"),
        (Finger(Middle), "MiddleFinger1_*, MiddleFinger2_*, MiddleFinger3_*"),
        (Finger(Ring), "RingFinger1_*, RingFinger2_*, RingFinger3_*"),
        (Finger(Little), "LittleFinger1_*, LittleFinger2_*, LittleFinger3_*"),
    ],
};
