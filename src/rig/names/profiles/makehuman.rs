//! MakeHuman's and MPFB's default rig.
//!
//! Names: github.com/makehumancommunity/makehuman, `data/rigs/default.mhskel`, and mpfb2, `rig.default.json`. Its trunk counts from the neck
//! down, its root is at the hips, and most bones of a limb are two.

use super::Profile;
use crate::rig::body_part::Finger::{Index, Little, Middle, Ring, Thumb};
use crate::rig::names::slot::Slot::{
    Clavicle, Eye, Finger, Foot, Hand, Head, Hips, Jaw, LowerArm, LowerLeg, Neck, Palm, Secondary, Spine, Twist,
    UpperArm, UpperLeg,
};

pub const PROFILE: Profile = Profile {
    name: "MakeHuman",
    prefixes: &[],
    rows: &[
        (Hips, "root"),
        (Spine, "spine01, spine02, spine03, spine04, spine05"),
        (Neck, "neck01, neck02, neck03"),
        (Head, "head"),
        (Jaw, "jaw"),
        (Eye, "eye.*"),
        (Clavicle, "clavicle.*"),
        (UpperArm, "upperarm01.*"),
        (LowerArm, "lowerarm01.*"),
        (Hand, "wrist.*"),
        (UpperLeg, "upperleg01.*"),
        (LowerLeg, "lowerleg01.*"),
        (Foot, "foot.*"),
        (Palm(Index), "metacarpal1.*"),
        (Palm(Middle), "metacarpal2.*"),
        (Palm(Ring), "metacarpal3.*"),
        (Palm(Little), "metacarpal4.*"),
        (Finger(Thumb), "finger1-1.*, finger1-2.*, finger1-3.*"),
        (Finger(Index), "finger2-1.*, finger2-2.*, finger2-3.*"),
        (Finger(Middle), "finger3-1.*, finger3-2.*, finger3-3.*"),
        (Finger(Ring), "finger4-1.*, finger4-2.*, finger4-3.*"),
        (Finger(Little), "finger5-1.*, finger5-2.*, finger5-3.*"),
        (
            Twist,
            "pelvis.*, shoulder01.*, upperarm02.*, lowerarm02.*, upperleg02.*, lowerleg02.*, toe1-1.*, toe1-2.*, toe2-1.*, toe2-2.*, toe2-3.*, toe3-1.*, toe3-2.*, toe3-3.*, toe4-1.*, toe4-2.*, toe4-3.*, toe5-1.*, toe5-2.*, toe5-3.*",
        ),
        (
            Secondary,
            "breast.*, special01, special03, special04, special05.*, special06.*, levator02.*, levator03.*, levator04.*, levator05.*, levator06.*, orbicularis03.*, orbicularis04.*, oris01, oris02, oris03.*, oris04.*, oris05, oris06, oris06.*, oris07.*, risorius02.*, risorius03.*, temporalis01.*, temporalis02.*, tongue00, tongue01, tongue02, tongue03, tongue04, tongue05.*, tongue06.*, tongue07.*",
        ),
    ],
};
