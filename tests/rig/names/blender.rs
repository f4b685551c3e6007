//! Blender and what makes rigs for it.

use super::lists::List;

/// All of them, with their names.
pub const ALL: &[(&str, List)] = &[
    (
        "blender meta rig",
        List {
            profiles: &["Rigify"],
            sides: ["L", "R"],
            text: "
spine=hips
 spine.001=spine > spine.002=spine > spine.003=spine
  spine.004=neck > spine.005=neck > spine.006=head
  shoulder.*=collar > upper_arm.*=arm
   forearm.*=elbow
    hand.*=hand
     thumb.01.*=thumb1 > thumb.02.*=thumb2 > thumb.03.*=thumb3
     palm.01.*=index0 > f_index.01.*=index1 > f_index.02.*=index2 > f_index.03.*=index3
     palm.02.*=middle0 > f_middle.01.*=middle1 > f_middle.02.*=middle2 > f_middle.03.*=middle3
     palm.03.*=ring0 > f_ring.01.*=ring1 > f_ring.02.*=ring2 > f_ring.03.*=ring3
     palm.04.*=little0 > f_pinky.01.*=little1 > f_pinky.02.*=little2 > f_pinky.03.*=little3
  breast.*=secondary
 pelvis.*=twist
 thigh.*=leg > shin.*=knee > foot.*=foot
  toe.*=toes
  heel.02.*=twist
",
        },
    ),
    (
        "rigify deform",
        List {
            profiles: &["Rigify"],
            sides: ["L", "R"],
            text: "
DEF-spine=hips
 DEF-spine.001=spine > DEF-spine.002=spine > DEF-spine.003=spine
  DEF-spine.004=neck > DEF-spine.005=neck > DEF-spine.006=head
  DEF-shoulder.*=collar > DEF-upper_arm.*=arm > DEF-upper_arm.*.001=twist
   DEF-forearm.*=elbow > DEF-forearm.*.001=twist
    DEF-hand.*=hand
     DEF-thumb.01.*=thumb1 > DEF-thumb.02.*=thumb2 > DEF-thumb.03.*=thumb3
     DEF-palm.01.*=index0 > DEF-f_index.01.*=index1 > DEF-f_index.02.*=index2 > DEF-f_index.03.*=index3
     DEF-palm.02.*=middle0 > DEF-f_middle.01.*=middle1 > DEF-f_middle.02.*=middle2 > DEF-f_middle.03.*=middle3
     DEF-palm.03.*=ring0 > DEF-f_ring.01.*=ring1 > DEF-f_ring.02.*=ring2 > DEF-f_ring.03.*=ring3
     DEF-palm.04.*=little0 > DEF-f_pinky.01.*=little1 > DEF-f_pinky.02.*=little2 > DEF-f_pinky.03.*=little3
  DEF-breast.*=secondary
 DEF-pelvis.*=twist
 DEF-thigh.*=leg > DEF-thigh.*.001=twist > DEF-shin.*=knee > DEF-shin.*.001=twist > DEF-foot.*=foot
  DEF-toe.*=toes
",
        },
    ),
    (
        "rigify whole",
        List {
            profiles: &["Rigify"],
            sides: ["L", "R"],
            text: "
root=control
 MCH-torso.parent=control > torso=control
  spine_fk=control > spine_fk.001=control
  tweak_spine.003=control
  ORG-spine=control > ORG-spine.001=control
  thigh_ik.*=control > foot_ik.*=control
  upper_arm_fk.*=control > forearm_fk.*=control > hand_fk.*=control
  ORG-upper_arm.*=control > ORG-forearm.*=control > ORG-hand.*=control
  upper_arm_ik_target.*=control
 DEF-spine=hips
  DEF-spine.001=spine > DEF-spine.002=spine > DEF-spine.003=spine
   DEF-spine.004=neck > DEF-spine.005=neck > DEF-spine.006=head
   DEF-shoulder.*=collar > DEF-upper_arm.*=arm > DEF-upper_arm.*.001=twist
    DEF-forearm.*=elbow > DEF-forearm.*.001=twist
     DEF-hand.*=hand
      DEF-thumb.01.*=thumb1 > DEF-thumb.02.*=thumb2 > DEF-thumb.03.*=thumb3
      DEF-palm.01.*=index0 > DEF-f_index.01.*=index1 > DEF-f_index.02.*=index2 > DEF-f_index.03.*=index3
      DEF-palm.02.*=middle0 > DEF-f_middle.01.*=middle1 > DEF-f_middle.02.*=middle2 > DEF-f_middle.03.*=middle3
      DEF-palm.03.*=ring0 > DEF-f_ring.01.*=ring1 > DEF-f_ring.02.*=ring2 > DEF-f_ring.03.*=ring3
      DEF-palm.04.*=little0 > DEF-f_pinky.01.*=little1 > DEF-f_pinky.02.*=little2 > DEF-f_pinky.03.*=little3
   DEF-breast.*=secondary
  DEF-pelvis.*=twist
  DEF-thigh.*=leg > DEF-thigh.*.001=twist > DEF-shin.*=knee > DEF-shin.*.001=twist > DEF-foot.*=foot
   DEF-toe.*=toes
",
        },
    ),
    (
        "blender plain",
        List {
            profiles: &["Blender"],
            sides: ["L", "R"],
            text: "
root=control
 hips=hips
  spine=spine > chest=spine
   neck=neck > head=head
    jaw=jaw
    eye.*=eye
   shoulder.*=collar > upper_arm.*=arm > forearm.*=elbow > hand.*=hand
    thumb.01.*=thumb1 > thumb.02.*=thumb2 > thumb.03.*=thumb3
    f_index.01.*=index1 > f_index.02.*=index2 > f_index.03.*=index3
    f_middle.01.*=middle1 > f_middle.02.*=middle2 > f_middle.03.*=middle3
    f_ring.01.*=ring1 > f_ring.02.*=ring2 > f_ring.03.*=ring3
    f_pinky.01.*=little1 > f_pinky.02.*=little2 > f_pinky.03.*=little3
  thigh.*=leg > shin.*=knee > foot.*=foot > toe.*=toes
",
        },
    ),
    (
        "blender vrm addon",
        List {
            profiles: &["Blender", "Godot SkeletonProfileHumanoid"],
            sides: ["L", "R"],
            text: "
root=control
 hips=hips
  spine=spine > chest=spine
   neck=neck > head=head
    eye.*=eye
   shoulder.*=collar > upper_arm.*=arm > lower_arm.*=elbow > hand.*=hand
  upper_leg.*=leg > lower_leg.*=knee > foot.*=foot > toes.*=toes
",
        },
    ),
    (
        "makehuman",
        List {
            profiles: &["MakeHuman"],
            sides: ["L", "R"],
            text: "
root=hips
 spine05=spine > spine04=spine > spine03=spine > spine02=spine
  breast.*=secondary
  spine01=spine
   neck01=neck > neck02=neck > neck03=neck > head=head
    jaw=jaw > special04=secondary
    special01=secondary
    special05.*=secondary > eye.*=eye
   clavicle.*=collar > shoulder01.*=twist > upperarm01.*=arm > upperarm02.*=twist > lowerarm01.*=elbow > lowerarm02.*=twist > wrist.*=hand
    finger1-1.*=thumb1 > finger1-2.*=thumb2 > finger1-3.*=thumb3
    metacarpal1.*=index0 > finger2-1.*=index1 > finger2-2.*=index2 > finger2-3.*=index3
    metacarpal2.*=middle0 > finger3-1.*=middle1 > finger3-2.*=middle2 > finger3-3.*=middle3
    metacarpal3.*=ring0 > finger4-1.*=ring1 > finger4-2.*=ring2 > finger4-3.*=ring3
    metacarpal4.*=little0 > finger5-1.*=little1 > finger5-2.*=little2 > finger5-3.*=little3
 pelvis.*=twist > upperleg01.*=leg > upperleg02.*=twist > lowerleg01.*=knee > lowerleg02.*=twist > foot.*=foot
  toe1-1.*=twist > toe1-2.*=twist
  toe2-1.*=twist > toe2-2.*=twist > toe2-3.*=twist
",
        },
    ),
    (
        "makehuman game engine",
        List {
            profiles: &["Unreal mannequin"],
            sides: ["l", "r"],
            text: "
Root=control
 pelvis=hips
  spine_01=spine > spine_02=spine > spine_03=spine
   breast_*=secondary
   neck_01=neck > head=head
   clavicle_*=collar > upperarm_*=arm > lowerarm_*=elbow > hand_*=hand
    thumb_01_*=thumb1 > thumb_02_*=thumb2 > thumb_03_*=thumb3
    index_01_*=index1 > index_02_*=index2 > index_03_*=index3
    middle_01_*=middle1 > middle_02_*=middle2 > middle_03_*=middle3
    ring_01_*=ring1 > ring_02_*=ring2 > ring_03_*=ring3
    pinky_01_*=little1 > pinky_02_*=little2 > pinky_03_*=little3
  thigh_*=leg > calf_*=knee > foot_*=foot > ball_*=toes
",
        },
    ),
    (
        "makehuman cmu",
        List {
            profiles: &["CMU"],
            sides: ["Left", "Right"],
            text: "
Hips=hips
 LowerBack=spine > Spine=spine > Spine1=spine
  Neck=neck > Neck1=neck > Head=head
  *Shoulder=collar > *Arm=arm > *ForeArm=elbow > *Hand=hand
   *FingerBase=twist > *HandIndex1=index1
   *Thumb=thumb1
 *HipJoint=twist > *UpLeg=leg > *Leg=knee > *Foot=foot > *ToeBase=toes
",
        },
    ),
    (
        "auto rig pro",
        List {
            profiles: &["Auto-Rig Pro"],
            sides: ["l", "r"],
            text: "
root.x=hips
 spine_01.x=spine > spine_02.x=spine > spine_03.x=spine
  neck.x=neck > head.x=head
   c_eye.*=eye
   c_jawbone.x=jaw
  shoulder.*=collar > arm_stretch.*=arm
   arm_twist.*=twist
   forearm_stretch.*=elbow
    forearm_twist.*=twist
    hand.*=hand
     c_thumb1.*=thumb1 > c_thumb2.*=thumb2 > c_thumb3.*=thumb3
     c_index1_base.*=index0 > c_index1.*=index1 > c_index2.*=index2 > c_index3.*=index3
     c_middle1_base.*=middle0 > c_middle1.*=middle1 > c_middle2.*=middle2 > c_middle3.*=middle3
     c_ring1_base.*=ring0 > c_ring1.*=ring1 > c_ring2.*=ring2 > c_ring3.*=ring3
     c_pinky1_base.*=little0 > c_pinky1.*=little1 > c_pinky2.*=little2 > c_pinky3.*=little3
  breast_01.*=secondary
 thigh_stretch.*=leg
  thigh_twist.*=twist
  leg_stretch.*=knee
   leg_twist.*=twist
   foot.*=foot > toes_01.*=toes
",
        },
    ),
];
