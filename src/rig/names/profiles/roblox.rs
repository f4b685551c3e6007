//! Roblox's avatars with 15 parts.
//!
//! Names: create.roblox.com, the specifications of avatar rigs (R15).

use super::Profile;
use crate::rig::names::slot::Slot::{
    Control, Foot, Hand, Head, Hips, LowerArm, LowerLeg, Prop, Spine, UpperArm, UpperLeg,
};

pub const PROFILE: Profile = Profile {
    name: "Roblox R15",
    prefixes: &[],
    rows: &[
        (Control, "Root, HumanoidRootNode, HumanoidRootPart"),
        (Hips, "LowerTorso"),
        (Spine, "UpperTorso"),
        (Head, "Head"),
        (UpperArm, "*UpperArm"),
        (LowerArm, "*LowerArm"),
        (Hand, "*Hand"),
        (UpperLeg, "*UpperLeg"),
        (LowerLeg, "*LowerLeg"),
        (Foot, "*Foot"),
        (Prop, "*Grip_Att, HandleAttachment"),
    ],
};
