//! Angles and rotations, with the same bits on every system: glam's own ask the system for sines.

use glam::{DQuat, DVec3};

use crate::maths;

/// Beyond this cosine two rotations are as good as one, and what is between them is a straight line.
const SAME: f64 = 1.0 - f64::EPSILON;

/// The angle between two directions in radians, from 0 to pi. Neither may be zero.
pub fn angle_between(a: DVec3, b: DVec3) -> f64 {
    maths::acos((a.dot(b) / (a.length_squared() * b.length_squared()).sqrt()).clamp(-1.0, 1.0))
}

/// The angle of a rotation in radians, from 0 to 2 pi.
pub fn angle(turn: DQuat) -> f64 {
    2.0 * maths::atan2(turn.xyz().length(), turn.w)
}

/// The smallest angle of a rotation that leads from `a` to `b`, in radians. Both are of unit length.
pub fn angle_apart(a: DQuat, b: DQuat) -> f64 {
    2.0 * maths::acos(a.dot(b).abs().min(1.0))
}

/// The rotation about the direction of `axis` by its length in radians.
pub fn about(axis: DVec3) -> DQuat {
    let length = axis.length();
    if length == 0.0 {
        return DQuat::IDENTITY;
    }
    let (sine, cosine) = maths::sin_cos(0.5 * length);
    let axis = axis / length * sine;
    DQuat::from_xyzw(axis.x, axis.y, axis.z, cosine)
}

/// The smallest rotation that takes `from` to `to`, both of unit length; where they are opposite, about any axis across.
pub fn arc(from: DVec3, to: DVec3) -> DQuat {
    let dot = from.dot(to);
    if dot.abs() <= 1.0 - 2.0 * f64::EPSILON {
        let axis = from.cross(to);
        return DQuat::from_xyzw(axis.x, axis.y, axis.z, 1.0 + dot).normalize();
    }
    if dot > 0.0 {
        return DQuat::IDENTITY;
    }
    let axis = from.any_orthonormal_vector();
    DQuat::from_xyzw(axis.x, axis.y, axis.z, 0.0)
}

/// The rotation at `share` of the shorter way from `from` to `to`, both of unit length, at even speed.
pub fn between(from: DQuat, to: DQuat, share: f64) -> DQuat {
    let to = if from.dot(to) < 0.0 { -to } else { to };
    let dot = from.dot(to);
    if dot > SAME {
        return (from + (to - from) * share).normalize();
    }
    let angle = maths::acos(dot);
    let [start, end] = [(1.0 - share) * angle, share * angle].map(maths::sin);
    (from * start + to * end) * (1.0 / maths::sin(angle))
}
