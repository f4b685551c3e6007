//! The figures among Khronos' sample models, which were made with COLLADA tools: RiggedFigure and CesiumMan.
//!
//! Names: github.com/KhronosGroup/glTF-Sample-Assets. The joints of a limb have one name and count, in one of the files downwards, so that
//! the tree says which is which.

use super::Profile;
use crate::rig::names::slot::Slot::{Arm, Control, Leg, Neck, Trunk};

pub const PROFILE: Profile = Profile {
    name: "Khronos samples",
    prefixes: &["Skeleton_"],
    rows: &[
        (Trunk, "torso_joint_#"),
        (Neck, "neck_joint_#"),
        (Arm, "arm_joint_*_#"),
        (Leg, "leg_joint_*_#"),
        (Control, "Armature, Z_UP"),
    ],
};
