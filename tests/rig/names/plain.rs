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
        "French",
        List {
            profiles: &[],
            sides: ["gauche", "droite"],
            text: "
bassin=hips
 colonne=spine > poitrine=spine
  cou=neck > tête=head
  clavicule_*=collar > bras_*=arm > avant_bras_*=elbow > main_*=hand
   pouce1_*=thumb1 > pouce2_*=thumb2
   majeur1_*=middle1 > majeur2_*=middle2
 cuisse_*=leg > jambe_*=knee > pied_*=foot > orteils_*=toes
",
        },
    ),
    (
        "Spanish",
        List {
            profiles: &[],
            sides: ["izquierda", "derecha"],
            text: "
cadera=hips
 columna=spine > pecho=spine
  cuello=neck > cabeza=head
  clavícula_*=collar > brazo_*=arm > antebrazo_*=elbow > mano_*=hand
   pulgar1_*=thumb1 > pulgar2_*=thumb2
 muslo_*=leg > pantorrilla_*=knee > pie_*=foot
",
        },
    ),
    (
        "Italian",
        List {
            profiles: &[],
            sides: ["sinistra", "destra"],
            text: "
bacino=hips
 colonna=spine > petto=spine
  collo=neck > testa=head
  spalla_*=collar > braccio_*=arm > avambraccio_*=elbow > mano_*=hand
 coscia_*=leg > ginocchio_*=knee > piede_*=foot
",
        },
    ),
    (
        "Portuguese",
        List {
            profiles: &[],
            sides: ["esquerda", "direita"],
            text: "
quadril=hips
 coluna=spine > peito=spine
  pescoço=neck > cabeça=head
  clavícula_*=collar > braço_*=arm > antebraço_*=elbow > mão_*=hand
 coxa_*=leg > joelho_*=knee > pé_*=foot
",
        },
    ),
    (
        "Russian",
        List {
            profiles: &[],
            sides: ["левая", "правая"],
            text: "
таз=hips
 позвоночник=spine > грудь=spine
  шея=neck > голова=head
  ключица_*=collar > плечо_*=arm > предплечье_*=elbow > кисть_*=hand
 бедро_*=leg > голень_*=knee > стопа_*=foot
",
        },
    ),
    (
        "Chinese",
        List {
            profiles: &[],
            sides: ["左", "右"],
            text: "
骨盆=hips
 脊柱=spine > 脊椎=spine
  颈=neck > 头=head
  锁骨_*=collar > 上臂_*=arm > 前臂_*=elbow > 手_*=hand
 大腿_*=leg > 小腿_*=knee > 脚_*=foot
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
    (
        "limbs in groups",
        List {
            profiles: &[],
            sides: ["L", "R"],
            text: "
C_root_jnt=control
 C_spine_pelvis_jnt=hips
  C_spine_01_jnt=spine > C_spine_02_jnt=spine > C_spine_chest_jnt=spine
   C_neck_jnt=neck > C_neck_head_jnt=head
   *_arm_clavicle_jnt=collar > *_arm_shoulder_jnt=arm > *_arm_elbow_jnt=elbow > *_arm_wrist_jnt=hand
  *_leg_hip_jnt=leg > *_leg_knee_jnt=knee > *_leg_ankle_jnt=foot > *_leg_ball_jnt=toes
",
        },
    ),
    (
        "apple body tracking",
        List {
            profiles: &[],
            sides: ["left", "right"],
            text: "
root=control
 hips_joint=hips
  *_upLeg_joint=leg > *_leg_joint=knee > *_foot_joint=foot > *_toes_joint=toes > *_toesEnd_joint=toetip
  spine_1_joint=spine > spine_2_joint=spine > spine_3_joint=spine > spine_4_joint=spine > spine_5_joint=spine > spine_6_joint=spine > spine_7_joint=spine
   neck_1_joint=neck > neck_2_joint=neck > neck_3_joint=neck > neck_4_joint=neck > head_joint=head
    jaw_joint=jaw > chin_joint=secondary
    *_eye_joint=eye > *_eyeLowerLid_joint=secondary
    nose_joint=secondary
   *_shoulder_1_joint=collar > *_arm_joint=arm > *_forearm_joint=elbow > *_hand_joint=hand
    *_handThumbStart_joint=thumb1 > *_handThumb_1_joint=thumb2 > *_handThumb_2_joint=thumb3 > *_handThumbEnd_joint=thumb4
    *_handIndexStart_joint=index0 > *_handIndex_1_joint=index1 > *_handIndex_2_joint=index2 > *_handIndex_3_joint=index3 > *_handIndexEnd_joint=index4
    *_handMidStart_joint=middle0 > *_handMid_1_joint=middle1 > *_handMid_2_joint=middle2 > *_handMid_3_joint=middle3 > *_handMidEnd_joint=middle4
    *_handRingStart_joint=ring0 > *_handRing_1_joint=ring1 > *_handRing_2_joint=ring2 > *_handRing_3_joint=ring3 > *_handRingEnd_joint=ring4
    *_handPinkyStart_joint=little0 > *_handPinky_1_joint=little1 > *_handPinky_2_joint=little2 > *_handPinky_3_joint=little3 > *_handPinkyEnd_joint=little4
",
        },
    ),
    (
        "kinect",
        List {
            profiles: &[],
            sides: ["LEFT", "RIGHT"],
            text: "
PELVIS=hips
 SPINE_NAVEL=spine > SPINE_CHEST=spine
  NECK=neck > HEAD=head
   EYE_*=eye
   NOSE=secondary
  CLAVICLE_*=collar > SHOULDER_*=arm > ELBOW_*=elbow > WRIST_*=hand > HAND_*=twist > HANDTIP_*=twist
 HIP_*=leg > KNEE_*=knee > ANKLE_*=foot > FOOT_*=toes
",
        },
    ),
    (
        "synty",
        List {
            profiles: &[],
            sides: ["L", "R"],
            text: "
Root=control
 Hips=hips
  Spine_01=spine > Spine_02=spine > Spine_03=spine
   Neck=neck > Head=head
    Eyebrows=secondary
   Clavicle_*=collar > Shoulder_*=arm > Elbow_*=elbow > Hand_*=hand
    Thumb_01*=thumb1 > Thumb_02*=thumb2 > Thumb_03*=thumb3
    IndexFinger_01*=index1 > IndexFinger_02*=index2 > IndexFinger_03*=index3
  UpperLeg_*=leg > LowerLeg_*=knee > Ankle_*=foot > Ball_*=toes
",
        },
    ),
    (
        "mikumikudance in english",
        List {
            profiles: &[],
            sides: ["L", "R"],
            text: "
RootNode=control > Center=control
 LowerBody=hips
  Leg_*=leg > Knee_*=knee > Ankle_*=foot
 UpperBody=spine > UpperBody2=spine
  Neck=neck > Head=head
   Eye_*=eye
  Shoulder_*=collar > Arm_*=arm
   ArmTwist_*=twist
   Elbow_*=elbow > Wrist_*=hand
    Thumb1_*=thumb2 > Thumb2_*=thumb3
LegIK_*=control
",
        },
    ),
    (
        "rigify with names",
        List {
            profiles: &[],
            sides: ["L", "R"],
            text: "
root=control
 DEF-hips=hips
  DEF-spine.001=spine > DEF-spine.002=spine > DEF-spine.003=spine
   DEF-neck=neck > DEF-head=head
   DEF-shoulder.*=collar > DEF-upper_arm.*=arm > DEF-forearm.*=elbow > DEF-hand.*=hand
    DEF-thumb.01.*=thumb1 > DEF-thumb.02.*=thumb2 > DEF-thumb.03.*=thumb3
    DEF-f_index.01.*=index1 > DEF-f_index.02.*=index2 > DEF-f_index.03.*=index3
  DEF-thigh.*=leg > DEF-shin.*=knee > DEF-foot.*=foot > DEF-toe.*=toes
",
        },
    ),
    (
        "robot",
        List {
            profiles: &[],
            sides: ["L", "R"],
            text: "
Bone=control
 Foot*=foot
 Body=control
  Hips=hips > Abdomen=spine > Torso=spine
   Neck=neck > Head=head > Head_end=headtop
   Shoulder*=collar > UpperArm*=arm > LowerArm*=elbow > Palm1*=hand
    Thumb1*=thumb1 > Thumb2*=thumb2
  UpperLeg*=leg > LowerLeg*=knee
 PoleTarget*=control
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
