//! Mixamo's auto-rigger, Ready Player Me (the same without prefix), and what follows them.
//!
//! Names: the joints of a character that mixamo.com exports; Ready Player Me's documentation of its full-body avatars.

use super::Profile;
use crate::rig::body_part::Finger::{Index, Little, Middle, Ring, Thumb};
use crate::rig::names::slot::Slot::{
    Clavicle, Control, Eye, Finger, Foot, Hand, Head, HeadTop, Hips, Jaw, LowerArm, LowerLeg, Neck, Spine, ToeTip,
    Toes, UpperArm, UpperLeg,
};

pub const PROFILE: Profile = Profile {
    name: "Mixamo",
    prefixes: &["mixamorig"],
    rows: &[
        (Hips, "Hips"),
        (Spine, "Spine#"),
        (Neck, "Neck#"),
        (Head, "Head"),
        (HeadTop, "HeadTop_End"),
        (Eye, "*Eye"),
        (Jaw, "Jaw"),
        (Clavicle, "*Shoulder"),
        (UpperArm, "*Arm"),
        (LowerArm, "*ForeArm"),
        (Hand, "*Hand"),
        (UpperLeg, "*UpLeg"),
        (LowerLeg, "*Leg"),
        (Foot, "*Foot"),
        (Toes, "*ToeBase"),
        (ToeTip, "*Toe_End"),
        (Finger(Thumb), "*HandThumb1, *HandThumb2, *HandThumb3, *HandThumb4"),
        (Finger(Index), "*HandIndex1, *HandIndex2, *HandIndex3, *HandIndex4"),
        (Finger(Middle), "*HandMiddle1, *HandMiddle2, *HandMiddle3, *HandMiddle4"),
        (Finger(Ring), "*HandRing1, *HandRing2, *HandRing3, *HandRing4"),
        (Finger(Little), "*HandPinky1, *HandPinky2, *HandPinky3, *HandPinky4"),
        (Control, "Armature, AvatarRoot"),
    ],
};
