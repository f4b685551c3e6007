//! Trunk and limbs of a fleshy figure around its skeleton, from a few measures in metres.

use glam::{DMat3, DVec3};

use super::super::implicit::{Owner, Shape};
use super::super::loft::{Loft, Section};
use super::super::skeleton::{ARMS, LEGS, NECK, ROOT, Skeleton, WAIST};
use super::clay::{Clay, SIDES};

/// A ring around the trunk.
#[derive(Clone, Copy, Debug)]
pub struct Ring {
    /// Height: 0 at the hips, 1 at the waist, 2 at the shoulders, 3 at the neck, and in proportion between and below.
    pub level: f64,
    /// Half the width.
    pub width: f64,
    /// From the spine to the front.
    pub front: f64,
    /// From the spine to the back.
    pub back: f64,
}

/// Makes a ring: level, half the width, front, back.
pub const fn ring(level: f64, width: f64, front: f64, back: f64) -> Ring {
    Ring { level, width, front, back }
}

/// Radii of an arm.
#[derive(Clone, Copy, Debug)]
pub struct Arm {
    /// The muscle over the shoulder.
    pub shoulder: f64,
    /// Upper arm at its thickest.
    pub upper: f64,
    /// Elbow.
    pub elbow: f64,
    /// Forearm at its thickest.
    pub forearm: f64,
    /// Wrist.
    pub wrist: f64,
    /// How far muscles stand out, from 0 to 1.
    pub muscle: f64,
}

/// Radii of a leg.
#[derive(Clone, Copy, Debug)]
pub struct Leg {
    /// Thigh at its thickest.
    pub thigh: f64,
    /// Knee.
    pub knee: f64,
    /// Calf at its thickest.
    pub calf: f64,
    /// Above the ankle.
    pub ankle: f64,
    /// How far muscles stand out, from 0 to 1.
    pub muscle: f64,
}

/// Edge length of the triangles around a limb, relative to its radius: about nine around it.
const FACETS: f64 = 0.66;

/// Where the trunk is: heights and the line of the spine.
#[derive(Clone, Copy, Debug)]
pub struct Trunk {
    heights: [f64; 4],
    spine: [f64; 2],
}

impl Trunk {
    /// Of a skeleton.
    pub fn of(skeleton: &Skeleton) -> Self {
        let j = &skeleton.joints;
        let heights = [LEGS[0][0], WAIST, ARMS[0][0], NECK].map(|joint| j[joint].z);
        Self { heights, spine: [j[WAIST].y, j[NECK].y] }
    }

    /// The point of the spine at a level (see [`Ring::level`]).
    pub fn spine(&self, level: f64) -> DVec3 {
        let i = (level.max(0.0) as usize).min(2);
        let z = self.heights[i] + (self.heights[i + 1] - self.heights[i]) * (level - i as f64);
        let t = ((z - self.heights[1]) / (self.heights[3] - self.heights[1])).clamp(0.0, 1.0);
        DVec3::new(0.0, self.spine[0] + (self.spine[1] - self.spine[0]) * t.powf(1.5), z)
    }

    /// A point at a level, away from the spine.
    pub fn at(&self, x: f64, y: f64, level: f64) -> DVec3 {
        self.spine(level) + DVec3::new(x, y, 0.0)
    }

    /// The owner of the flesh between the root and the waist.
    pub fn owner(&self) -> Owner {
        Owner::Passage { joints: [ROOT, WAIST], height: self.heights[1], reach: 0.10 }
    }

    /// The owner of the flesh between the waist and the head.
    pub fn throat(&self) -> Owner {
        Owner::Passage { joints: [WAIST, NECK], height: self.heights[3] - 0.02, reach: 0.06 }
    }
}

/// The trunk, from its rings (at least two, rising).
pub fn trunk(clay: &mut Clay, skeleton: &Skeleton, rings: &[Ring]) {
    let trunk = Trunk::of(skeleton);
    let [bottom, top] = [rings[0], rings[rings.len() - 1]].map(|ring| trunk.spine(ring.level).z);
    let section = |ring: &Ring| {
        let centre = trunk.spine(ring.level);
        let t = (centre.z - bottom) / (top - bottom);
        Section { t, centre: [0.0, centre.y], width: ring.width, front: ring.front, back: ring.back }
    };
    let sections: Vec<Section> = rings.iter().map(section).collect();
    let axis = Loft::new(DVec3::Z * bottom, DVec3::Z * top, DVec3::Y, &sections).capped(0.35);
    clay.add(Shape::Loft(axis), 0.02, trunk.owner());
}

