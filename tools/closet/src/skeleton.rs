//! The skeleton that all the samples share: 15 joints, z up, facing -y, arms and legs spread as an A.

use glam::DVec3;

/// Joint numbers. The right elbow comes after the right wrist.
pub const ROOT: usize = 0;
/// Above the root.
pub const WAIST: usize = 1;
/// Where the head begins.
pub const NECK: usize = 2;
/// Shoulder, elbow and wrist of the left (+x) and the right arm.
pub const ARMS: [[usize; 3]; 2] = [[3, 4, 5], [6, 8, 7]];
/// Hip, knee and ankle of the left (+x) and the right leg.
pub const LEGS: [[usize; 3]; 2] = [[9, 10, 11], [12, 13, 14]];
/// Number of joints.
pub const JOINTS: usize = 15;
/// The pairs of joints that bones join.
pub const BONES: [[u32; 2]; 14] = [
    [0, 1],
    [1, 2],
    [1, 3],
    [3, 4],
    [4, 5],
    [1, 6],
    [6, 8],
    [7, 8],
    [0, 9],
    [9, 10],
    [10, 11],
    [0, 12],
    [12, 13],
    [13, 14],
];

/// Joints in metres; the bones are [`BONES`].
#[derive(Clone, Debug, PartialEq)]
pub struct Skeleton {
    /// Position of each joint.
    pub joints: [DVec3; JOINTS],
}

/// Lengths (metres) and angles (degrees) from which a skeleton is laid out.
#[derive(Clone, Copy, Debug)]
pub struct Proportions {
    /// Height of the ankles above the floor.
    pub ankle: f64,
    /// Knee to ankle.
    pub shin: f64,
    /// Hip to knee.
    pub thigh: f64,
    /// Between the legs and the vertical.
    pub leg_angle: f64,
    /// Half the distance between the hips.
    pub hip: f64,
    /// Root to waist.
    pub belly: f64,
    /// Waist to neck, upwards.
    pub chest: f64,
    /// How far the neck is in front of the waist.
    pub hunch: f64,
    /// Half the distance between the shoulders.
    pub shoulder: f64,
    /// Neck down to the shoulders.
    pub shoulder_drop: f64,
    /// Shoulder to elbow.
    pub upper_arm: f64,
    /// Elbow to wrist.
    pub forearm: f64,
    /// Between the arms and the horizontal.
    pub arm_angle: f64,
}

impl Proportions {
    /// Lays the joints out.
    pub fn skeleton(&self) -> Skeleton {
        let (leg, arm) = (self.leg_angle.to_radians(), self.arm_angle.to_radians());
        let mut joints = [DVec3::ZERO; JOINTS];
        let hip_height = self.ankle + (self.thigh + self.shin) * leg.cos();
        joints[ROOT] = DVec3::new(0.0, 0.0, hip_height + 0.11 * self.thigh);
        joints[WAIST] = joints[ROOT] + DVec3::new(0.0, 0.006, self.belly);
        joints[NECK] = joints[WAIST] + DVec3::new(0.0, -self.hunch, self.chest);
        for (side, ([shoulder, elbow, wrist], [hip, knee, ankle])) in
            [1.0, -1.0].into_iter().zip(ARMS.into_iter().zip(LEGS))
        {
            let down = DVec3::new(side * arm.cos(), 0.0, -arm.sin());
            joints[shoulder] =
                joints[NECK] + DVec3::new(side * self.shoulder, -0.005 + 0.2 * self.hunch, -self.shoulder_drop);
            joints[elbow] = joints[shoulder] + self.upper_arm * (down + DVec3::new(0.0, 0.03, 0.0)).normalize();
            joints[wrist] = joints[elbow] + self.forearm * (down + DVec3::new(0.0, -0.2, 0.0)).normalize();
            let out = DVec3::new(side * leg.sin(), 0.0, -leg.cos());
            joints[hip] = DVec3::new(side * self.hip, 0.0, hip_height);
            joints[knee] = joints[hip] + self.thigh * (out + DVec3::new(0.0, -0.02, 0.0)).normalize();
            joints[ankle] = joints[knee] + self.shin * (out + DVec3::new(0.0, 0.06, 0.0)).normalize();
        }
        Skeleton { joints }
    }
}
