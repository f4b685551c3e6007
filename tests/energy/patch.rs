//! Small garments with their hinges, and deformations of them.

use std::collections::BTreeMap;

use bespoke::geometry::mesh::Hinge;
use glam::{DMat3, DQuat, DVec3};

use testing::Random;

/// A triangle mesh with its connectivity.
pub struct Patch {
    pub rest: Vec<DVec3>,
    pub hinges: Vec<Hinge>,
}

/// Triangles of a grid of `columns` by `rows` vertices; the columns may wrap around.
pub fn triangles(columns: u32, rows: u32, wraps: bool) -> Vec<[u32; 3]> {
    let across = if wraps { columns } else { columns - 1 };
    let cell = |j: u32, i: u32| {
        let (a, b) = (j * columns + i, j * columns + (i + 1) % columns);
        let (c, d) = (a + columns, b + columns);
        if (i + j).is_multiple_of(2) { [[a, b, d], [a, d, c]] } else { [[a, b, c], [b, d, c]] }
    };
    (0..rows - 1).flat_map(|j| (0..across).flat_map(move |i| cell(j, i))).collect()
}

fn hinges(triangles: &[[u32; 3]]) -> Vec<Hinge> {
    let mut half_edges = BTreeMap::new();
    for (index, t) in triangles.iter().enumerate() {
        for k in 0..3 {
            half_edges.insert((t[k], t[(k + 1) % 3]), (t[(k + 2) % 3], index as u32));
        }
    }
    let over = |(&(a, b), &(c, t1)): (&(u32, u32), &(u32, u32))| {
        let &(d, t2) = half_edges.get(&(b, a)).filter(|_| a < b)?;
        Some(Hinge { vertices: [a, b, c, d], triangles: [t1, t2] })
    };
    half_edges.iter().filter_map(over).collect()
}

/// A bent, uneven sheet.
pub fn sheet(columns: u32, rows: u32, random: &mut Random) -> Patch {
    let at = |k: u32| DVec3::new(f64::from(k % columns), f64::from(k / columns), 0.0);
    let rest = (0..columns * rows).map(|k| at(k) + 0.3 * random.vector()).collect();
    Patch { rest, hinges: hinges(&triangles(columns, rows, false)) }
}

/// An uneven tube along z, open at both ends.
pub fn tube(columns: u32, rows: u32, random: &mut Random) -> Patch {
    let at = |k: u32| {
        let angle = std::f64::consts::TAU * f64::from(k % columns) / f64::from(columns);
        DVec3::new(angle.cos(), angle.sin(), 0.6 * f64::from(k / columns))
    };
    let rest = (0..columns * rows).map(|k| at(k) + 0.15 * random.vector()).collect();
    Patch { rest, hinges: hinges(&triangles(columns, rows, true)) }
}

/// The points, each moved by up to `amount`.
pub fn shaken(points: &[DVec3], amount: f64, random: &mut Random) -> Vec<DVec3> {
    points.iter().map(|&p| p + amount * random.vector()).collect()
}

/// A random rotation.
pub fn rotation(random: &mut Random) -> DMat3 {
    let axis = (random.vector() + DVec3::splat(1e-3)).normalize();
    DMat3::from_quat(DQuat::from_axis_angle(axis, 3.0 * random.signed()))
}

/// The points, turned and scaled and moved at random, with this scale.
pub fn similar(points: &[DVec3], scale: f64, random: &mut Random) -> Vec<DVec3> {
    let (turn, shift) = (rotation(random), random.vector());
    points.iter().map(|&p| turn * (p * scale) + shift).collect()
}
