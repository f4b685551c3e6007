//! The normalised space in which everything is solved.

use glam::{DQuat, DVec3};

use crate::error::Result;
use crate::geometry::alignment::Similarity;
use crate::geometry::turn;
use crate::input::skeleton::Skeleton;

/// The longest side of a skeleton's bounding box in the normalised space.
pub const SIDE: f64 = 2.0;

/// Skeletons that are turned against each other by less than this, in radians, find their way as they are: a pose is no turn.
const LEAST_TURN: f64 = 0.25;
/// A turn counts where it leaves at most this share of the distance between the joints.
const CLEARER: f64 = 0.5;

/// A uniform scale about a point, `p -> (p - origin) * scale`, and after it a turn, if there is one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Normalization {
    /// The point that becomes 0.
    pub origin: DVec3,
    /// Normalised units in a unit of the caller.
    pub scale: f64,
    /// What follows.
    pub turn: Option<DQuat>,
}

impl Normalization {
    /// The space in which the mean of the skeleton's joints is 0 and the longest side of their box is [`SIDE`].
    /// `name` is the skeleton's in errors.
    ///
    /// # Errors
    /// `InvalidSkeleton` where all the joints are in one place.
    pub fn of(skeleton: &Skeleton, name: &str) -> Result<Self> {
        let scale = SIDE / skeleton.longest_side(name)?;
        Ok(Self { origin: skeleton.mean_joint(), scale, turn: None })
    }

    /// A caller's point in the normalised space.
    pub fn normalise(&self, p: DVec3) -> DVec3 {
        let scaled = (p - self.origin) * self.scale;
        self.turn.map_or(scaled, |turn| turn * scaled)
    }

    /// All of a caller's points in the normalised space.
    pub fn normalise_all(&self, points: &[DVec3]) -> Vec<DVec3> {
        points.iter().map(|&p| self.normalise(p)).collect()
    }

    /// A normalised point in the caller's space.
    pub fn restore(&self, p: DVec3) -> DVec3 {
        self.turned_back(p) / self.scale + self.origin
    }

    /// A normalised point before the turn.
    pub fn turned_back(&self, p: DVec3) -> DVec3 {
        self.turn.map_or(p, |turn| turn.conjugate() * p)
    }

    /// The same with the turn after which `skeleton`, which it is for, is nearest to `other`, which is normalised and has the same
    /// joints, where that is clear. A hat would stay as it is while the head in it turns.
    pub fn turned_to(self, other: &Skeleton, skeleton: &Skeleton) -> Self {
        let own = self.normalise_all(&skeleton.joints);
        let rotation = Similarity::nearest(&own, &other.joints, &vec![1.0; own.len()], None).rotation;
        let apart = |turn: DQuat| -> f64 {
            // Sizes need not agree, so they are fitted, too.
            let turned: Vec<DVec3> = own.iter().map(|&p| turn * p).collect();
            let dot: f64 = turned.iter().zip(&other.joints).map(|(p, q)| p.dot(*q)).sum();
            let square: f64 = turned.iter().map(|p| p.length_squared()).sum();
            let scale = if square > 0.0 { dot.max(0.0) / square } else { 1.0 };
            turned.iter().zip(&other.joints).map(|(&p, q)| (scale * p).distance_squared(*q)).sum::<f64>().sqrt()
        };
        let is_clear = turn::angle_apart(DQuat::IDENTITY, rotation) > LEAST_TURN
            && apart(rotation) < CLEARER * apart(DQuat::IDENTITY);
        Self { turn: is_clear.then_some(rotation), ..self }
    }
}
