//! Solids as the zero set of a function: smooth unions of lofts and ellipsoids, and what is carved out of them.

use glam::{DMat3, DVec3};

use super::loft::Loft;

/// The shape of one primitive.
#[derive(Clone, Debug)]
pub enum Shape {
    /// Swept cross-sections.
    Loft(Loft),
    /// An ellipsoid with half-axes along the columns of a rotation.
    Ellipsoid {
        /// Centre.
        centre: DVec3,
        /// Half-axes in metres.
        radii: DVec3,
        /// From the ellipsoid's axes to the world's.
        rotation: DMat3,
    },
    /// All points below a horizontal plane.
    Below {
        /// Height of the plane.
        height: f64,
    },
}

impl Shape {
    /// An ellipsoid along the world's axes.
    pub fn ellipsoid(centre: DVec3, radii: DVec3) -> Self {
        Self::Ellipsoid { centre, radii, rotation: DMat3::IDENTITY }
    }

    /// A first-order estimate of the signed distance, negative inside.
    pub fn distance(&self, point: DVec3) -> f64 {
        match self {
            Self::Loft(loft) => loft.distance(point),
            Self::Ellipsoid { centre, radii, rotation } => {
                let local = rotation.transpose() * (point - *centre) / *radii;
                let k0 = local.length();
                let k1 = (local / *radii).length();
                if k1 < 1e-9 { -radii.min_element() } else { k0 * (k0 - 1.0) / k1 }
            }
            Self::Below { height } => point.z - height,
        }
    }

    /// A capsule around the shape: the two ends of its axis and its radius.
    fn bound(&self) -> ([DVec3; 2], f64) {
        match self {
            Self::Loft(loft) => loft.bound(),
            Self::Ellipsoid { centre, radii, .. } => ([*centre; 2], radii.max_element()),
            Self::Below { .. } => ([DVec3::ZERO; 2], f64::INFINITY),
        }
    }
}

/// Which joints move a primitive, for skin weights.
#[derive(Clone, Copy, Debug)]
pub enum Owner {
    /// One joint.
    Joint(usize),
    /// The first joint below a height, the second above, with a smooth passage between.
    Passage {
        /// The joint below and the joint above.
        joints: [usize; 2],
        /// Where both count the same.
        height: f64,
        /// Half the length of the passage.
        reach: f64,
    },
}

/// One primitive and how it joins those before it.
#[derive(Clone, Debug)]
pub struct Primitive {
    /// The shape.
    pub shape: Shape,
    /// Which joints move it.
    pub owner: Owner,
    blend: f64,
    carve: bool,
    start: DVec3,
    axis: DVec3,
    inverse_square: f64,
    radius: f64,
}

impl Primitive {
    /// The signed distance, never below that to the capsule around the shape, so that skipping far shapes is exact.
    pub fn distance(&self, point: DVec3) -> f64 {
        self.shape.distance(point).max(self.axis_distance_squared(point).sqrt() - self.radius)
    }

    /// True for a shape that is taken away.
    pub fn is_carved(&self) -> bool {
        self.carve
    }

    /// True if the distance is less than `limit`, perhaps also if it is not.
    fn may_be_closer(&self, point: DVec3, limit: f64) -> bool {
        let reach = limit + self.radius;
        reach > 0.0 && self.axis_distance_squared(point) < reach * reach
    }

    fn axis_distance_squared(&self, point: DVec3) -> f64 {
        let d = point - self.start;
        let t = (d.dot(self.axis) * self.inverse_square).clamp(0.0, 1.0);
        (d - t * self.axis).length_squared()
    }
}

/// Values up to this distance (metres) from the solid are right; farther away they may be too large.
pub const REACH: f64 = 0.07;

/// A solid: negative inside, positive outside, about the distance near its surface.
#[derive(Clone, Debug, Default)]
pub struct Field {
    primitives: Vec<Primitive>,
    cells: Cells,
}

/// A grid that knows for each cell the primitives that matter in it.
#[derive(Clone, Debug, Default)]
struct Cells {
    low: DVec3,
    count: [usize; 3],
    first: Vec<u32>,
    primitives: Vec<u16>,
}

impl Cells {
    const SIDE: f64 = 0.05;

