//! SMPL, SMPL-H and SMPL-X, the statistical bodies.
//!
//! Names: github.com/vchoutas/smplx, `smplx/joint_names.py`. The foot is a joint at the ball, the hand one in the palm.

use super::Profile;
use crate::rig::body_part::Finger::{Index, Little, Middle, Ring, Thumb};
use crate::rig::names::slot::Slot::{
    Clavicle, Eye, Finger, Foot, Hand, Head, Hips, Jaw, LowerArm, LowerLeg, Neck, Spine, Toes, Twist, UpperArm,
    UpperLeg,
};

pub const PROFILE: Profile = Profile {
    name: "SMPL",
    prefixes: &["m_avg", "f_avg"],
    rows: &[
        (Hips, "pelvis"),
        (Spine, "spine1, spine2, spine3"),
        (Neck, "neck"),
        (Head, "head"),
        (Jaw, "jaw"),
        (Eye, "*_eye, *_eye_smplhf"),
        (Clavicle, "*_collar"),
        (UpperArm, "*_shoulder"),
        (LowerArm, "*_elbow"),
        (Hand, "*_wrist"),
        (UpperLeg, "*_hip"),
        (LowerLeg, "*_knee"),
        (Foot, "*_ankle"),
        (Toes, "*_foot"),
        (Finger(Thumb), "*_thumb1, *_thumb2, *_thumb3"),
        (Finger(Index), "*_index1, *_index2, *_index3"),
        (Finger(Middle), "*_middle1, *_middle2, *_middle3"),
        (Finger(Ring), "*_ring1, *_ring2, *_ring3"),
        (Finger(Little), "*_pinky1, *_pinky2, *_pinky3"),
        (Twist, "*_hand"),
    ],
};
