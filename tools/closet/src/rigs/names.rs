//! How tools name joints, which they have, and what they hang them on.

use super::role::{Role, Side};

/// A convention of names. Their lists are public: engines and formats print them in their manuals.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Naming {
    /// Mixamo: the hips are the root, ends of chains are joints, no twist, no controls.
    Mixamo,
    /// VRM and Unity's humanoid: the bare names, an upper chest, no ends.
    Vrm,
    /// Unreal's mannequin: a root on the floor, twist joints, targets below the root.
    Unreal,
    /// Rigify's deforming joints: the trunk is numbered from `spine` to the head.
    Rigify,
    /// `.L` and `.R`, and feet that hang on the root by the floor, where inverse kinematics put them.
    FeetOnRoot,
    /// No neck and no clavicles, a joint for the wrist and one for the hand, many controls.
    Controls,
    /// Nothing is named, and nothing is left out.
    Unnamed,
}

impl Naming {
    /// All of them.
    pub const ALL: [Self; 7] =
        [Self::Mixamo, Self::Vrm, Self::Unreal, Self::Rigify, Self::FeetOnRoot, Self::Controls, Self::Unnamed];

    /// A word for files and tables.
    pub fn word(self) -> &'static str {
        match self {
            Self::Mixamo => "mixamo",
            Self::Vrm => "vrm",
            Self::Unreal => "unreal",
            Self::Rigify => "rigify",
            Self::FeetOnRoot => "feet-on-root",
            Self::Controls => "controls",
            Self::Unnamed => "unnamed",
        }
    }

    /// The name of a role; none where this convention has no such joint.
    pub fn name(self, role: Role) -> Option<String> {
        match self {
            Self::Mixamo => mixamo(role),
            Self::Vrm => vrm(role),
            Self::Unreal => unreal(role),
            Self::Rigify => rigify(role),
            Self::FeetOnRoot => feet_on_root(role),
            Self::Controls => controls(role),
            Self::Unnamed => Some(String::new()),
        }
    }

    /// The role on which a joint hangs in this convention, if that is not the one that it moves with.
    pub fn hangs_on(self, role: Role) -> Option<Role> {
        match (self, role) {
            (Self::FeetOnRoot, Role::Foot(_)) => Some(Role::Root),
            _ => role.above(),
        }
    }
}

fn of(side: Side, left: &str, right: &str) -> String {
    match side {
        Side::Left => left.to_owned(),
        Side::Right => right.to_owned(),
    }
}

fn mixamo(role: Role) -> Option<String> {
    let sided = |side: Side, name: &str| format!("mixamorig:{}{name}", of(side, "Left", "Right"));
    let fingers = ["Thumb", "Index", "Middle", "Ring", "Pinky"];
    Some(match role {
        Role::Hips => "mixamorig:Hips".into(),
        Role::Spine(0) => "mixamorig:Spine".into(),
        Role::Spine(k) => format!("mixamorig:Spine{k}"),
        Role::Neck => "mixamorig:Neck".into(),
        Role::Head => "mixamorig:Head".into(),
        Role::HeadEnd => "mixamorig:HeadTop_End".into(),
        Role::Clavicle(side) => sided(side, "Shoulder"),
        Role::UpperArm(side) => sided(side, "Arm"),
        Role::LowerArm(side) => sided(side, "ForeArm"),
        Role::Wrist(side) => sided(side, "Hand"),
        Role::Finger(side, finger, k) => sided(side, &format!("Hand{}{}", fingers[finger], k + 1)),
        Role::Thigh(side) => sided(side, "UpLeg"),
        Role::Calf(side) => sided(side, "Leg"),
        Role::Foot(side) => sided(side, "Foot"),
        Role::Toe(side) => sided(side, "ToeBase"),
        Role::ToeEnd(side) => sided(side, "Toe_End"),
        _ => return None,
    })
}

fn vrm(role: Role) -> Option<String> {
    let sided = |side: Side, name: &str| of(side, "left", "right") + name;
    Some(match role {
        Role::Root => "Root".into(),
        Role::Hips => "hips".into(),
        Role::Spine(k) => ["spine", "chest", "upperChest"][k].into(),
        Role::Neck => "neck".into(),
        Role::Head => "head".into(),
        Role::Clavicle(side) => sided(side, "Shoulder"),
        Role::UpperArm(side) => sided(side, "UpperArm"),
        Role::LowerArm(side) => sided(side, "LowerArm"),
        Role::Wrist(side) => sided(side, "Hand"),
        Role::Finger(side, 0, k) => sided(side, ["ThumbMetacarpal", "ThumbProximal", "ThumbDistal"][k]),
        Role::Finger(side, finger, k) => {
            let finger = ["Index", "Middle", "Ring", "Little"][finger - 1];
            sided(side, &format!("{finger}{}", ["Proximal", "Intermediate", "Distal"][k]))
        }
        Role::Thigh(side) => sided(side, "UpperLeg"),
        Role::Calf(side) => sided(side, "LowerLeg"),
        Role::Foot(side) => sided(side, "Foot"),
        Role::Toe(side) => sided(side, "Toes"),
        _ => return None,
    })
}

