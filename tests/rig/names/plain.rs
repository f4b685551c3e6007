//! Rigs of no known tool, such as people build by hand: the vocabulary and the tree decide.

use super::Report;
use super::lists::List;

const ALL: &[(&str, List)] = &[
    (
        "joints of the body",
        List {
            profiles: &[],
            sides: ["l", "r"],
            text: "
root=control
 hip=hips
  spine=spine > chest=spine
   neck=neck > head=head
   shoulder_*=arm > elbow_*=elbow > wrist_*=hand
  hip_*=leg > knee_*=knee > ankle_*=foot
",
        },
    ),
    (
        "collar and shoulder",
        List {
            profiles: &[],
            sides: ["L", "R"],
            text: "
pelvis_jnt=hips
 back_jnt=spine > chest_jnt=spine
  neck_jnt=neck > head_jnt=head > head_end_jnt=headtop
  *_collar_jnt=collar > *_shoulder_jnt=arm > *_elbow_jnt=elbow > *_wrist_jnt=hand
   *_thumb1_jnt=thumb1 > *_thumb2_jnt=thumb2
   *_index1_jnt=index1 > *_index2_jnt=index2 > *_index3_jnt=index3
 *_thigh_jnt=leg > *_knee_jnt=knee > *_ankle_jnt=foot > *_toe_jnt=toes
",
        },
    ),
    (
        "shoulder and arm",
        List {
            profiles: &[],
            sides: ["Left", "Right"],
            text: "
Hips=hips
 Waist=spine > Torso=spine
  Neck=neck > Head=head
  Shoulder *=collar > Arm *=arm > Forearm *=elbow > Hand *=hand
 Thigh *=leg > Leg *=knee > Foot *=foot
",
        },
    ),
    (
        "low poly, numbered",
        List {
            profiles: &[],
            sides: ["L", "R"],
            text: "
Armature=control
 Pelvis=hips
  Spine=spine
   Head=head
   Arm1.*=arm > Arm2.*=elbow > Hand.*=hand
  Leg1.*=leg > Leg2.*=knee > Foot.*=foot
",
        },
    ),
    (
        "joined, with letters",
        List {
            profiles: &[],
            sides: ["l", "r"],
            text: "
root=control
 hips=hips
  spine=spine > chest=spine
   neck=neck > head=head
   *clavicle=collar > *upperarm=arm > *forearm=elbow > *hand=hand
  *thigh=leg > *shin=knee > *foot=foot > *toe=toes
",
        },
    ),
    (
        "joined, with words",
        List {
            profiles: &[],
            sides: ["left", "right"],
            text: "
hips=hips
 spine=spine
  head=head
  *shoulder=collar > *upperarm=arm > *lowerarm=elbow > *hand=hand
 *upperleg=leg > *lowerleg=knee > *foot=foot
",
        },
    ),
    (
        "side in front, twists, weapons, cloth",
        List {
            profiles: &[],
            sides: ["L", "R"],
            text: "
Root=control
 C_Pelvis=hips
  C_Spine01=spine > C_Spine02=spine
   C_Neck=neck > C_Head=head
    *_Eye=eye
    C_Jaw=jaw
    C_Hair01=secondary
    *_Ear=secondary
   *_Clavicle=collar > *_UpperArm=arm
    *_UpperArmTwist=twist
    *_Forearm=elbow
     *_ForearmRoll=twist
     *_Hand=hand > *_WeaponSocket=prop
   C_Cape01=secondary > C_Cape02=secondary
  C_Skirt_Front=secondary
  *_Thigh=leg > *_Calf=knee > *_Foot=foot > *_Toe=toes
 *_Foot_IK=control
 *_Knee_Pole=control
",
        },
    ),
    (
        "anatomy",
        List {
            profiles: &[],
            sides: ["left", "right"],
            text: "
pelvis=hips
 lumbar_spine=spine > thorax=spine
  neck=neck > skull=head
  *_scapula=collar > *_humerus=arm > *_forearm=elbow > *_hand=hand
 *_femur=leg > *_tibia=knee > *_foot=foot
",
        },
    ),
    (
        "German",
        List {
            profiles: &[],
            sides: ["links", "rechts"],
            text: "
Becken=hips
 Wirbelsäule=spine > Brust=spine
  Hals=neck > Kopf=head
  Schulter_*=collar > Oberarm_*=arm > Unterarm_*=elbow > Hand_*=hand
   Daumen1_*=thumb1 > Daumen2_*=thumb2
   Zeigefinger1_*=index1 > Zeigefinger2_*=index2
 Oberschenkel_*=leg > Unterschenkel_*=knee > Fuß_*=foot
",
        },
    ),
    (
        "second arm beside",
        List {
            profiles: &[],
            sides: ["L", "R"],
            text: "
root=control
 hips=hips
  spine=spine > chest=spine
   neck=neck > head=head
   shoulder_*=collar > arm_upper_*=arm > arm_lower_*=elbow > hand_*=hand
    item_*=prop
  leg_upper_*=leg > leg_lower_*=knee > foot_*=foot > toes_*=toes
 hand_ctrl_*=control
 foot_target_*=control
",
        },
    ),
    (
        "mgear",
        List {
            profiles: &[],
            sides: ["L", "R"],
            text: "
spine_C0_pelvis_jnt=hips
 spine_C0_01_jnt=spine > spine_C0_02_jnt=spine
  neck_C0_0_jnt=neck > neck_C0_head_jnt=head
  shoulder_*0_shoulder_jnt=collar > upperarm_*0_0_jnt=arm > forearm_*0_0_jnt=elbow > hand_*0_jnt=hand
 thigh_*0_jnt=leg > calf_*0_jnt=knee > foot_*0_jnt=foot
",
        },
    ),
    (
        "no hips",
        List {
            profiles: &[],
            sides: ["L", "R"],
            text: "
spine1=hips
 spine2=spine > spine3=spine
  neck=neck > head=head
  clavicle_*=collar > upper_arm_*=arm > fore_arm_*=elbow > hand_*=hand
 upper_leg_*=leg > lower_leg_*=knee > foot_*=foot
",
        },
    ),
];

#[test]
fn rigs_of_no_table() {
    let mut report = Report::default();
    for (name, list) in ALL {
        let joints = list.joints();
        let naming = report.right(name, &joints);
        let others = joints.iter().zip(&naming.joints).filter(|(joint, named)| joint.named != **named);
        report.lines.extend(others.map(|(joint, named)| format!("{name}: {} is {named:?}", joint.name)));
    }
    report.end();
}
