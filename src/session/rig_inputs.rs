//! What is set of rigs, and what stands in their place once they are read.

use std::sync::Arc;

use glam::DVec3;

use super::way::Way;
use crate::input::rig::Rig;
use crate::input::skeleton::Skeleton;
use crate::input::skin::SkinWeights;
use crate::rig::joint_map::CallersPair;

/// What was set of rigs, in the caller's own coordinate systems.
#[derive(Clone, Default)]
pub(super) struct Rigs {
    pub(super) source: Option<Arc<Rig>>,
    pub(super) target: Option<Arc<Rig>>,
    pub(super) garment_skin: Option<Arc<SkinWeights>>,
    pub(super) source_skin: Option<Arc<SkinWeights>>,
    pub(super) pairs: Arc<[CallersPair]>,
}

impl Rigs {
    /// Bytes that they hold.
    pub(super) fn memory(&self) -> u64 {
        let rigs: u64 = [&self.source, &self.target].into_iter().flatten().map(|rig| rig.memory()).sum();
        let skins: u64 = [&self.garment_skin, &self.source_skin].into_iter().flatten().map(|skin| skin.memory()).sum();
        rigs + skins + size_of_val(&self.pairs[..]) as u64
    }
}

/// The skeletons to work with, in the caller's coordinates, and the target's skin weights on them.
pub(super) struct Skeletons {
    /// The source skeleton.
    pub(super) source: Arc<Skeleton>,
    /// The target skeleton, with the same joints and bones.
    pub(super) target: Arc<Skeleton>,
    /// The skin weights of the target avatar.
    pub(super) skin: Option<Arc<SkinWeights>>,
    /// What of the target and of the source avatar is the end of a limb.
    pub(super) ends: [Option<Arc<SkinWeights>>; 2],
    /// From the ankles to the toes in source and target, in the internal coordinate system.
    pub(super) feet: Option<[DVec3; 2]>,
    /// The way from the source's pose, where the target stands in another one, however little that differs.
    pub(super) way: Option<Way>,
}
