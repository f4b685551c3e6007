//! Bodies to test on.

use bespoke::contact::{Avatar, Bodies, Garment, Surface};
use glam::DVec3;

use testing::Random;

/// A grid of `m` by `m` quads over the unit square, and its triangles.
pub fn grid(m: usize) -> (Vec<DVec3>, Vec<[u32; 3]>) {
    let positions =
        (0..=m).flat_map(|i| (0..=m).map(move |j| DVec3::new(i as f64, j as f64, 0.0) / m as f64)).collect();
    let triangles = (0..m * m)
        .flat_map(|q| {
            let a = (q / m * (m + 1) + q % m) as u32;
            let (b, c, d) = (a + 1, a + m as u32 + 1, a + m as u32 + 2);
            [[a, c, b], [b, c, d]]
        })
        .collect();
    (positions, triangles)
}

/// A sphere of radius 1 as rings of `m` vertices between two poles, and its triangles.
pub fn sphere(m: usize) -> (Vec<DVec3>, Vec<[u32; 3]>) {
    let rings = m / 2;
    let mut positions = vec![DVec3::Z];
    for i in 1..rings {
        let (s, c) = (std::f64::consts::PI * i as f64 / rings as f64).sin_cos();
        for j in 0..m {
            let (y, x) = (std::f64::consts::TAU * j as f64 / m as f64).sin_cos();
            positions.push(DVec3::new(s * x, s * y, c));
        }
    }
    positions.push(-DVec3::Z);
    let at = |i: usize, j: usize| (1 + (i - 1) * m + j % m) as u32;
    let last = positions.len() as u32 - 1;
    let mut triangles = Vec::new();
    for j in 0..m {
        triangles.push([0, at(1, j), at(1, j + 1)]);
        triangles.push([last, at(rings - 1, j + 1), at(rings - 1, j)]);
        for i in 1..rings - 1 {
            triangles.push([at(i, j), at(i + 1, j), at(i + 1, j + 1)]);
            triangles.push([at(i, j), at(i + 1, j + 1), at(i, j + 1)]);
        }
    }
    (positions, triangles)
}

/// Random triangles over random vertices, some degenerate, some repeated, some vertices unused.
pub fn soup(vertices: usize, triangles: usize, random: &mut Random) -> Surface {
    let mut pick = |n: usize| (random.unit() * n as f64) as u32;
    let mut list: Vec<[u32; 3]> = Vec::new();
    for k in 0..triangles {
        let near = pick(vertices - 5);
        let t = match k % 8 {
            0 => [near, near, near + 1],
            1 if k > 8 => list[k - 5],
            2 if k % 16 == 2 => [near, near, near],
            _ => [near + pick(5), near + pick(5), near + pick(5)],
        };
        list.push(t);
    }
    Surface::new(vertices, list)
}

/// A crumpled garment and an avatar that cross everything, with a step of the given length.
pub struct Scene {
    pub bodies: Bodies,
    pub x: Vec<DVec3>,
    pub dx: Vec<DVec3>,
}

impl Scene {
    pub fn random(seed: u64, motion: f64) -> Self {
        let mut random = Random::new(seed);
        let garment = soup(120, 160, &mut random);
        let avatar = soup(90, 110, &mut random);
        // Vertices with close numbers are close to each other, so that triangles are small.
        let along = |count: usize, random: &mut Random| -> Vec<DVec3> {
            let mut p = DVec3::ZERO;
            let mut step = || {
                p = 0.95 * p + 0.2 * random.vector();
                p
            };
            (0..count).map(|_| step()).collect()
        };
        let rest = along(120, &mut random);
        let start = along(90, &mut random);
        let x = rest.iter().map(|p| *p + 0.05 * random.vector()).collect();
        let dx = (0..120).map(|_| motion * random.vector()).collect();
        let moves = (0..90).map(|_| 0.3 * random.vector()).collect();
        let bodies = Bodies {
            garment: Garment { surface: garment, rest },
            avatar: Avatar { surface: avatar, start, motion: moves },
        };
        Self { bodies, x, dx }
    }
}
