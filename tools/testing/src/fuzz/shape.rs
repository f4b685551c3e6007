//! Small garments, bodies and skeletons, good and bad.

use std::f64::consts::TAU;

use super::source::Source;

/// Points and triangles as flat lists.
#[derive(Clone, Default)]
pub struct Shape {
    pub points: Vec<f64>,
    pub triangles: Vec<u32>,
}

impl Shape {
    /// A tube about the z axis through `rings` rings of `sides` vertices, open or with its ends closed. The radius at
    /// each height, and the place of the middle, are the caller's.
    pub fn tube(
        rings: usize,
        sides: usize,
        [low, high]: [f64; 2],
        is_closed: bool,
        mut radius: impl FnMut(f64) -> f64,
        middle: impl Fn(f64) -> [f64; 2],
    ) -> Self {
        let mut shape = Self::default();
        for ring in 0..rings {
            let z = low + (high - low) * ring as f64 / (rings - 1) as f64;
            let [x, y] = middle(z);
            for side in 0..sides {
                let (sin, cos) = (TAU * side as f64 / sides as f64).sin_cos();
                let r = radius(z);
                shape.points.extend([x + r * cos, y + r * sin, z]);
            }
        }
        let at = |ring: usize, side: usize| (ring * sides + side % sides) as u32;
        for ring in 0..rings - 1 {
            for side in 0..sides {
                let [a, b] = [at(ring, side), at(ring, side + 1)];
                let [c, d] = [at(ring + 1, side), at(ring + 1, side + 1)];
                shape.triangles.extend([a, b, d, a, d, c]);
            }
        }
        if is_closed {
            for (ring, z) in [(0, low), (rings - 1, high)] {
                let tip = (shape.points.len() / 3) as u32;
                let [x, y] = middle(z);
                shape.points.extend([x, y, z]);
                for side in 0..sides {
                    let [a, b] = [at(ring, side), at(ring, side + 1)];
                    shape.triangles.extend(if ring == 0 { [b, a, tip] } else { [a, b, tip] });
                }
            }
        }
        shape
    }

    pub fn vertex_count(&self) -> usize {
        self.points.len() / 3
    }

    /// `other` beside it, as one mesh.
    pub fn join(&mut self, other: &Self) {
        let first = self.vertex_count() as u32;
        self.points.extend(&other.points);
        self.triangles.extend(other.triangles.iter().map(|v| v + first));
    }

    pub fn scale(&mut self, factor: f64, away: [f64; 3]) {
        self.points.iter_mut().enumerate().for_each(|(k, x)| *x = factor * *x + away[k % 3]);
    }

    /// Every triangle with corners of its own, as at the seams of a game's mesh.
    pub fn split(&self) -> Self {
        // A corner out of range, which `damage` makes too, ends up in the middle.
        let corner = |&v: &u32| (0..3).map(move |k| self.points.get(3 * v as usize + k).copied().unwrap_or_default());
        Self {
            points: self.triangles.iter().flat_map(corner).collect(),
            triangles: (0..self.triangles.len() as u32).collect(),
        }
    }

    /// One thing of many that an artist or a defect does to a mesh.
    pub fn damage(&mut self, source: &mut Source) {
        if self.points.is_empty() || self.triangles.is_empty() {
            return;
        }
        let vertex = usize::from(source.byte()) % self.vertex_count();
        let triangle = usize::from(source.byte()) % (self.triangles.len() / 3);
        let own = [0, 1, 2].map(|k| self.triangles[3 * triangle + k]);
        match source.below(12) {
            0 => (0..3).for_each(|k| self.points[3 * vertex + k] += 0.3 * source.signed()),
            1 => self.points[3 * vertex + source.below(3)] = source.number(),
            2 => self.triangles[3 * triangle + source.below(3)] = vertex as u32,
            3 => self.triangles[3 * triangle] = source.u32(),
            4 => self.triangles.extend(own),
            5 => self.triangles.extend([own[1], own[0], own[2]]),
            6 => self.triangles.extend([own[0], own[1], vertex as u32]),
            7 => self.triangles.extend([own[0], own[0], own[1]]),
            8 => drop(self.triangles.drain(3 * triangle..3 * triangle + 3)),
            9 => self.points.extend([source.number(), source.number(), source.number()]),
            10 => {
                let other = own[source.below(3)] as usize % self.vertex_count();
                (0..3).for_each(|k| self.points[3 * vertex + k] = self.points[3 * other + k]);
            }
            _ => *self = self.split(),
        }
    }
}

/// Joints in a row along z, from -1 to 1, with bends.
pub fn joints(count: usize, mut bend: impl FnMut() -> f64) -> Vec<f64> {
    (0..count).flat_map(|k| [bend(), bend(), 2.0 * k as f64 / (count - 1) as f64 - 1.0]).collect()
}

/// The bones of joints in a row.
pub fn bones(joints: usize) -> Vec<u32> {
    (1..joints as u32).flat_map(|k| [k - 1, k]).collect()
}
