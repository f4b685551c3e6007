//! Poses of the target rig in which a garment is corrected.

use glam::DAffine3;

/// A pose of the target rig.
#[derive(Clone, Debug, Default)]
pub struct KeyPose {
    /// For messages; may be empty.
    pub name: String,
    /// How each joint of the target rig moves what it moves, from the bind pose to this one, in the target coordinate system.
    pub motions: Vec<DAffine3>,
}

impl KeyPose {
    /// It as messages name it: `key pose 2 ("crouch")`.
    pub fn title(&self, index: usize) -> String {
        if self.name.is_empty() { format!("key pose {index}") } else { format!("key pose {index} (\"{}\")", self.name) }
    }
}
