//! Xsens' motion capture.
//!
//! Names: the segments in its MVN files, which name the trunk by its vertebrae.

use super::Profile;
use crate::rig::names::slot::Slot::{
    Clavicle, Foot, Hand, Head, Hips, LowerArm, LowerLeg, Neck, Spine, Toes, UpperArm, UpperLeg,
};

pub const PROFILE: Profile = Profile {
    name: "Xsens",
    prefixes: &[],
    rows: &[
        (Hips, "Pelvis"),
        (Spine, "L5, L3, T12, T8"),
        (Neck, "Neck"),
        (Head, "Head"),
        (Clavicle, "*Shoulder"),
        (UpperArm, "*UpperArm"),
        (LowerArm, "*ForeArm"),
        (Hand, "*Hand"),
        (UpperLeg, "*UpperLeg"),
        (LowerLeg, "*LowerLeg"),
        (Foot, "*Foot"),
        (Toes, "*Toe"),
    ],
};
