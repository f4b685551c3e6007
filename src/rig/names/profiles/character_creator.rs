//! Reallusion's Character Creator and iClone.
//!
//! Names: manual.reallusion.com, the bones of CC3+ and CC4 characters. `CC_Base_Hip` holds trunk and legs, the pelvis below it the legs.

use super::Profile;
use crate::rig::body_part::Finger::{Index, Little, Middle, Ring, Thumb};
use crate::rig::names::slot::Slot::{
    Clavicle, Control, Eye, Finger, Foot, Hand, Head, Hips, Jaw, LowerArm, LowerLeg, Neck, Secondary, Spine, Toes,
    Twist, UpperArm, UpperLeg,
};

pub const PROFILE: Profile = Profile {
    name: "Character Creator",
    prefixes: &["CC_Base_"],
    rows: &[
        (Control, "BoneRoot, RL_BoneRoot"),
        (Hips, "Hip"),
        (Spine, "Waist, Spine01, Spine02"),
        (Neck, "NeckTwist01, NeckTwist02"),
        (Head, "Head"),
        (Jaw, "JawRoot"),
        (Eye, "*_Eye"),
        (Clavicle, "*_Clavicle"),
        (UpperArm, "*_Upperarm"),
        (LowerArm, "*_Forearm"),
        (Hand, "*_Hand"),
        (UpperLeg, "*_Thigh"),
        (LowerLeg, "*_Calf"),
        (Foot, "*_Foot"),
        (Toes, "*_ToeBase"),
        (Finger(Thumb), "*_Thumb1, *_Thumb2, *_Thumb3"),
        (Finger(Index), "*_Index1, *_Index2, *_Index3"),
        (Finger(Middle), "*_Mid1, *_Mid2, *_Mid3"),
        (Finger(Ring), "*_Ring1, *_Ring2, *_Ring3"),
        (Finger(Little), "*_Pinky1, *_Pinky2, *_Pinky3"),
        (
            Twist,
            "Pelvis, *_UpperarmTwist01, *_UpperarmTwist02, *_ForearmTwist01, *_ForearmTwist02, *_ThighTwist01, *_ThighTwist02, *_CalfTwist01, *_CalfTwist02, *_ElbowShareBone, *_KneeShareBone, *_ToeBaseShareBone, *_RibsTwist, *_BigToe1, *_IndexToe1, *_MidToe1, *_RingToe1, *_PinkyToe1",
        ),
        (Secondary, "FacialBone, UpperJaw, Teeth01, Teeth02, Tongue01, Tongue02, Tongue03, *_Breast"),
    ],
};
