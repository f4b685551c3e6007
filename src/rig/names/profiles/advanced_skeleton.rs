//! AdvancedSkeleton for Maya.
//!
//! Names: animationstudios.com.au, the joints of its `biped` fit skeleton.

use super::Profile;
use crate::rig::body_part::Finger::{Index, Little, Middle, Ring, Thumb};
use crate::rig::names::slot::Slot::{
    Clavicle, Eye, Finger, Foot, Hand, Head, HeadTop, Hips, Jaw, LowerArm, LowerLeg, Neck, Palm, Secondary, Spine,
    ToeTip, Toes, Twist, UpperArm, UpperLeg,
};

pub const PROFILE: Profile = Profile {
    name: "AdvancedSkeleton",
    prefixes: &[],
    rows: &[
        (Hips, "Root_M"),
        (Spine, "RootPart#_M, Spine#_M, Spine#Part#_M, Chest_M"),
        (Neck, "Neck_M, NeckPart#_M"),
        (Head, "Head_M"),
        (HeadTop, "HeadEnd_M"),
        (Jaw, "Jaw_M"),
        (Eye, "Eye_*"),
        (Clavicle, "Scapula_*"),
        (UpperArm, "Shoulder_*"),
        (LowerArm, "Elbow_*"),
        (Hand, "Wrist_*"),
        (UpperLeg, "Hip_*"),
        (LowerLeg, "Knee_*"),
        (Foot, "Ankle_*"),
        (Toes, "Toes_*"),
        (ToeTip, "ToesEnd_*"),
        (Finger(Thumb), "ThumbFinger1_*, ThumbFinger2_*, ThumbFinger3_*, ThumbFinger4_*"),
        (Finger(Index), "IndexFinger1_*, IndexFinger2_*, IndexFinger3_*, IndexFinger4_*"),
        (Finger(Middle), "MiddleFinger1_*, MiddleFinger2_*, MiddleFinger3_*, MiddleFinger4_*"),
        (Finger(Ring), "RingFinger1_*, RingFinger2_*, RingFinger3_*, RingFinger4_*"),
        (Finger(Little), "PinkyFinger1_*, PinkyFinger2_*, PinkyFinger3_*, PinkyFinger4_*"),
        (Palm(Little), "Cup_*"),
        (Twist, "ShoulderPart#_*, ElbowPart#_*, HipPart#_*, KneePart#_*"),
        (Secondary, "JawEnd_M, EyeEnd_*"),
    ],
};
