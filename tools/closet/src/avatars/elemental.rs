//! The elemental: floating stones in the shape of a walker, with crystals on its shoulders and a crown of pebbles.

use glam::DVec3;

use super::super::mesh::Mesh;
use super::super::parts::{Parts, across, mirrored, moved, placed};
use super::super::polyhedron::Polyhedron;
use super::super::random::Random;
use super::super::skeleton::{ARMS, LEGS, NECK, Proportions, ROOT, Skeleton, WAIST};
use super::super::{SEED, Sample};

/// Edges of stones that are shorter than this (metres) are welded.
const SHORTEST: f64 = 0.004;

/// Models the elemental.
pub fn elemental() -> Sample {
    let skeleton = Proportions {
        ankle: 0.090,
        shin: 0.360,
        thigh: 0.370,
        leg_angle: 10.0,
        hip: 0.135,
        belly: 0.110,
        chest: 0.470,
        hunch: 0.060,
        shoulder: 0.235,
        shoulder_drop: 0.100,
        upper_arm: 0.300,
        forearm: 0.300,
        arm_angle: 52.0,
    }
    .skeleton();
    let mut rocks = Rocks { parts: Parts::default(), random: Random::new(SEED) };
    rocks.trunk(&skeleton);
    rocks.head(skeleton.joints[NECK]);
    rocks.arms(&skeleton);
    rocks.legs(&skeleton);
    rocks.crystals(&skeleton);
    rocks.parts.sample(skeleton)
}

/// The stones so far, and the chance that shapes them.
struct Rocks {
    parts: Parts,
    random: Random,
}

impl Rocks {
    fn trunk(&mut self, skeleton: &Skeleton) {
        let [root, waist, neck] = [ROOT, WAIST, NECK].map(|joint| skeleton.joints[joint]);
        self.one(ROOT, root + DVec3::new(0.0, 0.010, -0.020), DVec3::Z, [0.165, 0.110, 0.078]);
        self.one(ROOT, root + DVec3::new(0.0, 0.005, 0.093), DVec3::new(0.05, 0.0, 1.0), [0.112, 0.088, 0.026]);
        self.one(WAIST, waist + DVec3::new(0.0, 0.002, 0.056), DVec3::new(-0.06, 0.02, 1.0), [0.128, 0.098, 0.027]);
        let chest = waist.lerp(neck, 0.575) + DVec3::new(0.0, 0.010, 0.0);
        self.wedge(WAIST, chest, DVec3::new(0.0, -0.15, 1.0), DVec3::new(0.235, 0.165, 0.160));
        let collar = neck + DVec3::new(0.118, 0.055, 0.008);
        self.pair(WAIST, collar, DVec3::new(0.25, 0.2, 1.0), DVec3::X, [0.088, 0.070, 0.034]);
        self.pebble(NECK, neck + DVec3::new(0.0, -0.015, 0.012), 0.034);
        // A belt of pebbles in orbit.
        for i in 0..14 {
            let (sin, cos) = (std::f64::consts::TAU * (i as f64 + 0.3) / 14.0).sin_cos();
            let height = 0.100 + 0.012 * self.random.signed();
            let size = 0.019 + 0.006 * self.random.signed();
            self.pebble(ROOT, root + DVec3::new(0.178 * cos, 0.150 * sin, height), size);
        }
    }

