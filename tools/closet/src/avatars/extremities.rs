//! Hands with fingers and feet with toes, at the ends of a skeleton's limbs.

use glam::DVec3;

use super::super::implicit::{Owner, Shape};
use super::super::loft::{Loft, Section};
use super::super::skeleton::{ARMS, LEGS, Skeleton};
use super::clay::{Clay, SIDES};

/// A hand with separate fingers.
#[derive(Clone, Copy, Debug)]
pub struct Hand<'a> {
    /// Its size, as a multiple of the mannequin's.
    pub size: f64,
    /// Length of each finger from the thumb's side on, as a multiple of a human one; two to four of them.
    pub fingers: &'a [f64],
    /// Thickness of the fingers, as a multiple of a human one.
    pub thickness: f64,
    /// From 0, flat, to 1, a fist.
    pub curl: f64,
    /// Angle between the outer fingers in degrees.
    pub spread: f64,
    /// Edge length of its triangles, in metres.
    pub edge: f64,
}

/// A foot.
#[derive(Clone, Copy, Debug)]
pub struct Foot {
    /// Its length, as a multiple of the mannequin's.
    pub size: f64,
    /// Its width and height, as multiples of the mannequin's at this length.
    pub width: f64,
    /// Number of toes that show, 0 for a shoe-like foot.
    pub toes: usize,
    /// Edge length of its triangles, in metres.
    pub edge: f64,
}

/// Both hands, the palms towards the thighs.
pub fn hands(clay: &mut Clay, skeleton: &Skeleton, hand: &Hand, wrist_radius: f64) {
    for (side, [_, elbow, wrist]) in SIDES.into_iter().zip(ARMS) {
        let [b, c] = [elbow, wrist].map(|joint| skeleton.joints[joint]);
        let (size, own) = (hand.size, Owner::Joint(wrist));
        let along = (c - b).normalize();
        let across = DVec3::NEG_Y.reject_from_normalized(along).normalize();
        let normal = along.cross(across);
        let inwards = if normal.x * side < 0.0 { normal } else { -normal };
        let at = |u: f64, v: f64, w: f64| c + size * (u * along + v * across + w * inwards);
        let wide = 0.0098 * hand.thickness * hand.fingers.len() as f64 + 0.002;
        let palm = [
            Section::ellipse(0.0, 0.95 * wrist_radius, 1.12 * wrist_radius),
            Section::ellipse(0.45, 0.018 * size * hand.thickness.sqrt(), 0.92 * wide * size),
            Section::ellipse(1.0, 0.0125 * size * hand.thickness, wide * size),
        ];
        let axis = Loft::new(c, at(0.086, 0.0, 0.004), DVec3::Y, &palm).capped(0.6);
        clay.add(Shape::Loft(axis), 0.02 * size, own);
        clay.refine(at(0.09, 0.0, 0.02), 0.10 * size, hand.edge);
        let count = hand.fingers.len();
        let radius = 0.0105 * hand.thickness;
        for (k, length) in hand.fingers.iter().enumerate() {
            let place = 1.0 - 2.0 * k as f64 / (count - 1) as f64;
            let v = place * (wide - radius);
            let fan = 0.5 * place * hand.spread.to_radians() * (1.0 - hand.curl);
            let ahead = fan.cos() * along + fan.sin() * across;
            let arc = 0.004 * (1.0 - place * place);
            let mut points = vec![at(0.070, v, 0.004), at(0.084 + arc, v, 0.004)];
            let mut bend = 0.10 + 0.55 * hand.curl;
            for (share, step) in [(0.46, 1.0), (0.30, 1.15), (0.24, 0.95)] {
                let direction = bend.cos() * ahead + bend.sin() * inwards;
                points.push(points[points.len() - 1] + 0.078 * length * share * size * direction);
                bend += step * (0.12 + 1.35 * hand.curl);
            }
            let r = radius * size;
            clay.tube(&points, &[r, 1.08 * r, 1.02 * r, 0.98 * r, 0.84 * r], 0.006 * size, own);
        }
        if hand.curl > 0.6 {
            // What the fingers close around would be a hollow.
            let [p, q] = [0.8, -0.8].map(|v| at(0.096, v * wide, 0.030));
            clay.loft(
                p,
                q,
                &[Section::circle(0.0, 0.026 * size), Section::circle(1.0, 0.026 * size)],
                0.01 * size,
                own,
            );
        }
        let t = 0.5 + 0.5 * hand.thickness;
        let edge = wide - 0.036;
        let thumb = if hand.curl < 0.6 {
            [
                at(0.012, 0.010, 0.004),
                at(0.044, 0.048 + edge, 0.014),
                at(0.072, 0.066 + edge, 0.022),
                at(0.094, 0.076 + edge, 0.030),
            ]
        } else {
            [
                at(0.012, 0.010, 0.006),
                at(0.048, 0.044 + edge, 0.022),
                at(0.080, 0.040 + edge, 0.052),
                at(0.092, 0.010 + edge, 0.060),
            ]
        };
        let radii = [0.020, 0.0150, 0.0125, 0.0105].map(|r| r * size * t);
        clay.tube(&thumb, &radii, 0.016 * size, own);
    }
}

