//! The Biped of 3ds Max and of Character Studio.
//!
//! Names: help.autodesk.com, 3ds Max, Biped: `Bip001` or `Bip01`, then a side, then the part. The root, which has the name alone, is where the
//! body's mass is; fingers count from the thumb, which is 0, and end in a nub.

use super::Profile;
use crate::rig::body_part::Finger::{Index, Little, Middle, Ring, Thumb};
use crate::rig::names::slot::Slot::{
    Clavicle, Control, Finger, Foot, Hand, Head, HeadTop, Hips, LowerArm, LowerLeg, Neck, Prop, Secondary, Spine,
    ToeTip, Toes, Twist, UpperArm, UpperLeg,
};

pub const PROFILE: Profile = Profile {
    name: "3ds Max Biped",
    prefixes: &["Bip001", "Bip01"],
    rows: &[
        (Control, "Bip001, Bip01, Bip01 Footsteps, Bip001 Footsteps, Footsteps"),
        (Hips, "Pelvis"),
        (Spine, "Spine#"),
        (Neck, "Neck#"),
        (Head, "Head"),
        (HeadTop, "HeadNub"),
        (Clavicle, "* Clavicle"),
        (UpperArm, "* UpperArm"),
        (LowerArm, "* Forearm"),
        (Hand, "* Hand"),
        (UpperLeg, "* Thigh"),
        (LowerLeg, "* Calf"),
        (Foot, "* Foot"),
        (Toes, "* Toe0"),
        (ToeTip, "* Toe0Nub"),
        (Finger(Thumb), "* Finger0, * Finger01, * Finger02, * Finger0Nub"),
        (Finger(Index), "* Finger1, * Finger11, * Finger12, * Finger1Nub"),
        (Finger(Middle), "* Finger2, * Finger21, * Finger22, * Finger2Nub"),
        (Finger(Ring), "* Finger3, * Finger31, * Finger32, * Finger3Nub"),
        (Finger(Little), "* Finger4, * Finger41, * Finger42, * Finger4Nub"),
        (
            Twist,
            "* ForeTwist#, * UpArmTwist, * UpArmTwist#, * ThighTwist#, * CalfTwist#, * LUpArmTwist, * Toe01, * Toe02, * Toe1, * Toe11, * Toe12, * Toe2, * Toe21, * Toe22",
        ),
        (Secondary, "Ponytail1, Ponytail1Nub, Ponytail11, Ponytail12, Ponytail2, Tail, TailNub"),
        (Prop, "Prop1, Prop2, Prop3"),
    ],
};
