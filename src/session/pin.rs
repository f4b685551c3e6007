//! What holds a vertex.

use glam::DVec3;

/// A garment vertex that is held in a place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pin {
    /// The vertex.
    pub vertex: u32,
    /// Its target, in the target's coordinate system; none: where it was designed, carried along with the nearest bone.
    pub target: Option<DVec3>,
}
