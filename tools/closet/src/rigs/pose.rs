//! Poses: where limbs point, and how that moves each joint.

use std::collections::BTreeMap;

use glam::{DAffine3, DMat3, DQuat, DVec3};

use super::role::{Role, SIDES, Side};

/// Directions of the left limbs (the right ones are mirrored) and bends of the trunk.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    /// Upper arm and forearm.
    pub arms: Option<[DVec3; 2]>,
    /// Thigh and shin; the feet stay level.
    pub legs: Option<[DVec3; 2]>,
    /// Forward bend of the spine in degrees; half of it is taken back by neck and head.
    pub back: f64,
}

const fn v(x: f64, y: f64, z: f64) -> DVec3 {
    DVec3::new(x, y, z)
}

const LEGS: Option<[DVec3; 2]> = Some([v(0.09, -0.02, -1.0), v(0.05, 0.04, -1.0)]);

impl Pose {
    /// Nothing moves.
    pub const BIND: Self = Self { arms: None, legs: None, back: 0.0 };
    /// Arms 45 degrees below the horizontal.
    pub const A: Self = Self { arms: Some([v(1.0, 0.0, -1.0), v(1.0, -0.1, -1.0)]), legs: LEGS, back: 0.0 };
    /// Arms level.
    pub const T: Self = Self { arms: Some([v(1.0, 0.0, 0.0), v(1.0, -0.05, 0.0)]), legs: LEGS, back: 0.0 };
    /// Arms hanging beside the thighs.
    pub const ARMS_DOWN: Self = Self { arms: Some([v(0.20, 0.02, -1.0), v(0.12, -0.12, -1.0)]), legs: LEGS, back: 0.0 };
    /// Arms up.
    pub const ARMS_RAISED: Self = Self { arms: Some([v(0.5, 0.0, 0.85), v(0.3, -0.1, 1.0)]), legs: LEGS, back: 0.0 };
    /// Forearms crossed before the chest.
    pub const ARMS_CROSSED: Self =
        Self { arms: Some([v(0.45, -0.55, -0.8), v(-0.8, -0.6, 0.15)]), legs: LEGS, back: 0.0 };
    /// Thighs level, back forward, arms ahead.
    pub const CROUCH: Self = Self {
        arms: Some([v(0.35, -0.7, -0.6), v(0.0, -1.0, -0.1)]),
        legs: Some([v(0.45, -1.0, -0.25), v(0.0, 0.35, -1.0)]),
        back: 25.0,
    };
    /// Bent over, arms hanging.
    pub const BENT: Self = Self { arms: Some([v(0.2, 0.0, -1.0), v(0.1, -0.05, -1.0)]), legs: LEGS, back: 55.0 };

    /// All of them, with a word for files and tables.
    pub const ALL: [(&'static str, Self); 8] = [
        ("bind", Self::BIND),
        ("a", Self::A),
        ("t", Self::T),
        ("arms-down", Self::ARMS_DOWN),
        ("arms-raised", Self::ARMS_RAISED),
        ("arms-crossed", Self::ARMS_CROSSED),
        ("crouch", Self::CROUCH),
        ("bent", Self::BENT),
    ];
}

/// How each role moves; none of them scales.
pub type Motions = BTreeMap<Role, DAffine3>;

/// The motions from where the joints are to a pose. The height of the body is not looked at.
pub fn motions(places: &BTreeMap<Role, DVec3>, pose: &Pose) -> Motions {
    let mut motions = Motions::new();
    let mirror = |side: Side, d: DVec3| if side == Side::Left { d } else { v(-d.x, d.y, d.z) };
    let bend = |degrees: f64| DQuat::from_rotation_x(degrees.to_radians());
    for role in Role::all() {
        let above = role.above().map_or(DAffine3::IDENTITY, |above| motions[&above]);
        let carried = DQuat::from_mat3(&above.matrix3);
        // The turn that brings the bone from where it would be carried to a direction.
        let aim = |role: Role, target: DVec3| {
            let bone = places[&role.ahead().expect("a limb goes on")] - places[&role];
            let target = carried.inverse() * target.normalize();
            DQuat::from_rotation_arc(bone.normalize(), target)
        };
        let limb = |limb: Option<[DVec3; 2]>, side: Side, k: usize| {
            limb.map_or(DQuat::IDENTITY, |both| aim(role, mirror(side, both[k])))
        };
        let turn = match role {
            Role::Spine(_) => bend(pose.back / 3.0),
            Role::Neck | Role::Head => bend(-0.25 * pose.back),
            // A shoulder goes along with its arm a little.
            Role::Clavicle(side) => pose.arms.map_or(DQuat::IDENTITY, |both| {
                let bone = places[&Role::LowerArm(side)] - places[&Role::UpperArm(side)];
                let whole = DQuat::from_rotation_arc((carried * bone).normalize(), mirror(side, both[0]).normalize());
                carried.inverse() * DQuat::IDENTITY.slerp(whole, 0.2) * carried
            }),
            Role::UpperArm(side) => limb(pose.arms, side, 0),
            Role::LowerArm(side) => limb(pose.arms, side, 1),
            Role::Thigh(side) => limb(pose.legs, side, 0),
            Role::Calf(side) => limb(pose.legs, side, 1),
            Role::Foot(_) => carried.inverse(),
            _ => DQuat::IDENTITY,
        };
        motions.insert(role, above * about(places[&role], turn));
    }
    for side in SIDES {
        let only_shift =
            |role: Role| DAffine3::from_translation(motions[&role].transform_point3(places[&role]) - places[&role]);
        for (target, of) in [
            (Role::FootTarget(side), motions[&Role::Foot(side)]),
            (Role::HandTarget(side), motions[&Role::Wrist(side)]),
            (Role::KneePole(side), only_shift(Role::Calf(side))),
            (Role::ElbowPole(side), only_shift(Role::LowerArm(side))),
        ] {
            motions.insert(target, of);
        }
    }
    motions
}

/// A turn about a point.
fn about(place: DVec3, turn: DQuat) -> DAffine3 {
    let turn = DMat3::from_quat(turn);
    DAffine3::from_mat3_translation(turn, place - turn * place)
}
