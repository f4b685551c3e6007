//! Quaternius' character packs, other than those with Mixamo's names.
//!
//! Names: the nodes of its modular men and women and of its animated characters. Feet may hang on the root, moved by controls; hips, upper
//! legs and trunk may hang side by side. The first bone of a finger may be 1 or 2.

use super::Profile;
use crate::rig::body_part::Finger::{Index, Little, Middle, Ring, Thumb};
use crate::rig::names::slot::Slot::{
    Clavicle, Control, Finger, Foot, Hand, Head, HeadTop, Hips, LowerArm, LowerLeg, Neck, Spine, Twist, UpperArm,
    UpperLeg,
};

pub const PROFILE: Profile = Profile {
    name: "Quaternius",
    prefixes: &[],
    rows: &[
        (Control, "Root, Bone, Body, PoleTarget.*"),
        (Hips, "Hips"),
        (Spine, "Abdomen, Torso, Chest"),
        (Neck, "Neck"),
        (Head, "Head"),
        (HeadTop, "Head_end"),
        (Clavicle, "Shoulder.*"),
        (UpperArm, "UpperArm.*"),
        (LowerArm, "LowerArm.*"),
        (Hand, "Hand.*, Palm.*"),
        (UpperLeg, "UpperLeg.*"),
        (LowerLeg, "LowerLeg.*"),
        (Foot, "Foot.*"),
        (Finger(Thumb), "Thumb#.*"),
        (Finger(Index), "Index#.*"),
        (Finger(Middle), "Middle#.*"),
        (Finger(Ring), "Ring#.*"),
        (Finger(Little), "Pinky#.*"),
        (Twist, "MiddleHand.*, Fingers.*, Foot.*_end"),
    ],
};
