//! The way of a body between the pose in which the garment is solved and its own, in its caller's coordinates.

use std::sync::Arc;

use glam::{DAffine3, DVec3};

use crate::input::coordinate_system::CoordinateSystem;
use crate::input::skeleton::Skeleton;
use crate::input::skin::SkinWeights;
use crate::rig::common_skeleton::CommonSkeleton;
use crate::rig::posing::Posing;

/// Where a body with its layers is on the way: share 0 is its own pose, 1 that of the source.
#[derive(Clone)]
pub(super) struct Way {
    pub(super) posing: Arc<Posing>,
    /// Limbs with the garment on them turn by much.
    pub(super) is_large: bool,
    pub(super) common: Arc<CommonSkeleton>,
    /// In which body and layers are read.
    pub(super) system: CoordinateSystem,
    /// The weights of the body's vertices and those of its layers, on the target rig.
    pub(super) skin: Arc<SkinWeights>,
    /// These vertices in their own pose, in the internal coordinate system.
    pub(super) points: Arc<[DVec3]>,
}

impl Way {
    /// The vertices of body and layers, in the caller's coordinates.
    pub(super) fn points(&self, share: f64) -> Vec<DVec3> {
        let moved = self.posing.moved(&self.posing.motions(share), &self.skin, &self.points);
        moved.into_iter().map(|p| self.system.position_from_internal(p)).collect()
    }

    /// The target skeleton, in the caller's coordinates.
    pub(super) fn skeleton(&self, share: f64) -> Skeleton {
        let mut skeleton = self.common.posed_target(&self.posing, &self.posing.motions(share));
        skeleton.joints.iter_mut().for_each(|p| *p = self.system.position_from_internal(*p));
        skeleton
    }

    /// How each joint of the rig moves from one share to another, in the internal coordinate system.
    pub(super) fn motions_between(&self, from: f64, to: f64) -> Vec<DAffine3> {
        let (from, to) = (self.posing.motions(from), self.posing.motions(to));
        from.iter().zip(&to).map(|(from, to)| *to * from.inverse()).collect()
    }
}
