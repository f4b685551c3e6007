//! Grids of offsets, and a uniform-grid neighbour search among them.

use glam::{DVec3, IVec3};

use crate::maths;

/// The offsets in a plane of two axes up to `radius`, `spacing` apart, the shortest first; at most `count`.
pub fn disc(radius: f64, spacing: f64, count: usize, [u, v]: [DVec3; 2]) -> Vec<DVec3> {
    // Only as far as the count can reach: a disc of n points has the radius sqrt(n / pi).
    let reach = (radius / spacing).min((count as f64).sqrt()) as i32;
    let points = (-reach..=reach).flat_map(|i| (-reach..=reach).map(move |j| IVec3::new(i, j, 0)));
    shortest(points, radius / spacing, count, |p| spacing * (f64::from(p.x) * u + f64::from(p.y) * v))
}

/// The offsets up to `radius`, `spacing` apart, the shortest first; at most `count`.
pub fn ball(radius: f64, spacing: f64, count: usize) -> Vec<DVec3> {
    let reach = (radius / spacing).min(maths::cbrt(count as f64)) as i32;
    let row = move || -reach..=reach;
    let points = row().flat_map(move |i| row().flat_map(move |j| row().map(move |k| IVec3::new(i, j, k))));
    shortest(points, radius / spacing, count, |p| spacing * p.as_dvec3())
}

fn shortest(
    points: impl Iterator<Item = IVec3>,
    reach: f64,
    count: usize,
    offset: impl Fn(IVec3) -> DVec3,
) -> Vec<DVec3> {
    let mut inside: Vec<IVec3> = points.filter(|p| f64::from(p.length_squared()) <= reach * reach).collect();
    inside.sort_by_key(|p| (p.length_squared(), p.x, p.y, p.z));
    inside.truncate(count.max(1));
    inside.into_iter().map(offset).collect()
}

/// Offsets sorted into the cubes of a uniform grid, for neighbour search.
pub struct UniformGrid {
    low: DVec3,
    size: f64,
    counts: [usize; 3],
    /// First entry of each cube in `items`, and one more.
    first: Vec<u32>,
    items: Vec<u32>,
}

impl UniformGrid {
    /// Sorts `offsets` into cubes of `size`.
    pub fn new(offsets: &[DVec3], size: f64) -> Self {
        let low = offsets.iter().copied().fold(DVec3::ZERO, DVec3::min);
        let high = offsets.iter().copied().fold(DVec3::ZERO, DVec3::max);
        let counts = ((high - low) / size).to_array().map(|n| n as usize + 1);
        let mut grid =
            Self { low, size, counts, first: vec![0; counts.iter().product::<usize>() + 1], items: Vec::new() };
        let mut order: Vec<(usize, u32)> =
            offsets.iter().zip(0..).map(|(&o, i)| (grid.index(grid.cell(o)), i)).collect();
        order.sort_unstable();
        for &(cell, _) in &order {
            grid.first[cell + 1] += 1;
        }
        for cell in 1..grid.first.len() {
            grid.first[cell] += grid.first[cell - 1];
        }
        grid.items = order.into_iter().map(|(_, i)| i).collect();
        grid
    }

    fn cell(&self, offset: DVec3) -> [i64; 3] {
        ((offset - self.low) / self.size).to_array().map(|x| x.floor() as i64)
    }

    fn index(&self, cell: [i64; 3]) -> usize {
        let [x, y, z] = cell.map(|c| c as usize);
        (z * self.counts[1] + y) * self.counts[0] + x
    }

    /// Calls `visit` with each offset within one cube's size of `offset`, and with some that are further away.
    pub fn for_each_near(&self, offset: DVec3, mut visit: impl FnMut(usize)) {
        let centre = self.cell(offset);
        let range = |axis: usize| (centre[axis] - 1).max(0)..=(centre[axis] + 1).min(self.counts[axis] as i64 - 1);
        for z in range(2) {
            for y in range(1) {
                for x in range(0) {
                    let cell = self.index([x, y, z]);
                    for &item in &self.items[self.first[cell] as usize..self.first[cell + 1] as usize] {
                        visit(item as usize);
                    }
                }
            }
        }
    }
}
