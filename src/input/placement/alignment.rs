//! The best turn from one skeleton to another, of those that map axes onto axes.
//!
//! A body that is turned by up to 45 degrees from one of these finds its way by itself as it grows, and takes along what is around
//! its limbs. By a half turn it does not: half-way all of it would lie in one plane.

use glam::DVec3;

use crate::input::coordinate_system::AxisTurn;
use crate::input::skeleton::Skeleton;

/// A turn counts where it leaves at most this share of the distance between the joints ...
const CLEARER: f64 = 0.75;
/// ... and where without it this much is left, in units of the skeleton's radius.
const APART: f64 = 0.3;

/// How far the joints of two skeletons are apart, each moved and scaled onto the other: root mean squares, in units of the
/// skeleton's radius of gyration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Alignment {
    /// The turn of the target after which they are nearest.
    pub turn: AxisTurn,
    /// Their distance after it.
    pub turned: f64,
    /// Their distance without it.
    pub as_given: f64,
}

impl Alignment {
    /// Of `target` to `source`, which have the same joints.
    pub fn between(source: &Skeleton, target: &Skeleton) -> Self {
        let (s, t) = (normalised(&source.joints), normalised(&target.joints));
        let apart = |turn: &AxisTurn| {
            let square: f64 = s.iter().zip(&t).map(|(&a, &b)| a.distance_squared(turn.apply(b))).sum();
            (square / s.len().max(1) as f64).sqrt()
        };
        let as_given = apart(&AxisTurn::IDENTITY);
        let mut best = (AxisTurn::IDENTITY, as_given);
        for turn in AxisTurn::rotations() {
            let distance = apart(&turn);
            // Of two that are as good, as for a skeleton on a line, the smaller.
            if distance < best.1 - 1e-6 {
                best = (turn, distance);
            }
        }
        Self { turn: best.0, turned: best.1, as_given }
    }

    /// The turn, where it brings the skeletons much nearer to each other.
    pub fn turn_if_clear(&self) -> AxisTurn {
        let is_clear = self.as_given > APART && self.turned < CLEARER * self.as_given;
        if is_clear { self.turn } else { AxisTurn::IDENTITY }
    }
}

/// The joints with their mean at 0 and a radius of gyration of 1.
pub fn normalised(joints: &[DVec3]) -> Vec<DVec3> {
    let (mean, scale) = normalisation(joints);
    joints.iter().map(|&p| (p - mean) * scale).collect()
}

/// The mean of the joints, and one over their radius of gyration, 0 where they are in one place.
pub fn normalisation(joints: &[DVec3]) -> (DVec3, f64) {
    let count = joints.len().max(1) as f64;
    let mean = joints.iter().sum::<DVec3>() / count;
    let radius = (joints.iter().map(|p| p.distance_squared(mean)).sum::<f64>() / count).sqrt();
    (mean, if radius > 0.0 { radius.recip() } else { 0.0 })
}
