//! Auto-Rig Pro for Blender, as it exports without renaming.
//!
//! Names: lucky3d.fr, Auto-Rig Pro's documentation of its export and of the bones that move the body.

use super::Profile;
use crate::rig::body_part::Finger::{Index, Little, Middle, Ring, Thumb};
use crate::rig::names::slot::Slot::{
    Clavicle, Control, Eye, Finger, Foot, Hand, Head, Hips, Jaw, LowerArm, LowerLeg, Neck, Palm, Secondary, Spine,
    Toes, Twist, UpperArm, UpperLeg,
};

pub const PROFILE: Profile = Profile {
    name: "Auto-Rig Pro",
    prefixes: &[],
    rows: &[
        (Control, "root, c_traj, c_pos"),
        (Hips, "root.x"),
        (Spine, "spine_#.x"),
        (Neck, "neck.x, subneck_#.x"),
        (Head, "head.x"),
        (Jaw, "jawbone.x, c_jawbone.x"),
        (Eye, "c_eye.*"),
        (Clavicle, "shoulder.*"),
        (UpperArm, "arm_stretch.*, arm.*"),
        (LowerArm, "forearm_stretch.*, forearm.*"),
        (Hand, "hand.*"),
        (UpperLeg, "thigh_stretch.*, thigh.*"),
        (LowerLeg, "leg_stretch.*, leg.*"),
        (Foot, "foot.*"),
        (Toes, "toes_01.*, toes.*"),
        (Palm(Index), "c_index1_base.*, index1_base.*"),
        (Palm(Middle), "c_middle1_base.*, middle1_base.*"),
        (Palm(Ring), "c_ring1_base.*, ring1_base.*"),
        (Palm(Little), "c_pinky1_base.*, pinky1_base.*"),
        (Finger(Thumb), "c_thumb1.*, c_thumb2.*, c_thumb3.*"),
        (Finger(Index), "c_index1.*, c_index2.*, c_index3.*"),
        (Finger(Middle), "c_middle1.*, c_middle2.*, c_middle3.*"),
        (Finger(Ring), "c_ring1.*, c_ring2.*, c_ring3.*"),
        (Finger(Little), "c_pinky1.*, c_pinky2.*, c_pinky3.*"),
        (Finger(Thumb), "thumb1.*, thumb2.*, thumb3.*"),
        (Finger(Index), "index1.*, index2.*, index3.*"),
        (Finger(Middle), "middle1.*, middle2.*, middle3.*"),
        (Finger(Ring), "ring1.*, ring2.*, ring3.*"),
        (Finger(Little), "pinky1.*, pinky2.*, pinky3.*"),
        (Twist, "arm_twist.*, forearm_twist.*, thigh_twist.*, leg_twist.*, c_arm_twist_offset.*"),
        (Secondary, "breast_#.*, c_breast_#.*, c_skull_#.x"),
    ],
};
