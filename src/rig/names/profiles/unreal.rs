//! Epic's mannequins of Unreal Engine 4 and 5, MetaHuman's body, and MakeHuman's rig for game engines, which has its names.
//!
//! Names: the skeletons SK_Mannequin, SKM_Manny and metahuman_base_skel, as Unreal Engine's documentation of the IK retargeter and of
//! MetaHuman lists them; MPFB's `rig.game_engine.json` and `rig.ue5.json`.

use super::Profile;
use crate::rig::body_part::Finger::{Index, Little, Middle, Ring, Thumb};
use crate::rig::names::slot::Slot::{
    Clavicle, Control, Finger, Foot, Hand, Head, Hips, LowerArm, LowerLeg, Neck, Palm, Prop, Secondary, Spine, ToeTip,
    Toes, Twist, UpperArm, UpperLeg,
};

pub const PROFILE: Profile = Profile {
    name: "Unreal mannequin",
    prefixes: &[],
    rows: &[
        (Hips, "pelvis"),
        (Spine, "spine_#"),
        (Neck, "neck_#"),
        (Head, "head"),
        (Clavicle, "clavicle_*"),
        (UpperArm, "upperarm_*"),
        (LowerArm, "lowerarm_*"),
        (Hand, "hand_*"),
        (UpperLeg, "thigh_*"),
        (LowerLeg, "calf_*"),
        (Foot, "foot_*"),
        (Toes, "ball_*"),
        (ToeTip, "ball_leaf_*"),
        (Finger(Thumb), "thumb_01_*, thumb_02_*, thumb_03_*"),
        (Finger(Index), "index_01_*, index_02_*, index_03_*"),
        (Finger(Middle), "middle_01_*, middle_02_*, middle_03_*"),
        (Finger(Ring), "ring_01_*, ring_02_*, ring_03_*"),
        (Finger(Little), "pinky_01_*, pinky_02_*, pinky_03_*"),
        (Palm(Index), "index_metacarpal_*"),
        (Palm(Middle), "middle_metacarpal_*"),
        (Palm(Ring), "ring_metacarpal_*"),
        (Palm(Little), "pinky_metacarpal_*"),
        (
            Twist,
            "upperarm_twist_#_*, lowerarm_twist_#_*, thigh_twist_#_*, calf_twist_#_*, upperarm_correctiveRoot_*, lowerarm_correctiveRoot_*, thigh_correctiveRoot_*, calf_correctiveRoot_*, wrist_inner_*, wrist_outer_*, upperarm_in_*, upperarm_out_*, upperarm_fwd_*, upperarm_bck_*, lowerarm_in_*, lowerarm_out_*, lowerarm_fwd_*, lowerarm_bck_*, thigh_in_*, thigh_out_*, thigh_fwd_*, thigh_bck_*, calf_kneeBack_*, calf_knee_*, ankle_fwd_*, ankle_bck_*, clavicle_out_*, clavicle_scap_*, clavicle_pec_*, spine_04_latissimus_*",
        ),
        (Control, "root, ik_foot_root, ik_foot_*, ik_hand_root, ik_hand_gun, ik_hand_*, interaction, center_of_mass"),
        (Prop, "weapon_*, camera, attach"),
        (Secondary, "breast_*"),
    ],
};
