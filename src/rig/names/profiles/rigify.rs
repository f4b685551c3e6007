//! Blender's Rigify: the human meta-rig and the bones that are made of it.
//!
//! Names: the meta-rig `human` of the add-on, and docs.blender.org, Rigify. `DEF-` bones move the body, `ORG-` and `MCH-` move bones. The
//! numbers of the trunk do not say where it ends: spine.003 is the last below the neck where nobody has changed the meta-rig.

use super::Profile;
use crate::rig::body_part::Finger::{Index, Little, Middle, Ring, Thumb};
use crate::rig::names::slot::Slot::{
    Clavicle, Control, Finger, Foot, Hand, HeadTop, Hips, LowerArm, LowerLeg, Palm, Secondary, Toes, Trunk, Twist,
    UpperArm, UpperLeg,
};

pub const PROFILE: Profile = Profile {
    name: "Rigify",
    prefixes: &["DEF-"],
    rows: &[
        (Hips, "spine"),
        (Trunk, "spine.#"),
        (HeadTop, "head.end"),
        (Clavicle, "shoulder.*"),
        (UpperArm, "upper_arm.*"),
        (LowerArm, "forearm.*"),
        (Hand, "hand.*"),
        (UpperLeg, "thigh.*"),
        (LowerLeg, "shin.*"),
        (Foot, "foot.*"),
        (Toes, "toe.*"),
        (Palm(Index), "palm.01.*"),
        (Palm(Middle), "palm.02.*"),
        (Palm(Ring), "palm.03.*"),
        (Palm(Little), "palm.04.*"),
        (Finger(Thumb), "thumb.01.*, thumb.02.*, thumb.03.*"),
        (Finger(Index), "f_index.01.*, f_index.02.*, f_index.03.*"),
        (Finger(Middle), "f_middle.01.*, f_middle.02.*, f_middle.03.*"),
        (Finger(Ring), "f_ring.01.*, f_ring.02.*, f_ring.03.*"),
        (Finger(Little), "f_pinky.01.*, f_pinky.02.*, f_pinky.03.*"),
        (Twist, "pelvis.*, upper_arm.*.001, forearm.*.001, thigh.*.001, shin.*.001, heel.02.*, heel.*"),
        (Secondary, "breast.*, face, nose.#"),
        (Control, "root"),
    ],
};
