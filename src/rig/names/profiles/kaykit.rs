//! KayKit's character packs.
//!
//! Names: the nodes of its Adventurers pack. The hand begins at the wrist; the joint called hand is in the palm.

use super::Profile;
use crate::rig::names::slot::Slot::{
    Control, Foot, Hand, Head, Hips, LowerArm, LowerLeg, Prop, Spine, Toes, Twist, UpperArm, UpperLeg,
};

pub const PROFILE: Profile = Profile {
    name: "KayKit",
    prefixes: &[],
    rows: &[
        (
            Control,
            "root, kneeIK.*, heelIK.*, IK-foot.*, IK-toe.*, control-foot-roll.*, control-heel-roll.*, control-toe-roll.*, elbowIK.*, handIK.*",
        ),
        (Hips, "hips"),
        (Spine, "spine, chest"),
        (Head, "head"),
        (UpperArm, "upperarm.*"),
        (LowerArm, "lowerarm.*"),
        (Hand, "wrist.*"),
        (UpperLeg, "upperleg.*"),
        (LowerLeg, "lowerleg.*"),
        (Foot, "foot.*"),
        (Toes, "toes.*"),
        (Twist, "hand.*"),
        (Prop, "handslot.*"),
    ],
};