    fn head(&mut self, neck: DVec3) {
        let at = |x: f64, y: f64, z: f64| neck + DVec3::new(x, y, z);
        self.one(NECK, at(0.0, -0.010, 0.262), DVec3::new(0.0, 0.3, 1.0), [0.106, 0.112, 0.078]);
        self.wedge(NECK, at(0.0, -0.062, 0.100), DVec3::new(0.0, -0.15, 1.0), DVec3::new(0.118, 0.096, 0.038));
        // Heavy brows over the eyes, which glow in the gap above the jaw, and tusks.
        let brow = Polyhedron::cuboid(DVec3::new(0.060, 0.028, 0.018)).bevelled(0.008).mesh();
        let brow = moved(&brow, &placed(at(0.067, -0.172, 0.220), DVec3::new(-0.35, -0.40, 1.0), DVec3::X));
        self.parts.add_pair(&brow, NECK);
        let eye = Polyhedron::crystal(0.017, 0.050, &mut self.random).welded(SHORTEST).mesh();
        let eye = moved(&eye, &placed(at(0.030, -0.128, 0.164), DVec3::new(1.0, 0.0, 0.3), DVec3::Y));
        self.parts.add_pair(&eye, NECK);
        self.crystal_pair(NECK, at(0.098, -0.130, 0.148), DVec3::new(0.30, -0.35, 1.0), 0.070);
        // A crown in orbit, tilted backwards.
        for i in 0..12 {
            let (sin, cos) = (std::f64::consts::TAU * i as f64 / 12.0).sin_cos();
            let place = at(0.185 * cos, -0.010 + 0.185 * sin, 0.335 - 0.045 * sin + 0.010 * self.random.signed());
            let size = 0.025 + 0.008 * self.random.signed();
            self.pebble(NECK, place, size);
        }
    }

    fn arms(&mut self, skeleton: &Skeleton) {
        let [shoulder, elbow, wrist] = ARMS[0];
        let [a, b, c] = ARMS[0].map(|joint| skeleton.joints[joint]);
        let (upper, lower) = ((b - a).normalize(), (c - b).normalize());
        let back = DVec3::Y;
        self.pair(
            shoulder,
            a + DVec3::new(0.082, 0.010, 0.035),
            DVec3::new(0.4, 0.0, 1.0),
            back,
            [0.118, 0.120, 0.094],
        );
        self.pair(shoulder, a + 0.197 * upper, upper, back, [0.070, 0.066, 0.060]);
        self.pair(elbow, b + 0.004 * lower + DVec3::new(0.0, 0.016, 0.0), lower, back, [0.052, 0.056, 0.030]);
        self.pair(elbow, b + 0.162 * lower, lower, back, [0.092, 0.082, 0.105]);
        // The fist: palm, three fingers, thumb. The palm faces the thigh.
        let front = DVec3::NEG_Y.reject_from_normalized(lower).normalize();
        let inwards = lower.cross(front) * lower.cross(front).x.signum() * -1.0;
        self.pair(wrist, c + 0.070 * lower, lower, back, [0.092, 0.068, 0.056]);
        for (v, reach) in [(0.062, 0.172), (0.0, 0.184), (-0.062, 0.172)] {
            let along = lower + 0.35 * inwards;
            self.pair(wrist, c + reach * lower + v * front + 0.012 * inwards, along, back, [0.026, 0.030, 0.034]);
        }
        let thumb = c + 0.100 * lower + 0.094 * front + 0.074 * inwards;
        self.pair(wrist, thumb, lower + 0.3 * front, back, [0.022, 0.024, 0.036]);
    }

    fn legs(&mut self, skeleton: &Skeleton) {
        let [hip, knee, ankle] = LEGS[0];
        let [a, b, c] = LEGS[0].map(|joint| skeleton.joints[joint]);
        let (upper, lower) = ((b - a).normalize(), (c - b).normalize());
        let front = DVec3::NEG_Y;
        self.pair(hip, a + 0.186 * upper, upper, front, [0.104, 0.094, 0.116]);
        self.pair(knee, b + DVec3::new(0.002, -0.026, 0.000), lower, front, [0.060, 0.066, 0.044]);
        self.pair(knee, b + 0.190 * lower, lower, front, [0.094, 0.086, 0.122]);
        let sole = DVec3::new(c.x, c.y, 0.0);
        self.pair(ankle, sole + DVec3::new(0.0, -0.005, 0.058), DVec3::Z, front, [0.098, 0.080, 0.056]);
        for (x, y, z, size) in [(-0.052, -0.140, 0.036, 0.9), (0.016, -0.156, 0.038, 1.0), (0.078, -0.130, 0.034, 0.85)]
        {
            let toe = sole + DVec3::new(x, y, z);
            self.pair(ankle, toe, DVec3::Z, front, [0.050 * size, 0.029 * size, 0.036 * size]);
        }
    }

