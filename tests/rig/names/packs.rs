//! Packs of characters and samples.

use super::lists::List;

/// All of them, with their names.
pub const ALL: &[(&str, List)] = &[
    (
        "kaykit",
        List {
            profiles: &["KayKit"],
            sides: ["l", "r"],
            text: "
root=control
 hips=hips
  spine=spine > chest=spine
   head=head
   upperarm.*=arm > lowerarm.*=elbow > wrist.*=hand > hand.*=twist > handslot.*=prop
  upperleg.*=leg > lowerleg.*=knee > foot.*=foot > toes.*=toes
 kneeIK.*=control
 control-toe-roll.*=control > control-heel-roll.*=control > control-foot-roll.*=control
  heelIK.*=control > IK-foot.*=control
  IK-toe.*=control
 elbowIK.*=control
 handIK.*=control
",
        },
    ),
    (
        "quaternius women",
        List {
            profiles: &["Quaternius"],
            sides: ["L", "R"],
            text: "
Root=control
 Hips=hips > Abdomen=spine > Torso=spine > Chest=spine
  Neck=neck > Head=head
  Shoulder.*=collar > UpperArm.*=arm > LowerArm.*=elbow > Hand.*=hand
   Index1.*=index1 > Index2.*=index2 > Index3.*=index3
   Middle1.*=middle1 > Middle2.*=middle2 > Middle3.*=middle3
   Ring1.*=ring1 > Ring2.*=ring2 > Ring3.*=ring3
   Pinky1.*=little1 > Pinky2.*=little2 > Pinky3.*=little3
   Thumb1.*=thumb1 > Thumb2.*=thumb2 > Thumb3.*=thumb3
 UpperLeg.*=leg > LowerLeg.*=knee > Foot.*=foot
",
        },
    ),
    (
        "quaternius men",
        List {
            profiles: &["Quaternius"],
            sides: ["L", "R"],
            text: "
Root=control > Hips=hips
 Abdomen=spine > Torso=spine > Chest=spine
  Neck=neck > Head=head > Head_end=headtop
  Shoulder.*=collar > UpperArm.*=arm > LowerArm.*=elbow > Hand.*=hand
   Index2.*=index1 > Index3.*=index2 > Index4.*=index3
   Middle2.*=middle1 > Middle3.*=middle2 > Middle4.*=middle3
   Ring2.*=ring1 > Ring3.*=ring2 > Ring4.*=ring3
   Pinky2.*=little1 > Pinky3.*=little2 > Pinky4.*=little3
   Thumb2.*=thumb1 > Thumb3.*=thumb2
 UpperLeg.*=leg > LowerLeg.*=knee > Foot.*=foot > Foot.*_end=twist
",
        },
    ),
    (
        "quaternius animated",
        List {
            profiles: &["Quaternius"],
            sides: ["L", "R"],
            text: "
Bone=control
 Body=control
  Hips=hips > Abdomen=spine > Torso=spine
   Neck=neck > Head=head
   Shoulder.*=collar > UpperArm.*=arm > LowerArm.*=elbow > Palm.*=hand
    MiddleHand.*=twist > Fingers.*=twist
    Thumb1.*=thumb1 > Thumb2.*=thumb2
  UpperLeg.*=leg > LowerLeg.*=knee
 Foot.*=foot
 PoleTarget.*=control
",
        },
    ),
    (
        "rigged figure",
        List {
            profiles: &["Khronos samples"],
            sides: ["L", "R"],
            text: "
torso_joint_1=hips
 torso_joint_2=spine > torso_joint_3=spine
  neck_joint_1=neck > neck_joint_2=head
  arm_joint_*_1=arm > arm_joint_*_2=elbow > arm_joint_*_3=hand
 leg_joint_*_1=leg > leg_joint_*_2=knee > leg_joint_*_3=foot > leg_joint_*_5=toes
",
        },
    ),
    (
        "cesium man",
        List {
            profiles: &["Khronos samples"],
            sides: ["L", "R"],
            text: "
Skeleton_torso_joint_1=hips
 Skeleton_torso_joint_2=spine > torso_joint_3=spine
  Skeleton_neck_joint_1=neck > Skeleton_neck_joint_2=head
  Skeleton_arm_joint_*__4_=arm > Skeleton_arm_joint_*__3_=elbow > Skeleton_arm_joint_*__2_=hand
 leg_joint_*_1=leg > leg_joint_*_2=knee > leg_joint_*_3=foot > leg_joint_*_5=toes
",
        },
    ),
];
