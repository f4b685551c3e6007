//! What is compared.

use glam::DVec3;

use crate::geometry::mesh::TriangleMesh;
use crate::input::coordinate_system::CoordinateSystem;
use crate::input::skeleton::Skeleton;
use crate::input::skin::SkinWeights;

/// What is looked at, in the internal coordinate system.
pub struct Scene<'a> {
    /// The garment, its vertices welded.
    pub garment: &'a TriangleMesh,
    /// The skeleton that it was designed on.
    pub source_skeleton: &'a Skeleton,
    /// The body that it was designed on.
    pub source_avatar: Option<&'a TriangleMesh>,
    /// The body to dress.
    pub avatar: &'a TriangleMesh,
    /// Its skeleton, bones in the order and direction of the source's.
    pub target_skeleton: &'a Skeleton,
    /// From the ankles to the toes in source and target, where rigs tell.
    pub feet: Option<[DVec3; 2]>,
    /// Its skin.
    pub skin: Option<&'a SkinWeights>,
    /// How the caller's source coordinates were read.
    pub source_coordinate_system: CoordinateSystem,
    /// How the caller's target coordinates were read.
    pub target_coordinate_system: CoordinateSystem,
}