/// Both feet on the floor.
pub fn feet(clay: &mut Clay, skeleton: &Skeleton, foot: &Foot, ankle_radius: f64) {
    for (side, [_, _, ankle]) in SIDES.into_iter().zip(LEGS) {
        let c = skeleton.joints[ankle];
        let (l, w, own) = (foot.size, foot.size * foot.width, Owner::Joint(ankle));
        let sole = DVec3::new(c.x, c.y, 0.0);
        let at = |x: f64, y: f64, z: f64| sole + DVec3::new(side * w * x, l * y, w * z);
        // The feet turn out a little: x grows towards the toes.
        clay.ball(at(0.0, 0.028, 0.030), [0.033 * w, 0.038 * l, 0.042 * w], 0.03, own);
        clay.loft(
            c,
            at(0.0, 0.012, 0.040),
            &[Section::circle(0.0, ankle_radius), Section::circle(1.0, 0.034 * w)],
            0.02,
            own,
        );
        let from = DVec3::new(c.x, c.y - 0.004 * l, 0.55 * c.z);
        let height = 0.55 * c.z;
        let instep = [
            Section::ellipse(0.0, 0.031 * w, 0.95 * height),
            Section::ellipse(0.40, 0.036 * w, 0.5 * height + 0.014 * w),
            Section::ellipse(0.75, 0.046 * w, 0.025 * w),
            Section::ellipse(1.0, 0.043 * w, 0.019 * w),
        ];
        let ball = at(0.020, -0.118, 0.017);
        clay.add(Shape::Loft(Loft::new(from, ball, DVec3::Z, &instep).capped(0.8)), 0.03, own);
        let tip = at(0.024, -0.148, 0.018);
        if foot.toes == 0 {
            clay.ball(tip, [0.041 * w, 0.036 * l, 0.022 * w], 0.02, own);
        } else {
            let n = foot.toes as f64;
            for k in 0..foot.toes {
                // The big toe is on the inside.
                let place = -1.0 + 2.0 * (k as f64 + 0.5) / n;
                let radius = 0.040 * w / n * (1.22 - 0.22 * (place + 1.0));
                let reach = -0.158 + 0.014 * (place + 0.6).max(0.0).powi(2);
                let root = at(0.022 + 0.034 * place, -0.112, 0.018);
                let toe = DVec3::new(sole.x + side * w * (0.028 + 0.042 * place), sole.y + l * reach, radius);
                clay.tube(&[root, toe], &[radius, radius], 0.007 * w, own);
            }
        }
        clay.refine(at(0.02, -0.145, 0.015), 0.05 * l, foot.edge);
        clay.carve(Shape::Below { height: 0.0 }, 0.014, own);
    }
}
