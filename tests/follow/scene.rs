//! Small surfaces that are moved.

use bespoke::follow::surface::MovedSurface;
use glam::{DAffine3, DQuat, DVec3};
use testing::Random;

/// A sheet of `n` by `n` squares of two triangles each, in the plane z = 0 from 0 to 1.
pub fn sheet(n: u32) -> (Vec<DVec3>, Vec<[u32; 3]>) {
    let side = 1.0 / f64::from(n);
    let points = (0..=n).flat_map(|j| (0..=n).map(move |i| DVec3::new(f64::from(i) * side, f64::from(j) * side, 0.0)));
    let at = |i: u32, j: u32| j * (n + 1) + i;
    let squares = (0..n).flat_map(|j| (0..n).map(move |i| (i, j)));
    let triangles = squares
        .flat_map(|(i, j)| [[at(i, j), at(i + 1, j), at(i + 1, j + 1)], [at(i, j), at(i + 1, j + 1), at(i, j + 1)]]);
    (points.collect(), triangles.collect())
}

/// The sheet with bumps, so that no two triangles lie alike.
pub fn bumpy(n: u32, random: &mut Random) -> (Vec<DVec3>, Vec<[u32; 3]>) {
    let (mut points, triangles) = sheet(n);
    points.iter_mut().for_each(|p| *p += 0.2 / f64::from(n) * random.vector());
    (points, triangles)
}

/// A rotation about any axis, a scale and a shift.
pub fn similarity(random: &mut Random, scale: f64) -> (DAffine3, DQuat) {
    let turn = DQuat::from_scaled_axis(2.0 * random.vector());
    (DAffine3::from_scale_rotation_translation(DVec3::splat(scale), turn, 3.0 * random.vector()), turn)
}

pub fn moved(points: &[DVec3], triangles: &[[u32; 3]], map: impl Fn(DVec3) -> DVec3) -> MovedSurface {
    MovedSurface::new(points.to_vec(), points.iter().map(|&p| map(p)).collect(), triangles.to_vec())
}
