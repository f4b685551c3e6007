//! HumanIK, the character definition of Maya and MotionBuilder; motion capture suits write the same names.
//!
//! Names: help.autodesk.com, Maya, the HumanIK skeleton's nodes.

use super::Profile;
use crate::rig::body_part::Finger::{Index, Little, Middle, Ring, Thumb};
use crate::rig::names::slot::Slot::{
    Clavicle, Control, Finger, Foot, Hand, Head, Hips, LowerArm, LowerLeg, Neck, Palm, Spine, Toes, Twist, UpperArm,
    UpperLeg,
};

pub const PROFILE: Profile = Profile {
    name: "HumanIK",
    prefixes: &["Character1"],
    rows: &[
        (Control, "Reference"),
        (Hips, "Hips"),
        (Spine, "Spine#"),
        (Neck, "Neck#"),
        (Head, "Head"),
        (Clavicle, "*Shoulder"),
        (UpperArm, "*Arm"),
        (LowerArm, "*ForeArm"),
        (Hand, "*Hand"),
        (UpperLeg, "*UpLeg"),
        (LowerLeg, "*Leg"),
        (Foot, "*Foot"),
        (Toes, "*ToeBase"),
        (Palm(Index), "*InHandIndex"),
        (Palm(Middle), "*InHandMiddle"),
        (Palm(Ring), "*InHandRing"),
        (Palm(Little), "*InHandPinky"),
        (Finger(Thumb), "*HandThumb1, *HandThumb2, *HandThumb3, *HandThumb4"),
        (Finger(Index), "*HandIndex1, *HandIndex2, *HandIndex3, *HandIndex4"),
        (Finger(Middle), "*HandMiddle1, *HandMiddle2, *HandMiddle3, *HandMiddle4"),
        (Finger(Ring), "*HandRing1, *HandRing2, *HandRing3, *HandRing4"),
        (Finger(Little), "*HandPinky1, *HandPinky2, *HandPinky3, *HandPinky4"),
        (
            Twist,
            "*ShoulderExtra, *ArmRoll#, *ForeArmRoll#, *UpLegRoll#, *LegRoll#, Leaf*ArmRoll#, Leaf*ForeArmRoll#, Leaf*UpLegRoll#, Leaf*LegRoll#, *FingerBase, *InFoot#, *FootThumb1, *FootThumb2, *FootThumb3, *FootThumb4, *FootIndex1, *FootIndex2, *FootIndex3, *FootIndex4, *FootMiddle1, *FootMiddle2, *FootMiddle3, *FootMiddle4, *FootRing1, *FootRing2, *FootRing3, *FootRing4, *FootPinky1, *FootPinky2, *FootPinky3, *FootPinky4",
        ),
    ],
};
