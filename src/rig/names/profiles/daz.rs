//! DAZ Studio's figures: Genesis 3 and 8, which have bend and twist joints, and Genesis 9.
//!
//! Names: docs.daz3d.com, the bones of the figures. `hip` holds trunk and pelvis, the pelvis the legs.

use super::Profile;
use crate::rig::body_part::Finger::{Index, Little, Middle, Ring, Thumb};
use crate::rig::names::slot::Slot::{
    Clavicle, Eye, Finger, Foot, Hand, Head, Hips, Jaw, LowerArm, LowerLeg, Neck, Palm, Secondary, Spine, Toes, Twist,
    UpperArm, UpperLeg,
};

pub const GENESIS_8: Profile = Profile {
    name: "DAZ Genesis 8",
    prefixes: &[],
    rows: &[
        (Hips, "hip"),
        (Spine, "abdomen, abdomen2, abdomenLower, abdomenUpper, chest, chestLower, chestUpper"),
        (Neck, "neck, neckLower, neckUpper"),
        (Head, "head"),
        (Jaw, "lowerJaw"),
        (Eye, "*Eye"),
        (Clavicle, "*Collar"),
        (UpperArm, "*Shldr, *ShldrBend"),
        (LowerArm, "*ForeArm, *ForearmBend"),
        (Hand, "*Hand"),
        (UpperLeg, "*Thigh, *ThighBend"),
        (LowerLeg, "*Shin"),
        (Foot, "*Foot"),
        (Toes, "*Toe"),
        (Palm(Index), "*Carpal1"),
        (Palm(Middle), "*Carpal2"),
        (Palm(Ring), "*Carpal3"),
        (Palm(Little), "*Carpal4"),
        (Finger(Thumb), "*Thumb1, *Thumb2, *Thumb3"),
        (Finger(Index), "*Index1, *Index2, *Index3"),
        (Finger(Middle), "*Mid1, *Mid2, *Mid3"),
        (Finger(Ring), "*Ring1, *Ring2, *Ring3"),
        (Finger(Little), "*Pinky1, *Pinky2, *Pinky3"),
        (
            Twist,
            "pelvis, *ShldrTwist, *ForearmTwist, *ThighTwist, *Metatarsals, *Heel, *BigToe, *BigToe_2, *SmallToe1, *SmallToe1_2, *SmallToe2, *SmallToe2_2, *SmallToe3, *SmallToe3_2, *SmallToe4, *SmallToe4_2",
        ),
        (
            Secondary,
            "*Pectoral, upperTeeth, lowerTeeth, tongue01, tongue02, tongue03, tongue04, upperFaceRig, lowerFaceRig, *Ear",
        ),
    ],
};

pub const GENESIS_9: Profile = Profile {
    name: "DAZ Genesis 9",
    prefixes: &[],
    rows: &[
        (Hips, "hip"),
        (Spine, "spine1, spine2, spine3, spine4"),
        (Neck, "neck1, neck2"),
        (Head, "head"),
        (Jaw, "lowerjaw"),
        (Eye, "*_eye"),
        (Clavicle, "*_shoulder"),
        (UpperArm, "*_upperarm"),
        (LowerArm, "*_forearm"),
        (Hand, "*_hand"),
        (UpperLeg, "*_thigh"),
        (LowerLeg, "*_shin"),
        (Foot, "*_foot"),
        (Toes, "*_toes"),
        (Palm(Index), "*_indexmetacarpal"),
        (Palm(Middle), "*_midmetacarpal"),
        (Palm(Ring), "*_ringmetacarpal"),
        (Palm(Little), "*_pinkymetacarpal"),
        (Finger(Thumb), "*_thumb1, *_thumb2, *_thumb3"),
        (Finger(Index), "*_index1, *_index2, *_index3"),
        (Finger(Middle), "*_mid1, *_mid2, *_mid3"),
        (Finger(Ring), "*_ring1, *_ring2, *_ring3"),
        (Finger(Little), "*_pinky1, *_pinky2, *_pinky3"),
        (
            Twist,
            "pelvis, *_upperarmtwist1, *_upperarmtwist2, *_forearmtwist1, *_forearmtwist2, *_thightwist1, *_thightwist2, *_metatarsal, *_bigtoe1, *_bigtoe2, *_indextoe1, *_indextoe2, *_midtoe1, *_midtoe2, *_ringtoe1, *_ringtoe2, *_pinkytoe1, *_pinkytoe2",
        ),
        (Secondary, "*_pectoral, *_ear, tongue01, tongue02, tongue03, tongue04, tongue05"),
    ],
};
