//! A mesh that is turned against its skeleton by any angle, about one of the axes of coordinates.

use glam::{DQuat, DVec3};
use rayon::prelude::*;

use super::size::Surroundings;
use crate::geometry::turn;
use crate::maths;

/// Between the angles that are tried first, in degrees, and the steps that are tried after that.
const STEP: i32 = 15;
const FINER: [f64; 4] = [8.0, 4.0, 2.0, 1.0];
/// What a half turn costs, in the logarithm: a body that looks almost the same from behind has the smaller turn.
const HALF_TURN: f64 = 0.05;

/// A turn about an axis of coordinates, internal ones.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tilt {
    /// The axis: 0 for x.
    pub axis: usize,
    /// The angle, from -180 to 180.
    pub degrees: f64,
    /// What stays.
    pub centre: DVec3,
}

impl Tilt {
    fn rotation(&self) -> DQuat {
        turn::about(DVec3::AXES[self.axis] * self.degrees.to_radians())
    }

    /// The place of a point after it.
    pub fn apply(&self, p: DVec3) -> DVec3 {
        self.centre + self.rotation() * (p - self.centre)
    }

    /// Whether it may be the same for another mesh.
    pub fn is_like(&self, other: &Self) -> bool {
        self.axis == other.axis && (self.degrees - other.degrees).abs() <= f64::from(STEP)
    }

    /// The other way round.
    pub fn inverse(&self) -> Self {
        Self { degrees: -self.degrees, ..*self }
    }
}

/// The turn about one of `centres` after which a mesh lies nearest to its bones, and how many times nearer that is.
pub fn nearest(mesh: &Surroundings, centres: &[DVec3]) -> Option<(Tilt, f64)> {
    let now = mesh.cost_of_moved(|p| p);
    let cost = |tilt: &Tilt| {
        let (rotation, centre) = (tilt.rotation(), tilt.centre);
        mesh.cost_of_moved(|p| centre + rotation * (p - centre)) + HALF_TURN * tilt.degrees.abs() / 180.0
    };
    let angles = (1..360 / STEP).map(|k| f64::from(if k * STEP > 180 { k * STEP - 360 } else { k * STEP }));
    let all: Vec<Tilt> = angles
        .flat_map(|degrees| (0..3).map(move |axis| (axis, degrees)))
        .flat_map(|(axis, degrees)| centres.iter().map(move |&centre| Tilt { axis, degrees, centre }))
        .collect();
    let costs: Vec<f64> = all.par_iter().map(cost).collect();
    let (mut least, mut best) =
        all.iter().zip(costs).map(|(tilt, cost)| (cost, *tilt)).min_by(|a, b| a.0.total_cmp(&b.0))?;
    for step in FINER {
        for degrees in [best.degrees - step, best.degrees + step] {
            let tilt = Tilt { degrees, ..best };
            let own = cost(&tilt);
            if own < least {
                (least, best) = (own, tilt);
            }
        }
    }
    if best.degrees.abs() > 180.0 {
        best.degrees -= 360.0_f64.copysign(best.degrees);
    }
    now.is_finite().then(|| (best, maths::exp(now - least)))
}
