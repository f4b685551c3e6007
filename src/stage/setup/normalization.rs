//! The normalised space in which everything is solved.

use glam::DVec3;

use crate::error::Result;
use crate::input::skeleton::Skeleton;

/// The longest side of a skeleton's bounding box in the normalised space.
pub const SIDE: f64 = 2.0;

/// A uniform scale about a point: `p -> (p - origin) * scale`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Normalization {
    /// The point that becomes 0.
    pub origin: DVec3,
    /// Normalised units in a unit of the caller.
    pub scale: f64,
}

impl Normalization {
    /// The space in which the mean of the skeleton's joints is 0 and the longest side of their box is [`SIDE`].
    /// `name` is the skeleton's in errors.
    ///
    /// # Errors
    /// `InvalidSkeleton` where all the joints are in one place.
    pub fn of(skeleton: &Skeleton, name: &str) -> Result<Self> {
        let scale = SIDE / skeleton.longest_side(name)?;
        Ok(Self { origin: skeleton.mean_joint(), scale })
    }

    /// A caller's point in the normalised space.
    pub fn normalise(&self, p: DVec3) -> DVec3 {
        (p - self.origin) * self.scale
    }

    /// All of a caller's points in the normalised space.
    pub fn normalise_all(&self, points: &[DVec3]) -> Vec<DVec3> {
        points.iter().map(|&p| self.normalise(p)).collect()
    }

    /// A normalised point in the caller's space.
    pub fn restore(&self, p: DVec3) -> DVec3 {
        p / self.scale + self.origin
    }
}
