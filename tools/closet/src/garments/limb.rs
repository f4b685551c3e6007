//! Coordinates on an arm or a leg: how far along it a point is, and on which side of it.

use glam::DVec3;

use super::super::skeleton::Skeleton;

/// Half the length over which the directions of the two bones pass into each other, in metres.
const PASSAGE: f64 = 0.06;

/// Where a point is around a limb.
#[derive(Clone, Copy, Debug)]
pub struct Place {
    /// Metres along the limb from the shoulder or the hip.
    pub along: f64,
    /// 0 in front, a quarter of a turn on the side away from the trunk, from -pi to pi.
    pub angle: f64,
    /// Metres from the bone.
    pub radius: f64,
}

/// The upper and the lower bone of an arm or a leg.
#[derive(Clone, Copy, Debug)]
pub struct Limb {
    joints: [DVec3; 3],
    axes: [DVec3; 2],
    outwards: [DVec3; 2],
}

impl Limb {
    /// The limb of three joints of a skeleton, the one at the trunk first.
    pub fn new(skeleton: &Skeleton, joints: [usize; 3]) -> Self {
        let joints = joints.map(|joint| skeleton.joints[joint]);
        let axes = [joints[1] - joints[0], joints[2] - joints[1]].map(DVec3::normalize);
        let outwards = axes.map(|axis| (DVec3::X * joints[2].x.signum()).reject_from_normalized(axis).normalize());
        Self { joints, axes, outwards }
    }

    /// True on the left (+x).
    pub fn is_left(&self) -> bool {
        self.joints[2].x > 0.0
    }

    /// Length of the upper bone in metres: where the elbow or the knee is.
    pub fn middle(&self) -> f64 {
        self.joints[0].distance(self.joints[1])
    }

    /// Length of both bones in metres.
    pub fn length(&self) -> f64 {
        self.middle() + self.joints[1].distance(self.joints[2])
    }

    /// The point of a bone at `t` from 0 to 1, and the direction of that bone; `lower` selects which.
    pub fn bone(&self, lower: bool, t: f64) -> (DVec3, DVec3) {
        let first = usize::from(lower);
        (self.joints[first].lerp(self.joints[first + 1], t), self.axes[first])
    }

    /// Where a point is.
    pub fn place(&self, point: DVec3) -> Place {
        let from = point - self.joints[1];
        let before = from.dot(self.axes[0]);
        let after = from.dot(self.axes[1]);
        // At the bend both bones count; a plane halfway between them would make a jump.
        let x = (0.5 * (before + after) / PASSAGE).clamp(-1.0, 1.0);
        let share = 0.5 + 0.25 * x * (3.0 - x * x);
        let axis = self.axes[0].lerp(self.axes[1], share).normalize();
        let outwards = self.outwards[0].lerp(self.outwards[1], share).reject_from_normalized(axis).normalize();
        let across = from.reject_from_normalized(axis);
        // The lateral direction to the front; mirrored limbs turn the other way around, so that both mirror alike.
        let front = DVec3::NEG_Y.reject_from_normalized(axis).reject_from_normalized(outwards).normalize();
        Place {
            along: self.middle() + before + (after - before) * share,
            angle: across.dot(outwards).atan2(across.dot(front)),
            radius: across.length(),
        }
    }
}
