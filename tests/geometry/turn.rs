//! Angles and rotations against glam's.

use bespoke::geometry::turn;
use glam::{DQuat, DVec3};
use std::f64::consts::PI;

/// Directions and turns of all kinds.
fn turns() -> Vec<DQuat> {
    let axes = [DVec3::X, DVec3::new(1.0, -2.0, 0.5), DVec3::new(-0.1, 0.3, -4.0)].map(DVec3::normalize);
    let angles = [0.0, 1e-9, 0.3, 1.5, PI, 4.0, -2.0];
    axes.iter().flat_map(|&axis| angles.map(|angle| DQuat::from_axis_angle(axis, angle))).collect()
}

#[test]
fn angles_are_those_of_glam() {
    for (k, a) in turns().into_iter().enumerate() {
        assert!((turn::angle(a) - a.to_axis_angle().1).abs() < 1e-7, "turn {k}");
        for b in turns() {
            assert!((turn::angle_apart(a, b) - a.angle_between(b)).abs() < 1e-12, "turn {k}");
            let (from, to) = (a * DVec3::Y, b * DVec3::new(3.0, -1.0, 2.0));
            assert!((turn::angle_between(from, to) - from.angle_between(to)).abs() < 1e-12, "turn {k}");
        }
    }
}

#[test]
fn rotations_are_those_of_glam() {
    for a in turns() {
        let axis = a * DVec3::new(0.4, -1.1, 0.2);
        assert!(turn::about(axis).abs_diff_eq(DQuat::from_scaled_axis(axis), 1e-15));
        for b in turns() {
            let (from, to) = (a * DVec3::Y, b * DVec3::Y);
            assert!((turn::arc(from, to) * from).abs_diff_eq(to, 1e-8), "from {from} to {to}");
            for share in [0.0, 0.3, 1.0] {
                // Half a turn apart there are two ways, and either will do.
                if a.dot(b).abs() > 1e-9 {
                    assert!(turn::between(a, b, share).abs_diff_eq(a.slerp(b, share), 1e-9), "from {a} to {b}");
                }
            }
        }
    }
    assert_eq!(turn::about(DVec3::ZERO), DQuat::IDENTITY);
}

#[test]
fn opposite_directions_have_half_a_turn() {
    for from in [DVec3::X, DVec3::Y, DVec3::new(1.0, 2.0, -0.5).normalize()] {
        let half = turn::arc(from, -from);
        assert!(half.is_normalized() && (half * from).abs_diff_eq(-from, 1e-12), "from {from}");
    }
}
