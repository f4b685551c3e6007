//! Second Life's avatars.
//!
//! Names: wiki.secondlife.com, Project Bento skeleton.

use super::Profile;
use crate::rig::body_part::Finger::{Index, Little, Middle, Ring, Thumb};
use crate::rig::names::slot::Slot::{
    Clavicle, Control, Eye, Finger, Foot, Hand, Head, HeadTop, Hips, Jaw, LowerArm, LowerLeg, Neck, Secondary, Spine,
    ToeTip, Toes, UpperArm, UpperLeg,
};

pub const PROFILE: Profile = Profile {
    name: "Second Life",
    prefixes: &[],
    rows: &[
        (Hips, "mPelvis"),
        (Spine, "mSpine#, mTorso, mChest"),
        (Neck, "mNeck"),
        (Head, "mHead"),
        (HeadTop, "mSkull"),
        (Eye, "mEye*"),
        (Jaw, "mFaceJaw"),
        (Clavicle, "mCollar*"),
        (UpperArm, "mShoulder*"),
        (LowerArm, "mElbow*"),
        (Hand, "mWrist*"),
        (UpperLeg, "mHip*"),
        (LowerLeg, "mKnee*"),
        (Foot, "mAnkle*"),
        (Toes, "mFoot*"),
        (ToeTip, "mToe*"),
        (Finger(Thumb), "mHandThumb1*, mHandThumb2*, mHandThumb3*"),
        (Finger(Index), "mHandIndex1*, mHandIndex2*, mHandIndex3*"),
        (Finger(Middle), "mHandMiddle1*, mHandMiddle2*, mHandMiddle3*"),
        (Finger(Ring), "mHandRing1*, mHandRing2*, mHandRing3*"),
        (Finger(Little), "mHandPinky1*, mHandPinky2*, mHandPinky3*"),
        (Secondary, "mGroin, mTail#, mWing#*, mWing#Fan*"),
        (Control, "mHindLimbsRoot"),
    ],
};
