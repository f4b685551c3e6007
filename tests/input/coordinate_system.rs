//! Axes, units and winding.

use bespoke::error::ErrorKind;
use bespoke::input::coordinate_system::{Axis, CoordinateSystem, Winding};
use glam::DVec3;

use testing::Random;

const AXES: [(Axis, DVec3); 6] = [
    (Axis::PositiveX, DVec3::X),
    (Axis::NegativeX, DVec3::NEG_X),
    (Axis::PositiveY, DVec3::Y),
    (Axis::NegativeY, DVec3::NEG_Y),
    (Axis::PositiveZ, DVec3::Z),
    (Axis::NegativeZ, DVec3::NEG_Z),
];

/// Whether the conversion to the internal coordinate system is a reflection of coordinates.
fn is_left_handed(system: &CoordinateSystem) -> bool {
    let [x, y, z] = DVec3::AXES.map(|axis| system.position_to_internal(axis));
    x.cross(y).dot(z) < 0.0
}

#[test]
fn every_choice_of_axes() {
    let mut random = Random::new(4);
    let (mut good, mut left) = (0, 0);
    for (right, r) in AXES {
        for (up, u) in AXES {
            for (forward, f) in AXES {
                let system = CoordinateSystem { right, up, forward, ..CoordinateSystem::default() };
                let perpendicular = r.dot(u) == 0.0 && r.dot(f) == 0.0 && u.dot(f) == 0.0;
                assert_eq!(system.check("target coordinate system").is_ok(), perpendicular);
                if !perpendicular {
                    continue;
                }
                good += 1;
                left += usize::from(is_left_handed(&system));
                assert_eq!(is_left_handed(&system), r.cross(u).dot(-f) < 0.0);
                assert_eq!(system.position_to_internal(r), DVec3::X);
                assert_eq!(system.position_to_internal(u), DVec3::Y);
                assert_eq!(system.position_to_internal(f), DVec3::NEG_Z);
                let p = random.vector();
                assert_eq!(system.position_from_internal(system.position_to_internal(p)), p);
            }
        }
    }
    assert_eq!((good, left), (48, 24));
}

#[test]
fn default_is_the_identity() {
    let system = CoordinateSystem::default();
    let p = DVec3::new(0.1, -2.0, 1e-9);
    assert_eq!((system.position_to_internal(p), system.position_from_internal(p)), (p, p));
    assert_eq!(system.triangle([4, 5, 6]), [4, 5, 6]);
    assert!(!is_left_handed(&system));
}

#[test]
fn units() {
    let mut random = Random::new(6);
    let centimetres = CoordinateSystem { metres_per_unit: 0.01, ..CoordinateSystem::default() };
    assert_eq!(centimetres.position_to_internal(DVec3::new(100.0, 200.0, -300.0)), DVec3::new(1.0, 2.0, -3.0));
    for _ in 0..1000 {
        let p = random.vector() * 100.0;
        let back = centimetres.position_from_internal(centimetres.position_to_internal(p));
        assert!((back - p).abs().max_element() <= 2e-16 * 100.0);
    }
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e-12] {
        let error = CoordinateSystem { metres_per_unit: bad, ..CoordinateSystem::default() }
            .check("target coordinate system")
            .unwrap_err();
        assert_eq!(error.kind, ErrorKind::InvalidArgument);
        assert!(error.message.starts_with("target coordinate system: the unit is"), "{error}");
    }
    let flat = CoordinateSystem { up: Axis::NegativeX, ..CoordinateSystem::default() }
        .check("target coordinate system")
        .unwrap_err();
    assert_eq!(
        flat.message,
        "target coordinate system: right is +x and up is -x, the axes must be perpendicular to each other"
    );
}

#[test]
fn front_faces_face_the_viewer() {
    // A triangle in front of a viewer who looks forward, its corners low left, high left, high right: clockwise.
    for (right, r) in AXES {
        for (up, u) in AXES {
            for (forward, f) in AXES {
                let system =
                    CoordinateSystem { right, up, forward, winding: Winding::Clockwise, ..CoordinateSystem::default() };
                if system.check("system").is_err() {
                    continue;
                }
                let seen = [f, f + u, f + u + r].map(|p| system.position_to_internal(p));
                let [a, b, c] = system.triangle([0, 1, 2]).map(|v| seen[v as usize]);
                // In ours the normal of a front face points back to the viewer, +z.
                assert_eq!((b - a).cross(c - a), DVec3::Z);
                assert_eq!(system.triangle(system.triangle([7, 8, 9])), [7, 8, 9]);
            }
        }
    }
}
