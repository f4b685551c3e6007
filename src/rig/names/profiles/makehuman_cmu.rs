//! The skeleton of the motions that Carnegie Mellon University published, which MakeHuman's and MPFB's rig `cmu_mb` has.
//!
//! Names: mocap.cs.cmu.edu as MotionBuilder files, and MPFB's `rig.cmu_mb.json`.

use super::Profile;
use crate::rig::body_part::Finger::{Index, Thumb};
use crate::rig::names::slot::Slot::{
    Clavicle, Finger, Foot, Hand, Head, Hips, LowerArm, LowerLeg, Neck, Spine, Toes, Twist, UpperArm, UpperLeg,
};

pub const PROFILE: Profile = Profile {
    name: "CMU",
    prefixes: &[],
    rows: &[
        (Hips, "Hips"),
        (Spine, "LowerBack, Spine, Spine1"),
        (Neck, "Neck, Neck1"),
        (Head, "Head"),
        (Clavicle, "*Shoulder"),
        (UpperArm, "*Arm"),
        (LowerArm, "*ForeArm"),
        (Hand, "*Hand"),
        (UpperLeg, "*UpLeg"),
        (LowerLeg, "*Leg"),
        (Foot, "*Foot"),
        (Toes, "*ToeBase"),
        (Finger(Thumb), "*Thumb"),
        (Finger(Index), "*HandIndex1"),
        (Twist, "*HipJoint, *FingerBase"),
    ],
};
