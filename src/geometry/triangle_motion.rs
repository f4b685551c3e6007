//! How a triangle moves: the gradient of its deformation as a rotation after a stretch, and the mean of several.
//!
//! A triangle says what happens within its plane. Across it, lengths go with the square root of the area, so that a similarity
//! of the triangle is one of space.

use glam::{DMat3, DVec2, DVec3};

/// Twice the area of a triangle, over the square of its longest side, at which it has no plane.
const FLAT: f64 = 1e-10;

/// Rounds of the search for the mean rotation, at most; it converges quadratically.
const MAX_ROUNDS: usize = 40;

/// The gradient of a deformation, `rotation * stretch`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TriangleMotion {
    /// A rotation.
    pub rotation: DMat3,
    /// Symmetric and positive definite.
    pub stretch: DMat3,
}

/// An orthonormal basis whose first two vectors span the plane of a triangle, and its sides from the first corner in them.
struct PlaneFrame {
    basis: DMat3,
    sides: [DVec2; 2],
}

impl PlaneFrame {
    fn new([a, b, c]: [DVec3; 3]) -> Option<Self> {
        let (ab, ac) = (b - a, c - a);
        let normal = ab.cross(ac);
        let longest = ab.length_squared().max(ac.length_squared()).max((c - b).length_squared());
        if normal.length() <= FLAT * longest || !longest.is_finite() {
            return None;
        }
        let (x, z) = (ab.normalize(), normal.normalize());
        let y = z.cross(x);
        let within = |v: DVec3| DVec2::new(v.dot(x), v.dot(y));
        Some(Self { basis: DMat3::from_cols(x, y, z), sides: [within(ab), within(ac)] })
    }

    /// Twice the area.
    fn area(&self) -> f64 {
        self.sides[0].perp_dot(self.sides[1])
    }
}

impl TriangleMotion {
    /// No motion but a scale, above 0.
    pub fn scale(scale: f64) -> Self {
        Self { rotation: DMat3::IDENTITY, stretch: DMat3::from_diagonal(DVec3::splat(scale)) }
    }

    /// The motion from one place of a triangle to another; none where one of them has no area.
    pub fn between(rest: [DVec3; 3], now: [DVec3; 3]) -> Option<Self> {
        let (from, to) = (PlaneFrame::new(rest)?, PlaneFrame::new(now)?);
        let ([p, q], [s, t]) = (from.sides, to.sides);
        let area = from.area();
        // [s t] times the inverse of [p q].
        let columns = [(q.y * s - p.y * t) / area, (p.x * t - q.x * s) / area];
        let [u, v] = columns;
        let turn = DVec2::new(u.x + v.y, u.y - v.x).try_normalize()?;
        // Symmetric once it is turned back.
        let back = |w: DVec2| DVec2::new(turn.dot(w), turn.perp_dot(w));
        let [u, v] = [back(u), back(v)];
        let shear = 0.5 * (u.y + v.x);
        let thickness = (to.area() / area).sqrt();
        let stretch = DMat3::from_cols_array(&[u.x, shear, 0.0, shear, v.y, 0.0, 0.0, 0.0, thickness]);
        let rotation = DMat3::from_cols_array(&[turn.x, turn.y, 0.0, -turn.y, turn.x, 0.0, 0.0, 0.0, 1.0]);
        let back = from.basis.transpose();
        Some(Self { rotation: to.basis * rotation * back, stretch: from.basis * stretch * back })
    }

    /// The gradient.
    pub fn gradient(&self) -> DMat3 {
        self.rotation * self.stretch
    }

    /// A direction along the surface after the motion.
    pub fn of_vector(&self, v: DVec3) -> DVec3 {
        self.gradient() * v
    }

    /// A normal after the motion, of any length: by the inverse transpose of the gradient.
    pub fn of_normal(&self, n: DVec3) -> DVec3 {
        self.rotation * (self.stretch.inverse() * n)
    }

    /// The mean with these weights, which are not negative: of the stretches, and of the rotations the rotation nearest to
    /// their mean. So a bend does not make it smaller. None without any weight above 0.
    pub fn mean(motions: impl Iterator<Item = (f64, Self)> + Clone) -> Option<Self> {
        let total: f64 = motions.clone().map(|(weight, _)| weight).sum();
        let (_, heaviest) = motions.clone().max_by(|a, b| a.0.total_cmp(&b.0))?;
        if total.is_nan() || total <= 0.0 {
            return None;
        }
        let (mut rotations, mut stretch) = (DMat3::ZERO, DMat3::ZERO);
        for (weight, motion) in motions {
            rotations += motion.rotation * (weight / total);
            stretch += motion.stretch * (weight / total);
        }
        Some(Self { rotation: nearest_rotation(rotations).unwrap_or(heaviest.rotation), stretch })
    }
}

/// The rotation nearest to `a`, by Newton's iteration for the polar decomposition; none where `a` is nearly singular or a
/// reflection.
fn nearest_rotation(a: DMat3) -> Option<DMat3> {
    if a.determinant() < 1e-6 {
        return None;
    }
    let mut rotation = a;
    for _ in 0..MAX_ROUNDS {
        let next = 0.5 * (rotation + rotation.inverse().transpose());
        let change = (next - rotation).to_cols_array().into_iter().fold(0.0f64, |m, x| m.max(x.abs()));
        rotation = next;
        if change < 1e-14 {
            break;
        }
    }
    rotation.is_finite().then_some(rotation)
}
