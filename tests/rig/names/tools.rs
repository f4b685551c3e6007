//! Other tools.

use super::lists::List;

/// All of them, with their names.
pub const ALL: &[(&str, List)] = &[
    (
        "biped",
        List {
            profiles: &["3ds Max Biped"],
            sides: ["L", "R"],
            text: "
Bip001=control
 Bip001 Footsteps=control
 Bip001 Pelvis=hips
  Bip001 Spine=spine
   Bip001 Spine1=spine > Bip001 Spine2=spine > Bip001 Neck=neck
    Bip001 Head=head > Bip001 HeadNub=headtop
    Bip001 * Clavicle=collar > Bip001 * UpperArm=arm > Bip001 * Forearm=elbow
     Bip001 * ForeTwist=twist
     Bip001 * Hand=hand
      Bip001 * Finger0=thumb1 > Bip001 * Finger01=thumb2 > Bip001 * Finger02=thumb3 > Bip001 * Finger0Nub=thumb4
      Bip001 * Finger1=index1 > Bip001 * Finger11=index2 > Bip001 * Finger12=index3 > Bip001 * Finger1Nub=index4
      Bip001 * Finger2=middle1 > Bip001 * Finger21=middle2 > Bip001 * Finger22=middle3 > Bip001 * Finger2Nub=middle4
      Bip001 * Finger3=ring1 > Bip001 * Finger31=ring2 > Bip001 * Finger32=ring3 > Bip001 * Finger3Nub=ring4
      Bip001 * Finger4=little1 > Bip001 * Finger41=little2 > Bip001 * Finger42=little3 > Bip001 * Finger4Nub=little4
   Bip001 * Thigh=leg > Bip001 * Calf=knee > Bip001 * Foot=foot > Bip001 * Toe0=toes > Bip001 * Toe0Nub=toetip
",
        },
    ),
    (
        "biped old",
        List {
            profiles: &["3ds Max Biped"],
            sides: ["L", "R"],
            text: "
Bip01=control
 Bip01 Footsteps=control
 Bip01 Pelvis=hips
  Bip01 Spine=spine
   Bip01 Spine1=spine > Bip01 Spine2=spine > Bip01 Neck=neck
    Bip01 Head=head > Bip01 HeadNub=headtop
    Bip01 * Clavicle=collar > Bip01 * UpperArm=arm > Bip01 * Forearm=elbow
     Bip01 * ForeTwist=twist
     Bip01 * Hand=hand
      Bip01 * Finger0=thumb1 > Bip01 * Finger01=thumb2 > Bip01 * Finger02=thumb3 > Bip01 * Finger0Nub=thumb4
      Bip01 * Finger1=index1 > Bip01 * Finger11=index2 > Bip01 * Finger12=index3 > Bip01 * Finger1Nub=index4
      Bip01 * Finger2=middle1 > Bip01 * Finger21=middle2 > Bip01 * Finger22=middle3 > Bip01 * Finger2Nub=middle4
      Bip01 * Finger3=ring1 > Bip01 * Finger31=ring2 > Bip01 * Finger32=ring3 > Bip01 * Finger3Nub=ring4
      Bip01 * Finger4=little1 > Bip01 * Finger41=little2 > Bip01 * Finger42=little3 > Bip01 * Finger4Nub=little4
   Bip01 * Thigh=leg > Bip01 * Calf=knee > Bip01 * Foot=foot > Bip01 * Toe0=toes > Bip01 * Toe0Nub=toetip
",
        },
    ),
    (
        "character creator",
        List {
            profiles: &["Character Creator"],
            sides: ["L", "R"],
            text: "
CC_Base_BoneRoot=control
 CC_Base_Hip=hips
  CC_Base_Pelvis=twist
   CC_Base_*_Thigh=leg
    CC_Base_*_ThighTwist01=twist > CC_Base_*_ThighTwist02=twist
    CC_Base_*_Calf=knee
     CC_Base_*_CalfTwist01=twist > CC_Base_*_CalfTwist02=twist
     CC_Base_*_KneeShareBone=twist
     CC_Base_*_Foot=foot
      CC_Base_*_ToeBaseShareBone=twist
      CC_Base_*_ToeBase=toes
       CC_Base_*_BigToe1=twist
       CC_Base_*_IndexToe1=twist
       CC_Base_*_PinkyToe1=twist
  CC_Base_Waist=spine > CC_Base_Spine01=spine > CC_Base_Spine02=spine
   CC_Base_NeckTwist01=neck > CC_Base_NeckTwist02=neck > CC_Base_Head=head > CC_Base_FacialBone=secondary
    CC_Base_JawRoot=jaw > CC_Base_Tongue01=secondary > CC_Base_Tongue02=secondary
    CC_Base_*_Eye=eye
    CC_Base_UpperJaw=secondary > CC_Base_Teeth01=secondary
   CC_Base_*_Clavicle=collar > CC_Base_*_Upperarm=arm
    CC_Base_*_UpperarmTwist01=twist > CC_Base_*_UpperarmTwist02=twist
    CC_Base_*_Forearm=elbow
     CC_Base_*_ForearmTwist01=twist > CC_Base_*_ForearmTwist02=twist
     CC_Base_*_ElbowShareBone=twist
     CC_Base_*_Hand=hand
      CC_Base_*_Thumb1=thumb1 > CC_Base_*_Thumb2=thumb2 > CC_Base_*_Thumb3=thumb3
      CC_Base_*_Index1=index1 > CC_Base_*_Index2=index2 > CC_Base_*_Index3=index3
      CC_Base_*_Mid1=middle1 > CC_Base_*_Mid2=middle2 > CC_Base_*_Mid3=middle3
      CC_Base_*_Ring1=ring1 > CC_Base_*_Ring2=ring2 > CC_Base_*_Ring3=ring3
      CC_Base_*_Pinky1=little1 > CC_Base_*_Pinky2=little2 > CC_Base_*_Pinky3=little3
   CC_Base_*_RibsTwist=twist > CC_Base_*_Breast=secondary
",
        },
    ),
    (
        "daz genesis 8",
        List {
            profiles: &["DAZ Genesis 8"],
            sides: ["l", "r"],
            text: "
hip=hips
 pelvis=twist
  *ThighBend=leg > *ThighTwist=twist > *Shin=knee > *Foot=foot
   *Metatarsals=twist > *Toe=toes
    *BigToe=twist > *BigToe_2=twist
    *SmallToe1=twist > *SmallToe1_2=twist
   *Heel=twist
 abdomenLower=spine > abdomenUpper=spine > chestLower=spine
  chestUpper=spine
   neckLower=neck > neckUpper=neck > head=head
    *Eye=eye
    *Ear=secondary
    lowerJaw=jaw
    upperFaceRig=secondary
   *Collar=collar > *ShldrBend=arm > *ShldrTwist=twist > *ForearmBend=elbow > *ForearmTwist=twist > *Hand=hand
    *Thumb1=thumb1 > *Thumb2=thumb2 > *Thumb3=thumb3
    *Carpal1=index0 > *Index1=index1 > *Index2=index2 > *Index3=index3
    *Carpal2=middle0 > *Mid1=middle1 > *Mid2=middle2 > *Mid3=middle3
    *Carpal3=ring0 > *Ring1=ring1 > *Ring2=ring2 > *Ring3=ring3
    *Carpal4=little0 > *Pinky1=little1 > *Pinky2=little2 > *Pinky3=little3
  *Pectoral=secondary
",
        },
    ),
    (
        "daz genesis 9",
        List {
            profiles: &["DAZ Genesis 9"],
            sides: ["l", "r"],
            text: "
hip=hips
 pelvis=twist
  *_thigh=leg
   *_thightwist1=twist
   *_thightwist2=twist
   *_shin=knee > *_foot=foot > *_metatarsal=twist > *_toes=toes > *_bigtoe1=twist
 spine1=spine > spine2=spine > spine3=spine
  *_pectoral=secondary
  spine4=spine
   neck1=neck > neck2=neck > head=head
    lowerjaw=jaw
    *_eye=eye
   *_shoulder=collar > *_upperarm=arm
    *_upperarmtwist1=twist
    *_forearm=elbow
     *_forearmtwist1=twist
     *_hand=hand
      *_thumb1=thumb1 > *_thumb2=thumb2 > *_thumb3=thumb3
      *_indexmetacarpal=index0 > *_index1=index1 > *_index2=index2 > *_index3=index3
      *_midmetacarpal=middle0 > *_mid1=middle1 > *_mid2=middle2 > *_mid3=middle3
      *_ringmetacarpal=ring0 > *_ring1=ring1 > *_ring2=ring2 > *_ring3=ring3
      *_pinkymetacarpal=little0 > *_pinky1=little1 > *_pinky2=little2 > *_pinky3=little3
",
        },
    ),
    (
        "human ik",
        List {
            profiles: &["HumanIK"],
            sides: ["Left", "Right"],
            text: "
Character1_Reference=control > Character1_Hips=hips
 Character1_Spine=spine > Character1_Spine1=spine > Character1_Spine2=spine
  Character1_Neck=neck > Character1_Head=head
  Character1_*Shoulder=collar > Character1_*Arm=arm
   Character1_*ArmRoll=twist
   Character1_*ForeArm=elbow
    Character1_*ForeArmRoll=twist
    Character1_*Hand=hand
     Character1_*HandThumb1=thumb1 > Character1_*HandThumb2=thumb2 > Character1_*HandThumb3=thumb3 > Character1_*HandThumb4=thumb4
     Character1_*InHandIndex=index0 > Character1_*HandIndex1=index1 > Character1_*HandIndex2=index2 > Character1_*HandIndex3=index3 > Character1_*HandIndex4=index4
     Character1_*InHandMiddle=middle0 > Character1_*HandMiddle1=middle1 > Character1_*HandMiddle2=middle2 > Character1_*HandMiddle3=middle3 > Character1_*HandMiddle4=middle4
     Character1_*InHandRing=ring0 > Character1_*HandRing1=ring1 > Character1_*HandRing2=ring2 > Character1_*HandRing3=ring3 > Character1_*HandRing4=ring4
     Character1_*InHandPinky=little0 > Character1_*HandPinky1=little1 > Character1_*HandPinky2=little2 > Character1_*HandPinky3=little3 > Character1_*HandPinky4=little4
 Character1_*UpLeg=leg
  Character1_*UpLegRoll=twist
  Character1_*Leg=knee
   Character1_*LegRoll=twist
   Character1_*Foot=foot > Character1_*ToeBase=toes
",
        },
    ),
    (
        "smpl",
        List {
            profiles: &["SMPL"],
            sides: ["left", "right"],
            text: "
pelvis=hips
 *_hip=leg > *_knee=knee > *_ankle=foot > *_foot=toes
 spine1=spine > spine2=spine > spine3=spine
  neck=neck > head=head
  *_collar=collar > *_shoulder=arm > *_elbow=elbow > *_wrist=hand > *_hand=twist
",
        },
    ),
    (
        "smpl x",
        List {
            profiles: &["SMPL"],
            sides: ["left", "right"],
            text: "
pelvis=hips
 *_hip=leg > *_knee=knee > *_ankle=foot > *_foot=toes
 spine1=spine > spine2=spine > spine3=spine
  neck=neck > head=head
   jaw=jaw
   *_eye_smplhf=eye
  *_collar=collar > *_shoulder=arm > *_elbow=elbow > *_wrist=hand
    *_thumb1=thumb1 > *_thumb2=thumb2 > *_thumb3=thumb3
    *_index1=index1 > *_index2=index2 > *_index3=index3
    *_middle1=middle1 > *_middle2=middle2 > *_middle3=middle3
    *_ring1=ring1 > *_ring2=ring2 > *_ring3=ring3
    *_pinky1=little1 > *_pinky2=little2 > *_pinky3=little3
",
        },
    ),
    (
        "advanced skeleton",
        List {
            profiles: &["AdvancedSkeleton"],
            sides: ["L", "R"],
            text: "
Root_M=hips
 Hip_*=leg
  HipPart1_*=twist
  Knee_*=knee > Ankle_*=foot > Toes_*=toes > ToesEnd_*=toetip
 RootPart1_M=spine > Spine1_M=spine > Chest_M=spine
  Neck_M=neck > Head_M=head
   Eye_*=eye > EyeEnd_*=secondary
   Jaw_M=jaw > JawEnd_M=secondary
   HeadEnd_M=headtop
  Scapula_*=collar > Shoulder_*=arm
   ShoulderPart1_*=twist
   Elbow_*=elbow > Wrist_*=hand
    ThumbFinger1_*=thumb1 > ThumbFinger2_*=thumb2 > ThumbFinger3_*=thumb3 > ThumbFinger4_*=thumb4
    IndexFinger1_*=index1 > IndexFinger2_*=index2 > IndexFinger3_*=index3 > IndexFinger4_*=index4
    Cup_*=little0 > PinkyFinger1_*=little1 > PinkyFinger2_*=little2 > PinkyFinger3_*=little3
",
        },
    ),
    (
        "vrchat",
        List {
            profiles: &["VRChat"],
            sides: ["Left", "Right"],
            text: "
Hips=hips
 Spine=spine > Chest=spine
  Neck=neck > Head=head
   Eye_*=eye
  * shoulder=collar > * arm=arm > * elbow=elbow > * wrist=hand
   Thumb0_*=thumb1 > Thumb1_*=thumb2 > Thumb2_*=thumb3
   IndexFinger1_*=index1 > IndexFinger2_*=index2 > IndexFinger3_*=index3
   MiddleFinger1_*=middle1 > MiddleFinger2_*=middle2 > MiddleFinger3_*=middle3
   RingFinger1_*=ring1 > RingFinger2_*=ring2 > RingFinger3_*=ring3
   LittleFinger1_*=little1 > LittleFinger2_*=little2 > LittleFinger3_*=little3
 * leg=leg > * knee=knee > * ankle=foot > * toe=toes
",
        },
    ),
    (
        "second life",
        List {
            profiles: &["Second Life"],
            sides: ["Left", "Right"],
            text: "
mPelvis=hips
 mSpine1=spine > mSpine2=spine > mTorso=spine > mSpine3=spine > mSpine4=spine > mChest=spine
  mNeck=neck > mHead=head
   mSkull=headtop
   mEye*=eye
  mCollar*=collar > mShoulder*=arm > mElbow*=elbow > mWrist*=hand
   mHandThumb1*=thumb1 > mHandThumb2*=thumb2 > mHandThumb3*=thumb3
   mHandIndex1*=index1 > mHandIndex2*=index2 > mHandIndex3*=index3
   mHandMiddle1*=middle1 > mHandMiddle2*=middle2 > mHandMiddle3*=middle3
   mHandRing1*=ring1 > mHandRing2*=ring2 > mHandRing3*=ring3
   mHandPinky1*=little1 > mHandPinky2*=little2 > mHandPinky3*=little3
 mGroin=secondary
 mHip*=leg > mKnee*=knee > mAnkle*=foot > mFoot*=toes > mToe*=toetip
",
        },
    ),
    (
        "mikumikudance",
        List {
            profiles: &["MikuMikuDance"],
            sides: ["左", "右"],
            text: "
全ての親=control > センター=control > グルーブ=control > 腰=control
 下半身=hips
  *足=leg > *ひざ=knee > *足首=foot > *つま先=toes
 上半身=spine > 上半身2=spine
  首=neck > 頭=head
   両目=control
   *目=eye
  *肩=collar > *腕=arm
   *腕捩=twist
   *ひじ=elbow
    *手捩=twist
    *手首=hand
     *親指０=thumb1 > *親指１=thumb2 > *親指２=thumb3
     *人指１=index1 > *人指２=index2 > *人指３=index3
     *中指１=middle1 > *中指２=middle2 > *中指３=middle3
     *薬指１=ring1 > *薬指２=ring2 > *薬指３=ring3
     *小指１=little1 > *小指２=little2 > *小指３=little3
     *ダミー=control
*足ＩＫ=control > *つま先ＩＫ=control
",
        },
    ),
    (
        "xsens",
        List {
            profiles: &["Xsens"],
            sides: ["Left", "Right"],
            text: "
Pelvis=hips
 L5=spine > L3=spine > T12=spine > T8=spine
  Neck=neck > Head=head
  *Shoulder=collar > *UpperArm=arm > *ForeArm=elbow > *Hand=hand
 *UpperLeg=leg > *LowerLeg=knee > *Foot=foot > *Toe=toes
",
        },
    ),
];