/// The slope from the neck to the shoulders: its thickness at both ends.
pub fn collar(clay: &mut Clay, skeleton: &Skeleton, inner: f64, outer: f64) {
    let j = &skeleton.joints;
    for [shoulder, _, _] in ARMS {
        let from = Trunk::of(skeleton).spine(2.45);
        let to = j[shoulder] - DVec3::Z * 0.1 * outer;
        let sections = [
            Section::ellipse(0.0, inner, 1.1 * inner),
            Section::ellipse(0.5, f64::midpoint(inner, outer), 0.55 * (inner + outer)),
            Section::ellipse(1.0, outer, 1.1 * outer),
        ];
        clay.loft(from, to, &sections, 1.2 * inner, Owner::Joint(WAIST));
    }
}

/// The neck, between the trunk and a point inside the head: its radii there and above.
pub fn neck(clay: &mut Clay, skeleton: &Skeleton, top: DVec3, low: f64, high: f64) {
    let trunk = Trunk::of(skeleton);
    let sections = [
        Section::circle(0.0, 1.25 * low),
        Section::circle(0.30, low),
        Section::circle(0.65, high),
        Section::circle(1.0, high),
    ];
    let from = trunk.at(0.0, 0.010, 2.15);
    clay.loft(from, top, &sections, 0.6 * low, trunk.throat());
}

/// Both arms without their hands.
pub fn arms(clay: &mut Clay, skeleton: &Skeleton, arm: &Arm) {
    for (side, [shoulder, elbow, wrist]) in SIDES.into_iter().zip(ARMS) {
        let [a, b, c] = [shoulder, elbow, wrist].map(|joint| skeleton.joints[joint]);
        let section = |t: f64, radius: f64| Section::ellipse(t, 0.95 * radius, 1.05 * radius);
        let (own, m) = (Owner::Joint(shoulder), arm.muscle);
        let upper = [
            section(0.0, 0.90 * arm.shoulder),
            section(0.22, 0.5 * (arm.shoulder + arm.upper)),
            section(0.50, arm.upper),
            section(0.84, 0.45 * arm.upper + 0.55 * arm.elbow),
            section(1.0, arm.elbow),
        ];
        clay.loft(a, b, &upper, 1.3 * arm.upper, own);
        let along = (b - a).normalize();
        let length = a.distance(b);
        let out = (DVec3::X * side).reject_from_normalized(along).normalize();
        // An ellipsoid along the arm, moved outwards and back.
        let mut muscle = |t: f64, out_by: f64, back_by: f64, radii: [f64; 3]| {
            let rotation = DMat3::from_cols(out, out.cross(along), along);
            let centre = a + t * length * along + out_by * out + back_by * DVec3::Y;
            let [across, deep, long] = radii;
            let radii = DVec3::new(across, deep, long);
            clay.add(Shape::Ellipsoid { centre, radii, rotation }, 0.45 * arm.upper, own);
        };
        if m > 0.0 {
            let (s, u) = (arm.shoulder, arm.upper);
            muscle(0.40 * s / length, 0.24 * m * s, 0.0, [0.90 * s, 1.08 * s, 1.10 * s]);
            muscle(0.56, -0.06 * u, -0.36 * m * u, [0.76 * u, 0.82 * u, 0.30 * length]);
            muscle(0.50, 0.08 * u, 0.36 * m * u, [0.80 * u, 0.82 * u, 0.34 * length]);
        }
        clay.refine_along([a.lerp(b, 0.35), b], 1.2 * arm.upper, FACETS * arm.upper);
        clay.refine_along([b, c], 1.2 * arm.forearm, FACETS * f64::midpoint(arm.forearm, arm.wrist));
        let fore = [
            section(0.0, arm.elbow),
            section(0.10, 0.6 * arm.elbow + 0.4 * arm.forearm),
            section(0.30, arm.forearm),
            section(0.62, 0.55 * arm.forearm + 0.45 * arm.wrist),
            Section::ellipse(0.90, 0.88 * arm.wrist, 1.12 * arm.wrist),
            Section::ellipse(1.0, 0.88 * arm.wrist, 1.15 * arm.wrist),
        ];
        clay.loft(b, c, &fore, 0.5 * arm.elbow, Owner::Joint(elbow));
        if m > 0.0 {
            // The muscle on the outside, from above the elbow.
            let from = b - 0.06 * length * along + 0.30 * m * arm.forearm * (out - 0.3 * DVec3::Y);
            let f = arm.forearm;
            let bulge = [Section::circle(0.0, 0.4 * f), Section::circle(0.45, 0.76 * f), Section::circle(1.0, 0.3 * f)];
            clay.loft(from, b.lerp(c, 0.6), &bulge, 0.4 * f, Owner::Joint(elbow));
        }
    }
}

