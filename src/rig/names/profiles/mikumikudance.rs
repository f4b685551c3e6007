//! MikuMikuDance's models, with the Japanese names of the standard skeleton.
//!
//! Names: the bones of the models that come with MikuMikuDance and of the common additions to them. Upper and lower body both hang on the
//! centre; the joints with D move what those without them turn.

use super::Profile;
use crate::rig::body_part::Finger::{Index, Little, Middle, Ring, Thumb};
use crate::rig::names::slot::Slot::{
    Clavicle, Control, Eye, Finger, Foot, Hand, Head, HeadTop, Hips, LowerArm, LowerLeg, Neck, Spine, Toes, Twist,
    UpperArm, UpperLeg,
};

pub const PROFILE: Profile = Profile {
    name: "MikuMikuDance",
    prefixes: &[],
    rows: &[
        (
            Control,
            "操作中心, 全ての親, センター, グルーブ, 腰, ダミー*, 両目, *足ＩＫ, *つま先ＩＫ, *足IK親, *肩P, *肩C",
        ),
        (Hips, "下半身"),
        (Spine, "上半身#"),
        (Neck, "首"),
        (Head, "頭"),
        (HeadTop, "頭先"),
        (Eye, "*目"),
        (Clavicle, "*肩"),
        (UpperArm, "*腕"),
        (LowerArm, "*ひじ"),
        (Hand, "*手首"),
        (UpperLeg, "*足"),
        (LowerLeg, "*ひざ"),
        (Foot, "*足首"),
        (Toes, "*つま先, *足先EX"),
        (Finger(Thumb), "*親指０, *親指１, *親指２, *親指先"),
        (Finger(Index), "*人指１, *人指２, *人指３, *人指先"),
        (Finger(Middle), "*中指１, *中指２, *中指３, *中指先"),
        (Finger(Ring), "*薬指１, *薬指２, *薬指３, *薬指先"),
        (Finger(Little), "*小指１, *小指２, *小指３, *小指先"),
        (Twist, "*腕捩#, *手捩#, *足D, *ひざD, *足首D, *手先, 腰キャンセル*"),
    ],
};
