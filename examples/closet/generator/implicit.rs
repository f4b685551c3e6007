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

    fn bound(&self) -> (DVec3, f64) {
        match self {
            Self::Loft(loft) => loft.bound(),
            Self::Ellipsoid { centre, radii, .. } => (*centre, radii.max_element()),
            Self::Below { .. } => (DVec3::ZERO, f64::INFINITY),
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
    centre: DVec3,
    radius: f64,
}

impl Primitive {
    /// The signed distance, never below that to the ball around the shape, so that skipping far shapes is exact.
    pub fn distance(&self, point: DVec3) -> f64 {
        self.shape.distance(point).max(self.beyond_ball(point))
    }

    /// True for a shape that is taken away.
    pub fn is_carved(&self) -> bool {
        self.carve
    }

    fn beyond_ball(&self, point: DVec3) -> f64 {
        point.distance(self.centre) - self.radius
    }
}

/// A solid: negative inside, positive outside, about the distance near its surface.
#[derive(Clone, Debug, Default)]
pub struct Field {
    primitives: Vec<Primitive>,
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
        let (centre, radius) = shape.bound();
        self.primitives.push(Primitive { shape, owner, blend, carve, centre, radius });
    }

    /// The parts, in the order in which they were added.
    pub fn primitives(&self) -> &[Primitive] {
        &self.primitives
    }

    /// The corners of a box around the solid.
    pub fn bounds(&self) -> [DVec3; 2] {
        self.primitives
            .iter()
            .filter(|part| !part.carve)
            .fold([DVec3::INFINITY, DVec3::NEG_INFINITY], |[low, high], part| {
                [low.min(part.centre - part.radius), high.max(part.centre + part.radius)]
            })
    }

    /// The value at a point.
    pub fn value(&self, point: DVec3) -> f64 {
        let mut value = f64::MAX;
        for part in &self.primitives {
            let far = part.beyond_ball(point);
            if part.carve {
                if -far > value - part.blend {
                    value = -smooth_min(-value, part.distance(point), part.blend);
                }
            } else if far < value + part.blend {
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

/// The gradient of any function by central differences over 0.2 mm.
pub fn gradient(function: &dyn Fn(DVec3) -> f64, point: DVec3) -> DVec3 {
    const STEP: f64 = 1e-4;
    let along = |axis: DVec3| function(point + STEP * axis) - function(point - STEP * axis);
    DVec3::new(along(DVec3::X), along(DVec3::Y), along(DVec3::Z)) / (2.0 * STEP)
}
