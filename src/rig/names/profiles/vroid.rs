//! VRoid Studio's export.
//!
//! Names: the nodes of its VRM files. `J_Bip` are the body, `J_Sec` what swings, `J_Adj` the face.

use super::Profile;
use crate::rig::body_part::Finger::{Index, Little, Middle, Ring, Thumb};
use crate::rig::names::slot::Slot::{
    Clavicle, Control, Eye, Finger, Foot, Hand, Head, Hips, LowerArm, LowerLeg, Neck, Secondary, Spine, Toes, UpperArm,
    UpperLeg,
};

pub const PROFILE: Profile = Profile {
    name: "VRoid",
    prefixes: &[],
    rows: &[
        (Control, "Root"),
        (Hips, "J_Bip_C_Hips"),
        (Spine, "J_Bip_C_Spine, J_Bip_C_Chest, J_Bip_C_UpperChest"),
        (Neck, "J_Bip_C_Neck"),
        (Head, "J_Bip_C_Head"),
        (Eye, "J_Adj_*_FaceEye"),
        (Clavicle, "J_Bip_*_Shoulder"),
        (UpperArm, "J_Bip_*_UpperArm"),
        (LowerArm, "J_Bip_*_LowerArm"),
        (Hand, "J_Bip_*_Hand"),
        (UpperLeg, "J_Bip_*_UpperLeg"),
        (LowerLeg, "J_Bip_*_LowerLeg"),
        (Foot, "J_Bip_*_Foot"),
        (Toes, "J_Bip_*_ToeBase"),
        (Finger(Thumb), "J_Bip_*_Thumb1, J_Bip_*_Thumb2, J_Bip_*_Thumb3"),
        (Finger(Index), "J_Bip_*_Index1, J_Bip_*_Index2, J_Bip_*_Index3"),
        (Finger(Middle), "J_Bip_*_Middle1, J_Bip_*_Middle2, J_Bip_*_Middle3"),
        (Finger(Ring), "J_Bip_*_Ring1, J_Bip_*_Ring2, J_Bip_*_Ring3"),
        (Finger(Little), "J_Bip_*_Little1, J_Bip_*_Little2, J_Bip_*_Little3"),
        (Secondary, "J_Sec_*_Bust#, J_Opt_*_CatEar#"),
    ],
};