    fn new(primitives: &[Primitive], [low, high]: [DVec3; 2]) -> Self {
        let blend = primitives.iter().map(|part| part.blend).fold(0.0, f64::max);
        let limit = 0.5 * 3f64.sqrt() * Self::SIDE + REACH + blend;
        let count = ((high - low) / Self::SIDE).ceil().to_array().map(|n| n as usize);
        let mut cells = Self { low, count, first: vec![0], primitives: Vec::new() };
        for index in 0..count.iter().product() {
            let [i, j, k] = [index % count[0], index / count[0] % count[1], index / count[0] / count[1]];
            let middle = low + Self::SIDE * (DVec3::new(i as f64, j as f64, k as f64) + 0.5);
            let near = (0u16..).zip(primitives).filter(|(_, part)| part.may_be_closer(middle, limit));
            cells.primitives.extend(near.map(|(number, _)| number));
            cells.first.push(cells.primitives.len() as u32);
        }
        cells
    }

    /// The primitives around a point; none outside the grid.
    fn around(&self, point: DVec3) -> &[u16] {
        let p = (point - self.low) / Self::SIDE;
        let [i, j, k] = p.to_array().map(|x| if x < 0.0 { usize::MAX } else { x as usize });
        if i >= self.count[0] || j >= self.count[1] || k >= self.count[2] {
            return &[];
        }
        let cell = i + self.count[0] * (j + self.count[1] * k);
        &self.primitives[self.first[cell] as usize..self.first[cell + 1] as usize]
    }
}

impl Field {
    /// Joins a shape, rounding the seam over about `blend` metres.
    pub fn add(&mut self, shape: Shape, blend: f64, owner: Owner) {
        self.push(shape, blend, owner, false);
    }

    /// Takes a shape away, rounding the rim over about `blend` metres.
    pub fn carve(&mut self, shape: Shape, blend: f64, owner: Owner) {
        self.push(shape, blend, owner, true);
    }

    fn push(&mut self, shape: Shape, blend: f64, owner: Owner, carve: bool) {
        let ([start, end], radius) = shape.bound();
        let axis = end - start;
        let inverse_square = if start == end { 0.0 } else { axis.length_squared().recip() };
        self.primitives.push(Primitive { shape, owner, blend, carve, start, axis, inverse_square, radius });
    }

    /// The parts, in the order in which they were added.
    pub fn primitives(&self) -> &[Primitive] {
        &self.primitives
    }

    /// The corners of a box around the solid.
    pub fn bounds(&self) -> [DVec3; 2] {
        let mut bounds = [DVec3::INFINITY, DVec3::NEG_INFINITY];
        for part in self.primitives.iter().filter(|part| !part.carve) {
            for end in [part.start, part.start + part.axis] {
                bounds = [bounds[0].min(end - part.radius), bounds[1].max(end + part.radius)];
            }
        }
        bounds
    }

    /// Sorts the parts into cells: to be called when the last one is in.
    pub fn finish(mut self) -> Self {
        let [low, high] = self.bounds();
        self.cells = Cells::new(&self.primitives, [low - REACH, high + REACH]);
        self
    }

    /// The value at a point, right up to [`REACH`] from the solid, after [`Field::finish`].
    pub fn value(&self, point: DVec3) -> f64 {
        let mut value = f64::MAX;
        for &number in self.cells.around(point) {
            let part = &self.primitives[number as usize];
            if part.carve {
                if part.may_be_closer(point, part.blend - value) {
                    value = -smooth_min(-value, part.distance(point), part.blend);
                }
            } else if part.may_be_closer(point, value + part.blend) {
                value = smooth_min(value, part.distance(point), part.blend);
            }
        }
        value
    }
}

/// The minimum, rounded where the two differ by less than `blend`: quadratic, exact elsewhere.
pub fn smooth_min(a: f64, b: f64, blend: f64) -> f64 {
    let h = (blend - (a - b).abs()).max(0.0);
    if h == 0.0 { a.min(b) } else { a.min(b) - 0.25 * h * h / blend }
}

/// The value and the gradient of any function, by differences over 0.02 mm.
pub fn value_and_gradient(function: &dyn Fn(DVec3) -> f64, point: DVec3) -> (f64, DVec3) {
    const STEP: f64 = 2e-5;
    let value = function(point);
    let along = |axis: DVec3| (function(point + STEP * axis) - value) / STEP;
    (value, DVec3::new(along(DVec3::X), along(DVec3::Y), along(DVec3::Z)))
}