    fn crystals(&mut self, skeleton: &Skeleton) {
        let shoulder = skeleton.joints[ARMS[0][0]] + DVec3::new(0.082, 0.010, 0.035);
        for (x, y, length) in [(0.10, -0.01, 0.150), (-0.30, 0.12, 0.115), (0.62, 0.10, 0.110)] {
            let along = DVec3::new(x, y, 1.0).normalize();
            self.crystal_pair(ARMS[0][0], shoulder + DVec3::new(0.148, 0.148, 0.124) * along, along, length);
        }
        // Two rows down the back.
        let [waist, neck] = [WAIST, NECK].map(|joint| skeleton.joints[joint]);
        for (t, x, length) in [(0.76, 0.070, 0.120), (0.56, 0.085, 0.100), (0.36, 0.055, 0.080)] {
            let along = DVec3::new(0.35, 1.0, 0.75);
            let depth = 0.186;
            self.crystal_pair(WAIST, waist.lerp(neck, t) + DVec3::new(x, depth, 0.0), along, length);
        }
    }

    /// A boulder, its third half-axis along `along`, its first towards `side`.
    fn boulder(&mut self, place: DVec3, along: DVec3, side: DVec3, radii: [f64; 3]) -> Mesh {
        let radii = DVec3::from_array(radii);
        let stone = Polyhedron::boulder(radii, 13, false, &mut self.random);
        moved(&stone.bevelled(bevel(radii)).welded(SHORTEST).mesh(), &placed(place, along, side))
    }

    /// A boulder in the middle, alike on both sides.
    fn one(&mut self, joint: usize, place: DVec3, along: DVec3, radii: [f64; 3]) {
        let radii = DVec3::from_array(radii);
        let stone = Polyhedron::boulder(radii, 9, true, &mut self.random).bevelled(bevel(radii)).welded(SHORTEST);
        self.parts.add(&moved(&stone.mesh(), &placed(place, along, DVec3::X)), joint);
    }

    /// The same, narrow below.
    fn wedge(&mut self, joint: usize, place: DVec3, along: DVec3, radii: DVec3) {
        let mut stone = Polyhedron::boulder(radii, 9, true, &mut self.random);
        for side in [1.0, -1.0] {
            stone.cut(DVec3::new(side, 0.0, -0.55).normalize(), 0.72 * radii.x);
        }
        let stone = stone.bevelled(bevel(radii)).welded(SHORTEST);
        self.parts.add(&moved(&stone.mesh(), &placed(place, along, DVec3::X)), joint);
    }

    /// Boulders on both sides, after one plan, each with its own facets.
    fn pair(&mut self, joint: usize, place: DVec3, along: DVec3, side: DVec3, radii: [f64; 3]) {
        let left = self.boulder(place, along, side, radii);
        let right = self.boulder(place, along, side, radii);
        self.parts.add(&left, joint);
        self.parts.add(&mirrored(&right), across(joint));
    }

    fn crystal(&mut self, place: DVec3, along: DVec3, length: f64) -> Mesh {
        let crystal = Polyhedron::crystal(0.21 * length, length, &mut self.random).welded(SHORTEST);
        moved(&crystal.mesh(), &placed(place, along, DVec3::X))
    }

    fn crystal_pair(&mut self, joint: usize, place: DVec3, along: DVec3, length: f64) {
        let left = self.crystal(place, along, length);
        let right = self.crystal(place, along, length);
        self.parts.add(&left, joint);
        self.parts.add(&mirrored(&right), across(joint));
    }

    fn pebble(&mut self, joint: usize, place: DVec3, radius: f64) {
        let along = DVec3::from_array([(); 3].map(|()| self.random.signed())) + 1.5 * DVec3::Z;
        let radii = radius * DVec3::new(1.0, 0.85, 0.75);
        let pebble = Polyhedron::boulder(radii, 9, false, &mut self.random).welded(SHORTEST).mesh();
        self.parts.add(&moved(&pebble, &placed(place, along, DVec3::X)), joint);
    }
}

/// How wide the edges of a boulder are worn off.
fn bevel(radii: DVec3) -> f64 {
    0.008 + 0.06 * radii.min_element()
}
