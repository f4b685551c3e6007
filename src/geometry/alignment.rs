//! The similarity that takes one set of points nearest to another, in the sense of weighted squares.
//!
//! The rotation is found by turning towards the covariance matrix until no torque is left (Müller, Bender, Chentanez,
//! Macklin 2016, "A robust method to extract the rotational part of deformations"): it needs no decomposition, and never
//! answers with a reflection.

use glam::{DMat3, DQuat, DVec3};

use crate::geometry::turn;

/// Rounds of the search for the rotation, at most; a few suffice where points hardly turn.
const MAX_ROUNDS: usize = 100;
/// A turn below this, in radians, ends it.
const SMALL_TURN: f64 = 1e-13;

/// `p -> centre_to + scale rotation (p - centre_from)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Similarity {
    /// The weighted mean of the points.
    pub from: DVec3,
    /// The weighted mean of their images.
    pub to: DVec3,
    /// The rotation between them.
    pub rotation: DQuat,
    /// The scale, above 0.
    pub scale: f64,
}

impl Similarity {
    /// The similarity that takes `points` nearest to `images`, with `scale` where it is given. `weights` are not negative; all
    /// three have one length. Where points or images leave a rotation or scale open, it is that of the identity.
    pub fn nearest(points: &[DVec3], images: &[DVec3], weights: &[f64], scale: Option<f64>) -> Self {
        let total: f64 = weights.iter().sum();
        let mean = |p: &[DVec3]| {
            let sum = p.iter().zip(weights).map(|(&p, &w)| w * p).sum::<DVec3>();
            if total > 0.0 { sum / total } else { DVec3::ZERO }
        };
        let [from, to] = [mean(points), mean(images)];
        let (mut covariance, mut spread) = (DMat3::ZERO, 0.0);
        for ((&p, &q), &w) in points.iter().zip(images).zip(weights) {
            let (p, q) = (p - from, w * (q - to));
            covariance += DMat3::from_cols(q * p.x, q * p.y, q * p.z);
            spread += w * p.length_squared();
        }
        let rotation = rotation_of(&covariance);
        let scale = scale.unwrap_or_else(|| {
            let turned = DMat3::from_quat(rotation);
            let dot = (0..3).map(|k| turned.col(k).dot(covariance.col(k))).sum::<f64>();
            if spread > 0.0 && dot > 0.0 { dot / spread } else { 1.0 }
        });
        Self { from, to, rotation, scale }
    }

    /// The image of `p`.
    pub fn apply(&self, p: DVec3) -> DVec3 {
        self.to + self.scale * (self.rotation * (p - self.from))
    }
}

/// The rotation nearest to `a`, from the identity on.
fn rotation_of(a: &DMat3) -> DQuat {
    let mut rotation = DQuat::IDENTITY;
    for _ in 0..MAX_ROUNDS {
        let r = DMat3::from_quat(rotation);
        let torque: DVec3 = (0..3).map(|k| r.col(k).cross(a.col(k))).sum();
        let dot: f64 = (0..3).map(|k| r.col(k).dot(a.col(k))).sum();
        let turn = torque / (dot.abs() + f64::MIN_POSITIVE);
        // Beyond a radian the direction of the turn is right, its size is not.
        let turn = turn.clamp_length_max(1.0);
        if turn.length() <= SMALL_TURN || turn.is_nan() {
            break;
        }
        rotation = (turn::about(turn) * rotation).normalize();
    }
    rotation
}