fn unreal(role: Role) -> Option<String> {
    let sided = |name: &str, side: Side| name.to_owned() + &of(side, "_l", "_r");
    let fingers = ["thumb", "index", "middle", "ring", "pinky"];
    Some(match role {
        Role::Root => "root".into(),
        Role::Hips => "pelvis".into(),
        Role::Spine(k) => format!("spine_0{}", k + 1),
        Role::Neck => "neck_01".into(),
        Role::Head => "head".into(),
        Role::Clavicle(side) => sided("clavicle", side),
        Role::UpperArm(side) => sided("upperarm", side),
        Role::UpperArmTwist(side) => sided("upperarm_twist_01", side),
        Role::LowerArm(side) => sided("lowerarm", side),
        Role::LowerArmTwist(side) => sided("lowerarm_twist_01", side),
        Role::Wrist(side) => sided("hand", side),
        Role::Finger(side, finger, k) => sided(&format!("{}_0{}", fingers[finger], k + 1), side),
        Role::Slot(side) => sided("weapon", side),
        Role::Thigh(side) => sided("thigh", side),
        Role::ThighTwist(side) => sided("thigh_twist_01", side),
        Role::Calf(side) => sided("calf", side),
        Role::Foot(side) => sided("foot", side),
        Role::Toe(side) => sided("ball", side),
        Role::FeetControl => "ik_foot_root".into(),
        Role::HandsControl => "ik_hand_root".into(),
        Role::FootTarget(side) => sided("ik_foot", side),
        Role::HandTarget(side) => sided("ik_hand", side),
        _ => return None,
    })
}

fn rigify(role: Role) -> Option<String> {
    let sided = |name: &str, side: Side, more: &str| format!("DEF-{name}{}{more}", of(side, ".L", ".R"));
    let fingers = ["thumb", "f_index", "f_middle", "f_ring", "f_pinky"];
    Some(match role {
        Role::Root => "root".into(),
        Role::Hips => "DEF-spine".into(),
        Role::Spine(k) => format!("DEF-spine.00{}", k + 1),
        Role::Neck => "DEF-spine.004".into(),
        Role::Head => "DEF-spine.006".into(),
        Role::Clavicle(side) => sided("shoulder", side, ""),
        Role::UpperArm(side) => sided("upper_arm", side, ""),
        Role::UpperArmTwist(side) => sided("upper_arm", side, ".001"),
        Role::LowerArm(side) => sided("forearm", side, ""),
        Role::LowerArmTwist(side) => sided("forearm", side, ".001"),
        Role::Wrist(side) => sided("hand", side, ""),
        Role::Finger(side, finger, k) => sided(&format!("{}.0{}", fingers[finger], k + 1), side, ""),
        Role::Thigh(side) => sided("thigh", side, ""),
        Role::ThighTwist(side) => sided("thigh", side, ".001"),
        Role::Calf(side) => sided("shin", side, ""),
        Role::Foot(side) => sided("foot", side, ""),
        Role::Toe(side) => sided("toe", side, ""),
        _ => return None,
    })
}

fn feet_on_root(role: Role) -> Option<String> {
    let sided = |name: &str, side: Side| name.to_owned() + &of(side, ".L", ".R");
    let fingers = ["Thumb", "Index", "Middle", "Ring", "Pinky"];
    Some(match role {
        Role::Root => "Root".into(),
        Role::Hips => "Hips".into(),
        Role::Spine(k) => ["Abdomen", "Torso", "Chest"][k].into(),
        Role::Neck => "Neck".into(),
        Role::Head => "Head".into(),
        Role::HeadEnd => "Head_end".into(),
        Role::Clavicle(side) => sided("Shoulder", side),
        Role::UpperArm(side) => sided("UpperArm", side),
        Role::LowerArm(side) => sided("LowerArm", side),
        Role::Wrist(side) => sided("Hand", side),
        Role::Finger(side, finger, k) => sided(&format!("{}{}", fingers[finger], k + 1), side),
        Role::Thigh(side) => sided("UpperLeg", side),
        Role::Calf(side) => sided("LowerLeg", side),
        Role::Foot(side) => sided("Foot", side),
        Role::ToeEnd(side) => format!("Foot{}_end", of(side, ".L", ".R")),
        Role::KneePole(side) => sided("PoleTarget", side),
        _ => return None,
    })
}

fn controls(role: Role) -> Option<String> {
    let sided = |name: &str, side: Side| name.to_owned() + &of(side, ".l", ".r");
    Some(match role {
        Role::Root => "root".into(),
        Role::Hips => "hips".into(),
        Role::Spine(0) => "spine".into(),
        Role::Spine(2) => "chest".into(),
        Role::Head => "head".into(),
        Role::UpperArm(side) => sided("upperarm", side),
        Role::LowerArm(side) => sided("lowerarm", side),
        Role::Wrist(side) => sided("wrist", side),
        Role::Hand(side) => sided("hand", side),
        Role::Slot(side) => sided("handslot", side),
        Role::Thigh(side) => sided("upperleg", side),
        Role::Calf(side) => sided("lowerleg", side),
        Role::Foot(side) => sided("foot", side),
        Role::Toe(side) => sided("toes", side),
        Role::FootTarget(side) => sided("IK-foot", side),
        Role::HandTarget(side) => sided("handIK", side),
        Role::KneePole(side) => sided("kneeIK", side),
        Role::ElbowPole(side) => sided("elbowIK", side),
        _ => return None,
    })
}