/// Both legs without their feet.
pub fn legs(clay: &mut Clay, skeleton: &Skeleton, leg: &Leg) {
    for (side, [hip, knee, ankle]) in SIDES.into_iter().zip(LEGS) {
        let [a, b, c] = [hip, knee, ankle].map(|joint| skeleton.joints[joint]);
        let (r, k, m) = (leg.thigh, leg.knee, leg.muscle);
        let section = |t: f64, radius: f64, out: f64, back: f64| {
            Section::ellipse(t, 0.96 * radius, 1.04 * radius).moved(side * out, back)
        };
        let thigh = [
            section(0.0, r, -0.05 * r, 0.0),
            section(0.28, 0.98 * r, 0.0, -0.04 * r),
            section(0.62, 0.48 * r + 0.5 * k, 0.02 * r, -0.05 * r),
            section(0.90, 1.04 * k, 0.0, 0.0),
            section(1.0, k, 0.0, 0.0),
        ];
        clay.loft(a, b, &thigh, 0.5 * r, Owner::Joint(hip));
        let (q, s) = (leg.calf, leg.ankle);
        let shin = [
            section(0.0, k, 0.0, 0.0),
            section(0.10, 0.97 * k, 0.0, 0.04 * k),
            section(0.30, q, 0.06 * q, 0.26 * q),
            section(0.60, 0.45 * q + 0.55 * s, 0.02 * q, 0.20 * q),
            section(0.86, s, 0.0, 0.04 * q),
            section(1.0, 1.06 * s, 0.0, 0.0),
        ];
        clay.loft(b, c, &shin, 0.02, Owner::Joint(knee));
        clay.refine_along([a.lerp(b, 0.8), b.lerp(c, 0.1)], 1.2 * k, FACETS * k);
        clay.refine_along([b.lerp(c, 0.5), c], 1.2 * s, 1.15 * FACETS * s);
        let down = (c - b).normalize();
        if m > 0.0 {
            // Kneecap, the thigh's front above it, and both heads of the calf.
            let cap = b - DVec3::Y * (0.62 * k) + 0.1 * k * down;
            clay.ball(cap, [0.52 * k, 0.36 * k, 0.66 * k], 0.03, Owner::Joint(knee));
            for (inner, low) in [(-0.34, 0.80), (0.34, 0.70)] {
                let low_end = a.lerp(b, low) + DVec3::new(side * inner * k, -0.45 * k, 0.0);
                let up = a.lerp(b, 0.22) + DVec3::new(side * inner * r, -0.34 * r, 0.0);
                let strand = [
                    Section::circle(0.0, 0.30 * r),
                    Section::circle(0.5, (0.40 + 0.22 * m) * r),
                    Section::circle(1.0, 0.42 * k),
                ];
                clay.loft(up, low_end, &strand, 0.35 * r, Owner::Joint(hip));
            }
            for (inner, low) in [(-0.42, 0.50), (0.40, 0.44)] {
                let top = b.lerp(c, 0.12) + DVec3::new(side * inner * q, 0.35 * q, 0.0);
                let end = b.lerp(c, low) + DVec3::new(side * inner * q, 0.45 * q, 0.0);
                let strand = [
                    Section::circle(0.0, 0.18 * q),
                    Section::circle(0.5, (0.42 + 0.2 * m) * q),
                    Section::circle(1.0, 0.2 * q),
                ];
                clay.loft(top, end, &strand, 0.55 * q, Owner::Joint(knee));
            }
        }
        for out in [-1.0, 1.0] {
            clay.ball(c + DVec3::new(out * 0.72 * s, 0.006, 0.006 * out), [0.42 * s; 3], 0.015, Owner::Joint(ankle));
        }
    }
}
