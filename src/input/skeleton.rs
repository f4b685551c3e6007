//! Joints and bones.

use glam::DVec3;

/// Joints, and bones between pairs of them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Skeleton {
    /// Position of each joint.
    pub joints: Vec<DVec3>,
    /// The two joints of each bone.
    pub bones: Vec<[u32; 2]>,
}
