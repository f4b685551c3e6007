//! Valve's Source engine.
//!
//! Names: developer.valvesoftware.com, the bones of `ValveBiped`. Fingers count from the thumb, which is 0.

use super::Profile;
use crate::rig::body_part::Finger::{Index, Little, Middle, Ring, Thumb};
use crate::rig::names::slot::Slot::{
    Clavicle, Finger, Foot, Hand, Head, Hips, LowerArm, LowerLeg, Neck, Prop, Spine, Toes, Twist, UpperArm, UpperLeg,
};

pub const PROFILE: Profile = Profile {
    name: "Source engine ValveBiped",
    prefixes: &["ValveBiped.Bip01", "ValveBiped", "ValveBipedBip01", "Bip01"],
    rows: &[
        (Hips, "Pelvis"),
        (Spine, "Spine, Spine1, Spine2, Spine3, Spine4"),
        (Neck, "Neck1"),
        (Head, "Head1"),
        (Clavicle, "*_Clavicle"),
        (UpperArm, "*_UpperArm"),
        (LowerArm, "*_Forearm"),
        (Hand, "*_Hand"),
        (UpperLeg, "*_Thigh"),
        (LowerLeg, "*_Calf"),
        (Foot, "*_Foot"),
        (Toes, "*_Toe0"),
        (Finger(Thumb), "*_Finger0, *_Finger01, *_Finger02"),
        (Finger(Index), "*_Finger1, *_Finger11, *_Finger12"),
        (Finger(Middle), "*_Finger2, *_Finger21, *_Finger22"),
        (Finger(Ring), "*_Finger3, *_Finger31, *_Finger32"),
        (Finger(Little), "*_Finger4, *_Finger41, *_Finger42"),
        (
            Twist,
            "*_Ulna, *_Bicep, *_Wrist, *_Elbow, *_Shoulder, *_Trapezius, *_Latt, *_Pectoral, *_Quadricep, *_Gluteus, *_Groin",
        ),
        (Prop, "Anim_Attachment_*H, forward, weapon_bone"),
    ],
};
