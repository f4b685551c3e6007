//! How triangles move: against the gradient that their corners say, and means of motions.

use bespoke::geometry::triangle_motion::TriangleMotion;
use glam::{DMat3, DQuat, DVec3};
use testing::Random;

fn triangle(random: &mut Random) -> [DVec3; 3] {
    [(); 3].map(|()| random.vector())
}

#[test]
fn the_gradient_takes_sides_to_sides() {
    let mut random = Random::new(1);
    for _ in 0..200 {
        let ([a, b, c], [p, q, r]) = (triangle(&mut random), triangle(&mut random));
        let motion = TriangleMotion::between([a, b, c], [p, q, r]).unwrap();
        let gradient = motion.gradient();
        let size = gradient.to_cols_array().into_iter().fold(1.0f64, |m, x| m.max(x.abs()));
        assert!((gradient * (b - a)).distance(q - p) < 1e-11 * size);
        assert!((gradient * (c - a)).distance(r - p) < 1e-11 * size);
        // Across, by the root of the areas' ratio.
        let (n, m) = ((b - a).cross(c - a), (q - p).cross(r - p));
        let across = m.normalize() * (m.length() / n.length()).sqrt();
        assert!((gradient * n.normalize()).distance(across) < 1e-11 * size);
        let rotation = motion.rotation;
        assert!((rotation * rotation.transpose() - DMat3::IDENTITY).to_cols_array().iter().all(|x| x.abs() < 1e-12));
        assert!((rotation.determinant() - 1.0).abs() < 1e-12);
        let stretch = motion.stretch;
        assert!((stretch - stretch.transpose()).to_cols_array().iter().all(|x| x.abs() < 1e-11 * size));
        assert!([DVec3::X, DVec3::Y, DVec3::Z].iter().all(|&v| v.dot(stretch * v) > 0.0));
        // Its normal stays one.
        assert!(motion.of_normal(n).normalize().distance(m.normalize()) < 1e-9 * size);
    }
}

#[test]
fn a_similarity_is_one_of_space() {
    let mut random = Random::new(2);
    for _ in 0..100 {
        let corners = triangle(&mut random);
        let turn = DQuat::from_scaled_axis(3.0 * random.vector());
        let motion = TriangleMotion::between(corners, corners.map(|p| 2.5 * (turn * p) + DVec3::X)).unwrap();
        let off = motion.gradient() - 2.5 * DMat3::from_quat(turn);
        assert!(off.to_cols_array().iter().all(|x| x.abs() < 1e-11), "{off}");
    }
}

#[test]
fn a_mean_of_turns_keeps_its_size() {
    let turns = [-0.6f64, 0.6].map(|angle| TriangleMotion {
        rotation: DMat3::from_rotation_x(angle),
        stretch: DMat3::from_diagonal(DVec3::splat(2.0)),
    });
    let mean = TriangleMotion::mean(turns.iter().map(|&turn| (1.0, turn))).unwrap();
    assert!((mean.gradient() - 2.0 * DMat3::IDENTITY).to_cols_array().iter().all(|x| x.abs() < 1e-12));
    // Opposite turns have no mean: the heavier one counts.
    let half = TriangleMotion { rotation: DMat3::from_rotation_x(std::f64::consts::PI), ..turns[0] };
    let opposite = [(1.0, TriangleMotion::scale(1.0)), (1.0 + 1e-9, half)];
    assert_eq!(TriangleMotion::mean(opposite.into_iter()).unwrap().rotation, half.rotation);
    assert_eq!(TriangleMotion::mean(opposite.into_iter().map(|(_, motion)| (0.0, motion))), None);
    assert_eq!(TriangleMotion::mean(std::iter::empty()), None);
}

#[test]
fn what_has_no_area_has_no_motion() {
    let good = [DVec3::ZERO, DVec3::X, DVec3::Y];
    for bad in
        [[DVec3::ZERO; 3], [DVec3::ZERO, DVec3::X, 2.0 * DVec3::X], [DVec3::ZERO, DVec3::X, DVec3::splat(f64::NAN)]]
    {
        assert_eq!(TriangleMotion::between(good, bad), None);
        assert_eq!(TriangleMotion::between(bad, good), None);
    }
}
