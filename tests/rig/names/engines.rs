//! Engines and services.

use super::lists::List;

/// All of them, with their names.
pub const ALL: &[(&str, List)] = &[
    (
        "mixamo",
        List {
            profiles: &["Mixamo", "HumanIK"],
            sides: ["Left", "Right"],
            text: "
mixamorig:Hips=hips
 mixamorig:Spine=spine > mixamorig:Spine1=spine > mixamorig:Spine2=spine
  mixamorig:Neck=neck > mixamorig:Head=head
   mixamorig:HeadTop_End=headtop
  mixamorig:*Shoulder=collar > mixamorig:*Arm=arm > mixamorig:*ForeArm=elbow > mixamorig:*Hand=hand
   mixamorig:*HandThumb1=thumb1 > mixamorig:*HandThumb2=thumb2 > mixamorig:*HandThumb3=thumb3 > mixamorig:*HandThumb4=thumb4
   mixamorig:*HandIndex1=index1 > mixamorig:*HandIndex2=index2 > mixamorig:*HandIndex3=index3 > mixamorig:*HandIndex4=index4
   mixamorig:*HandMiddle1=middle1 > mixamorig:*HandMiddle2=middle2 > mixamorig:*HandMiddle3=middle3 > mixamorig:*HandMiddle4=middle4
   mixamorig:*HandRing1=ring1 > mixamorig:*HandRing2=ring2 > mixamorig:*HandRing3=ring3 > mixamorig:*HandRing4=ring4
   mixamorig:*HandPinky1=little1 > mixamorig:*HandPinky2=little2 > mixamorig:*HandPinky3=little3 > mixamorig:*HandPinky4=little4
 mixamorig:*UpLeg=leg > mixamorig:*Leg=knee > mixamorig:*Foot=foot > mixamorig:*ToeBase=toes > mixamorig:*Toe_End=toetip
",
        },
    ),
    (
        "mixamo 1",
        List {
            profiles: &["Mixamo", "HumanIK"],
            sides: ["Left", "Right"],
            text: "
mixamorig1:Hips=hips
 mixamorig1:Spine=spine > mixamorig1:Spine1=spine > mixamorig1:Spine2=spine
  mixamorig1:Neck=neck > mixamorig1:Head=head
   mixamorig1:HeadTop_End=headtop
  mixamorig1:*Shoulder=collar > mixamorig1:*Arm=arm > mixamorig1:*ForeArm=elbow > mixamorig1:*Hand=hand
   mixamorig1:*HandThumb1=thumb1 > mixamorig1:*HandThumb2=thumb2 > mixamorig1:*HandThumb3=thumb3 > mixamorig1:*HandThumb4=thumb4
   mixamorig1:*HandIndex1=index1 > mixamorig1:*HandIndex2=index2 > mixamorig1:*HandIndex3=index3 > mixamorig1:*HandIndex4=index4
   mixamorig1:*HandMiddle1=middle1 > mixamorig1:*HandMiddle2=middle2 > mixamorig1:*HandMiddle3=middle3 > mixamorig1:*HandMiddle4=middle4
   mixamorig1:*HandRing1=ring1 > mixamorig1:*HandRing2=ring2 > mixamorig1:*HandRing3=ring3 > mixamorig1:*HandRing4=ring4
   mixamorig1:*HandPinky1=little1 > mixamorig1:*HandPinky2=little2 > mixamorig1:*HandPinky3=little3 > mixamorig1:*HandPinky4=little4
 mixamorig1:*UpLeg=leg > mixamorig1:*Leg=knee > mixamorig1:*Foot=foot > mixamorig1:*ToeBase=toes > mixamorig1:*Toe_End=toetip
",
        },
    ),
    (
        "mixamo joined",
        List {
            profiles: &["Mixamo", "HumanIK"],
            sides: ["Left", "Right"],
            text: "
mixamorigHips=hips
 mixamorigSpine=spine > mixamorigSpine1=spine > mixamorigSpine2=spine
  mixamorigNeck=neck > mixamorigHead=head
   mixamorigHeadTop_End=headtop
  mixamorig*Shoulder=collar > mixamorig*Arm=arm > mixamorig*ForeArm=elbow > mixamorig*Hand=hand
   mixamorig*HandThumb1=thumb1 > mixamorig*HandThumb2=thumb2 > mixamorig*HandThumb3=thumb3 > mixamorig*HandThumb4=thumb4
   mixamorig*HandIndex1=index1 > mixamorig*HandIndex2=index2 > mixamorig*HandIndex3=index3 > mixamorig*HandIndex4=index4
   mixamorig*HandMiddle1=middle1 > mixamorig*HandMiddle2=middle2 > mixamorig*HandMiddle3=middle3 > mixamorig*HandMiddle4=middle4
   mixamorig*HandRing1=ring1 > mixamorig*HandRing2=ring2 > mixamorig*HandRing3=ring3 > mixamorig*HandRing4=ring4
   mixamorig*HandPinky1=little1 > mixamorig*HandPinky2=little2 > mixamorig*HandPinky3=little3 > mixamorig*HandPinky4=little4
 mixamorig*UpLeg=leg > mixamorig*Leg=knee > mixamorig*Foot=foot > mixamorig*ToeBase=toes > mixamorig*Toe_End=toetip
",
        },
    ),
    (
        "ready player me",
        List {
            profiles: &["Mixamo", "HumanIK"],
            sides: ["Left", "Right"],
            text: "
Armature=control
 Hips=hips
  Spine=spine > Spine1=spine > Spine2=spine
   Neck=neck > Head=head
    HeadTop_End=headtop
    *Eye=eye
   *Shoulder=collar > *Arm=arm > *ForeArm=elbow > *Hand=hand
    *HandThumb1=thumb1 > *HandThumb2=thumb2 > *HandThumb3=thumb3
    *HandIndex1=index1 > *HandIndex2=index2 > *HandIndex3=index3
    *HandMiddle1=middle1 > *HandMiddle2=middle2 > *HandMiddle3=middle3
    *HandRing1=ring1 > *HandRing2=ring2 > *HandRing3=ring3
    *HandPinky1=little1 > *HandPinky2=little2 > *HandPinky3=little3
  *UpLeg=leg > *Leg=knee > *Foot=foot > *ToeBase=toes
",
        },
    ),
    (
        "unreal 4",
        List {
            profiles: &["Unreal mannequin"],
            sides: ["l", "r"],
            text: "
root=control
 pelvis=hips
  spine_01=spine > spine_02=spine > spine_03=spine
   neck_01=neck > head=head
   clavicle_*=collar > upperarm_*=arm
    upperarm_twist_01_*=twist
    lowerarm_*=elbow
     lowerarm_twist_01_*=twist
     hand_*=hand
      thumb_01_*=thumb1 > thumb_02_*=thumb2 > thumb_03_*=thumb3
      index_01_*=index1 > index_02_*=index2 > index_03_*=index3
      middle_01_*=middle1 > middle_02_*=middle2 > middle_03_*=middle3
      ring_01_*=ring1 > ring_02_*=ring2 > ring_03_*=ring3
      pinky_01_*=little1 > pinky_02_*=little2 > pinky_03_*=little3
  thigh_*=leg
   thigh_twist_01_*=twist
   calf_*=knee
    calf_twist_01_*=twist
    foot_*=foot > ball_*=toes
 ik_foot_root=control
  ik_foot_*=control
 ik_hand_root=control > ik_hand_gun=control
  ik_hand_*=control
",
        },
    ),
    (
        "unreal 5",
        List {
            profiles: &["Unreal mannequin"],
            sides: ["l", "r"],
            text: "
root=control
 pelvis=hips
  spine_01=spine > spine_02=spine > spine_03=spine > spine_04=spine > spine_05=spine
   neck_01=neck > neck_02=neck > head=head
   clavicle_*=collar
    clavicle_out_*=twist
    upperarm_*=arm
     upperarm_correctiveRoot_*=twist > upperarm_fwd_*=twist
     upperarm_twist_01_*=twist
     upperarm_twist_02_*=twist
     lowerarm_*=elbow
      lowerarm_twist_01_*=twist
      lowerarm_twist_02_*=twist
      lowerarm_correctiveRoot_*=twist
      hand_*=hand
       wrist_inner_*=twist
       thumb_01_*=thumb1 > thumb_02_*=thumb2 > thumb_03_*=thumb3
       index_metacarpal_*=index0 > index_01_*=index1 > index_02_*=index2 > index_03_*=index3
       middle_metacarpal_*=middle0 > middle_01_*=middle1 > middle_02_*=middle2 > middle_03_*=middle3
       ring_metacarpal_*=ring0 > ring_01_*=ring1 > ring_02_*=ring2 > ring_03_*=ring3
       pinky_metacarpal_*=little0 > pinky_01_*=little1 > pinky_02_*=little2 > pinky_03_*=little3
       weapon_*=prop
  thigh_*=leg
   thigh_twist_01_*=twist
   thigh_correctiveRoot_*=twist > thigh_bck_*=twist
   calf_*=knee
    calf_twist_01_*=twist
    calf_correctiveRoot_*=twist > calf_kneeBack_*=twist
    foot_*=foot
     ball_*=toes
     ankle_fwd_*=twist
 interaction=control
 center_of_mass=control
 ik_foot_root=control
  ik_foot_*=control
 ik_hand_root=control > ik_hand_gun=control
  ik_hand_*=control
",
        },
    ),
    (
        "vrm 1",
        List {
            profiles: &["VRM humanoid", "Godot SkeletonProfileHumanoid"],
            sides: ["left", "right"],
            text: "
hips=hips
 spine=spine > chest=spine > upperChest=spine
  neck=neck > head=head
   jaw=jaw
   *Eye=eye
  *Shoulder=collar > *UpperArm=arm > *LowerArm=elbow > *Hand=hand
   *ThumbMetacarpal=thumb1 > *ThumbProximal=thumb2 > *ThumbDistal=thumb3
   *IndexProximal=index1 > *IndexIntermediate=index2 > *IndexDistal=index3
   *MiddleProximal=middle1 > *MiddleIntermediate=middle2 > *MiddleDistal=middle3
   *RingProximal=ring1 > *RingIntermediate=ring2 > *RingDistal=ring3
   *LittleProximal=little1 > *LittleIntermediate=little2 > *LittleDistal=little3
 *UpperLeg=leg > *LowerLeg=knee > *Foot=foot > *Toes=toes
",
        },
    ),
    (
        "vrm 0",
        List {
            profiles: &["Unity humanoid"],
            sides: ["left", "right"],
            text: "
hips=hips
 spine=spine > chest=spine > upperChest=spine
  neck=neck > head=head
   jaw=jaw
   *Eye=eye
  *Shoulder=collar > *UpperArm=arm > *LowerArm=elbow > *Hand=hand
   *ThumbProximal=thumb1 > *ThumbIntermediate=thumb2 > *ThumbDistal=thumb3
   *IndexProximal=index1 > *IndexIntermediate=index2 > *IndexDistal=index3
   *MiddleProximal=middle1 > *MiddleIntermediate=middle2 > *MiddleDistal=middle3
   *RingProximal=ring1 > *RingIntermediate=ring2 > *RingDistal=ring3
   *LittleProximal=little1 > *LittleIntermediate=little2 > *LittleDistal=little3
 *UpperLeg=leg > *LowerLeg=knee > *Foot=foot > *Toes=toes
",
        },
    ),
    (
        "unity",
        List {
            profiles: &["Unity humanoid"],
            sides: ["Left", "Right"],
            text: "
Hips=hips
 Spine=spine > Chest=spine > UpperChest=spine
  Neck=neck > Head=head
   Jaw=jaw
   *Eye=eye
  *Shoulder=collar > *UpperArm=arm > *LowerArm=elbow > *Hand=hand
   *ThumbProximal=thumb1 > *ThumbIntermediate=thumb2 > *ThumbDistal=thumb3
   *IndexProximal=index1 > *IndexIntermediate=index2 > *IndexDistal=index3
   *MiddleProximal=middle1 > *MiddleIntermediate=middle2 > *MiddleDistal=middle3
   *RingProximal=ring1 > *RingIntermediate=ring2 > *RingDistal=ring3
   *LittleProximal=little1 > *LittleIntermediate=little2 > *LittleDistal=little3
 *UpperLeg=leg > *LowerLeg=knee > *Foot=foot > *Toes=toes
",
        },
    ),
    (
        "unity bone names",
        List {
            profiles: &["Unity humanoid"],
            sides: ["Left", "Right"],
            text: "
Hips=hips
 Spine=spine > Chest=spine > UpperChest=spine
  Neck=neck > Head=head
   Jaw=jaw
   * Eye=eye
  * Shoulder=collar > * UpperArm=arm > * LowerArm=elbow > * Hand=hand
   * Thumb Proximal=thumb1 > * Thumb Intermediate=thumb2 > * Thumb Distal=thumb3
   * Index Proximal=index1 > * Index Intermediate=index2 > * Index Distal=index3
   * Middle Proximal=middle1 > * Middle Intermediate=middle2 > * Middle Distal=middle3
   * Ring Proximal=ring1 > * Ring Intermediate=ring2 > * Ring Distal=ring3
   * Little Proximal=little1 > * Little Intermediate=little2 > * Little Distal=little3
 * UpperLeg=leg > * LowerLeg=knee > * Foot=foot > * Toes=toes
",
        },
    ),
    (
        "godot",
        List {
            profiles: &["VRM humanoid", "Godot SkeletonProfileHumanoid"],
            sides: ["Left", "Right"],
            text: "
Root=control
 Hips=hips
  Spine=spine > Chest=spine > UpperChest=spine
   Neck=neck > Head=head
    Jaw=jaw
    *Eye=eye
   *Shoulder=collar > *UpperArm=arm > *LowerArm=elbow > *Hand=hand
    *ThumbMetacarpal=thumb1 > *ThumbProximal=thumb2 > *ThumbDistal=thumb3
    *IndexProximal=index1 > *IndexIntermediate=index2 > *IndexDistal=index3
    *MiddleProximal=middle1 > *MiddleIntermediate=middle2 > *MiddleDistal=middle3
    *RingProximal=ring1 > *RingIntermediate=ring2 > *RingDistal=ring3
    *LittleProximal=little1 > *LittleIntermediate=little2 > *LittleDistal=little3
  *UpperLeg=leg > *LowerLeg=knee > *Foot=foot > *Toes=toes
",
        },
    ),
    (
        "vroid",
        List {
            profiles: &["VRoid"],
            sides: ["L", "R"],
            text: "
Root=control
 J_Bip_C_Hips=hips
  J_Bip_C_Spine=spine > J_Bip_C_Chest=spine > J_Bip_C_UpperChest=spine
   J_Sec_*_Bust1=secondary > J_Sec_*_Bust2=secondary
   J_Bip_C_Neck=neck > J_Bip_C_Head=head
    J_Adj_*_FaceEye=eye
    J_Sec_Hair1_01=secondary > J_Sec_Hair2_01=secondary
    J_Sec_Hair1_02=secondary > J_Sec_Hair2_02=secondary
   J_Bip_*_Shoulder=collar > J_Bip_*_UpperArm=arm > J_Bip_*_LowerArm=elbow > J_Bip_*_Hand=hand
    J_Bip_*_Thumb1=thumb1 > J_Bip_*_Thumb2=thumb2 > J_Bip_*_Thumb3=thumb3
    J_Bip_*_Index1=index1 > J_Bip_*_Index2=index2 > J_Bip_*_Index3=index3
    J_Bip_*_Middle1=middle1 > J_Bip_*_Middle2=middle2 > J_Bip_*_Middle3=middle3
    J_Bip_*_Ring1=ring1 > J_Bip_*_Ring2=ring2 > J_Bip_*_Ring3=ring3
    J_Bip_*_Little1=little1 > J_Bip_*_Little2=little2 > J_Bip_*_Little3=little3
  J_Bip_*_UpperLeg=leg > J_Bip_*_LowerLeg=knee > J_Bip_*_Foot=foot > J_Bip_*_ToeBase=toes
  J_Sec_L_CoatSkirtFront1_01=secondary > J_Sec_L_CoatSkirtFront2_01=secondary
",
        },
    ),
    (
        "roblox r15",
        List {
            profiles: &["Roblox R15"],
            sides: ["Left", "Right"],
            text: "
Root=control
 HumanoidRootNode=control
  LowerTorso=hips
   UpperTorso=spine
    Head=head
    *UpperArm=arm > *LowerArm=elbow > *Hand=hand
   *UpperLeg=leg > *LowerLeg=knee > *Foot=foot
",
        },
    ),
    (
        "source engine",
        List {
            profiles: &["Source engine ValveBiped"],
            sides: ["L", "R"],
            text: "
ValveBiped.Bip01_Pelvis=hips
 ValveBiped.Bip01_Spine=spine > ValveBiped.Bip01_Spine1=spine > ValveBiped.Bip01_Spine2=spine > ValveBiped.Bip01_Spine4=spine
  ValveBiped.Bip01_Neck1=neck > ValveBiped.Bip01_Head1=head > ValveBiped.forward=prop
  ValveBiped.Bip01_*_Clavicle=collar > ValveBiped.Bip01_*_UpperArm=arm
   ValveBiped.Bip01_*_Bicep=twist
   ValveBiped.Bip01_*_Forearm=elbow
    ValveBiped.Bip01_*_Ulna=twist
    ValveBiped.Bip01_*_Hand=hand
     ValveBiped.Anim_Attachment_*H=prop
     ValveBiped.Bip01_*_Finger0=thumb1 > ValveBiped.Bip01_*_Finger01=thumb2 > ValveBiped.Bip01_*_Finger02=thumb3
     ValveBiped.Bip01_*_Finger1=index1 > ValveBiped.Bip01_*_Finger11=index2 > ValveBiped.Bip01_*_Finger12=index3
     ValveBiped.Bip01_*_Finger2=middle1 > ValveBiped.Bip01_*_Finger21=middle2 > ValveBiped.Bip01_*_Finger22=middle3
     ValveBiped.Bip01_*_Finger3=ring1 > ValveBiped.Bip01_*_Finger31=ring2 > ValveBiped.Bip01_*_Finger32=ring3
     ValveBiped.Bip01_*_Finger4=little1 > ValveBiped.Bip01_*_Finger41=little2 > ValveBiped.Bip01_*_Finger42=little3
 ValveBiped.Bip01_*_Thigh=leg > ValveBiped.Bip01_*_Calf=knee > ValveBiped.Bip01_*_Foot=foot > ValveBiped.Bip01_*_Toe0=toes
",
        },
    ),
];
