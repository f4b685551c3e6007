//! Random pairs of primitives, generic and nasty.

use bespoke::contact::PairType;
use glam::DVec3;

use testing::Random;

pub const PAIR_TYPES: [PairType; 2] = [PairType::PointTriangle, PairType::EdgeEdge];

/// Size of a primitive in the normalised space.
pub const SIZE: f64 = 0.03;

/// Four vertices in general position, somewhere in the normalised space.
pub fn generic(random: &mut Random) -> [DVec3; 4] {
    let place = random.vector();
    std::array::from_fn(|_| place + SIZE * random.vector())
}

/// A pair that is `gap` apart, with the closest points inside both primitives.
pub fn interior(pair_type: PairType, gap: f64, random: &mut Random) -> [DVec3; 4] {
    let place = random.vector();
    let (u, v) = (SIZE * random.vector(), SIZE * random.vector());
    let n = gap * u.cross(v).normalize();
    let (s, t) = (0.2 + 0.5 * random.unit(), 0.2 + 0.5 * random.unit());
    match pair_type {
        PairType::PointTriangle => {
            let q = place + s * u + t * (1.0 - s) * v;
            [q + n, place, place + u, place + v]
        }
        PairType::EdgeEdge => [place - s * u + n, place + (1.0 - s) * u + n, place - t * v, place + (1.0 - t) * v],
    }
}

/// A degenerate pair or one close to degenerate: `form` in 0..FORMS.
pub fn nasty(form: usize, random: &mut Random) -> [DVec3; 4] {
    let mut x = generic(random);
    let tiny = SIZE * 10f64.powf(-2.0 - 14.0 * random.unit());
    let small = |random: &mut Random| tiny * random.vector();
    match form {
        // Edges (0, 1) and (2, 3) parallel, exactly or nearly.
        0 => x[3] = x[2] + (x[1] - x[0]) * (0.25 + random.unit()),
        1 => x[3] = x[2] + (x[1] - x[0]) * (0.25 + random.unit()) + small(random),
        2 => x[3] = x[2] - 2.0 * (x[1] - x[0]),
        // Edges on one line, overlapping or not.
        3 => {
            let u = x[1] - x[0];
            x[2] = x[0] + 0.5 * u;
            x[3] = x[0] + 4.0 * random.signed() * u;
        }
        4 => {
            let u = x[1] - x[0];
            x[2] = x[0] + 2.0 * u + small(random);
            x[3] = x[0] + (2.0 + random.unit()) * u + small(random);
        }
        // Zero length.
        5 => x[1] = x[0],
        6 => {
            x[1] = x[0];
            x[3] = x[2];
        }
        7 => x[3] = x[2] + small(random),
        // Triangle (1, 2, 3) collinear, exactly or nearly, or a point.
        8 => x[3] = x[1] + 3.0 * random.signed() * (x[2] - x[1]),
        9 => x[3] = x[1] + 3.0 * random.signed() * (x[2] - x[1]) + small(random),
        10 => {
            x[2] = x[1];
            x[3] = x[1];
        }
        11 => {
            x[2] = x[1] + small(random);
            x[3] = x[1] + small(random);
        }
        // Tiny distances: on the plane, on an edge, on a corner.
        12 => x[0] = (x[1] + x[2] + x[3]) / 3.0 + small(random),
        13 => x[0] = 0.3 * x[1] + 0.7 * x[2] + small(random),
        14 => x[0] = x[2] + small(random),
        15 => x = [x[0]; 4],
        // A sliver seen from above.
        16 => {
            x[3] = 0.5 * (x[1] + x[2]) + small(random);
            x[0] = 0.4 * x[1] + 0.6 * x[2] + small(random) + 0.1 * SIZE * random.vector();
        }
        _ => x[2] = x[0],
    }
    x
}

/// Number of forms that [`nasty`] knows.
pub const FORMS: usize = 18;
