//! Rigs for Blender that have plain names with a side at the end: the older meta-rigs, and what people name after them.
//!
//! Names: the meta-rigs of Rigify before 2016 (`pitchipoy` apart), Blender's manual on naming bones, and VRM's add-on for Blender.

use super::Profile;
use crate::rig::body_part::Finger::{Index, Little, Middle, Ring, Thumb};
use crate::rig::names::slot::Slot::{
    Clavicle, Control, Eye, Finger, Foot, Hand, Head, Hips, Jaw, LowerArm, LowerLeg, Neck, Palm, Spine, Toes, Twist,
    UpperArm, UpperLeg,
};

pub const PROFILE: Profile = Profile {
    name: "Blender",
    prefixes: &["DEF-"],
    rows: &[
        (Hips, "hips"),
        (Spine, "spine#, chest#, upper_chest"),
        (Neck, "neck#"),
        (Head, "head"),
        (Jaw, "jaw"),
        (Eye, "eye.*"),
        (Clavicle, "shoulder.*"),
        (UpperArm, "upper_arm.*"),
        (LowerArm, "forearm.*, lower_arm.*"),
        (Hand, "hand.*"),
        (UpperLeg, "thigh.*, upper_leg.*"),
        (LowerLeg, "shin.*, lower_leg.*"),
        (Foot, "foot.*"),
        (Toes, "toe.*, toes.*"),
        (Palm(Index), "palm.01.*"),
        (Palm(Middle), "palm.02.*"),
        (Palm(Ring), "palm.03.*"),
        (Palm(Little), "palm.04.*"),
        (Finger(Thumb), "thumb.01.*, thumb.02.*, thumb.03.*"),
        (Finger(Index), "f_index.01.*, f_index.02.*, f_index.03.*"),
        (Finger(Middle), "f_middle.01.*, f_middle.02.*, f_middle.03.*"),
        (Finger(Ring), "f_ring.01.*, f_ring.02.*, f_ring.03.*"),
        (Finger(Little), "f_pinky.01.*, f_pinky.02.*, f_pinky.03.*"),
        (Finger(Index), "finger_index.01.*, finger_index.02.*, finger_index.03.*"),
        (Finger(Middle), "finger_middle.01.*, finger_middle.02.*, finger_middle.03.*"),
        (Finger(Ring), "finger_ring.01.*, finger_ring.02.*, finger_ring.03.*"),
        (Finger(Little), "finger_pinky.01.*, finger_pinky.02.*, finger_pinky.03.*"),
        (Twist, "heel.02.*, heel.*, pelvis.*"),
        (Control, "root"),
    ],
};
