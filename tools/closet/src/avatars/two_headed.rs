//! The two-headed body: a broad, furry trunk that carries two wolves' heads on two necks.

use glam::{DMat3, DVec3};

use super::super::Sample;
use super::super::implicit::{Owner, Shape};
use super::super::loft::{Loft, Section};
use super::super::skeleton::{NECK, Proportions, ROOT, WAIST};
use super::clay::{Clay, Frame, Part, SIDES, assemble, rigid};
use super::extremities::{Foot, Hand, feet, hands};
use super::figure::{Arm, Leg, Trunk, arms, collar, legs, ring, trunk};
use super::head::eyeball;
use super::sweep::{self, sweep};

const HEAD: Owner = Owner::Joint(NECK);

/// Models the body.
pub fn two_headed() -> Sample {
    let skeleton = Proportions {
        ankle: 0.090,
        shin: 0.430,
        thigh: 0.430,
        leg_angle: 9.0,
        hip: 0.118,
        belly: 0.110,
        chest: 0.480,
        hunch: 0.035,
        shoulder: 0.262,
        shoulder_drop: 0.075,
        upper_arm: 0.320,
        forearm: 0.300,
        arm_angle: 50.0,
    }
    .skeleton();
    let mut clay = Clay::new(0.040, 0.011);
    trunk(
        &mut clay,
        &skeleton,
        &[
            ring(-0.50, 0.095, 0.070, 0.085),
            ring(-0.05, 0.170, 0.105, 0.108),
            ring(0.50, 0.164, 0.110, 0.098),
            ring(1.00, 0.156, 0.112, 0.092),
            ring(1.35, 0.180, 0.125, 0.108),
            ring(1.70, 0.225, 0.140, 0.130),
            ring(1.95, 0.228, 0.124, 0.135),
            ring(2.30, 0.195, 0.095, 0.118),
            ring(2.85, 0.130, 0.070, 0.085),
        ],
    );
    let place = Trunk::of(&skeleton);
    let chest = Owner::Joint(WAIST);
    for side in SIDES {
        clay.ball(place.at(side * 0.105, -0.088, 1.72), [0.115, 0.062, 0.082], 0.045, chest);
        clay.ball(place.at(side * 0.110, 0.082, 1.78), [0.085, 0.055, 0.115], 0.05, chest);
        clay.ball(place.at(side * 0.082, 0.062, -0.05), [0.088, 0.078, 0.096], 0.045, Owner::Joint(ROOT));
        let back = [
            place.at(side * 0.185, 0.030, 1.70),
            place.at(side * 0.150, 0.035, 1.35),
            place.at(side * 0.105, 0.040, 1.05),
        ];
        clay.tube(&back, &[0.075, 0.062, 0.035], 0.05, chest);
    }
    let arm = Arm { shoulder: 0.078, upper: 0.064, elbow: 0.050, forearm: 0.060, wrist: 0.039, muscle: 0.8 };
    let leg = Leg { thigh: 0.108, knee: 0.066, calf: 0.068, ankle: 0.045, muscle: 0.7 };
    collar(&mut clay, &skeleton, 0.060, 0.062);
    arms(&mut clay, &skeleton, &arm);
    let hand =
        Hand { size: 1.35, fingers: &[0.85, 0.95, 0.80], thickness: 1.40, curl: 0.22, spread: 46.0, edge: 0.018 };
    hands(&mut clay, &skeleton, &hand, arm.wrist);
    legs(&mut clay, &skeleton, &leg);
    feet(&mut clay, &skeleton, &Foot { size: 1.20, width: 1.35, toes: 3, edge: 0.017 }, leg.ankle);

    let mut parts = Vec::new();
    for side in SIDES {
        // Each looks to its own side; the right one bows a little lower.
        let bow = if side > 0.0 { 0.04 } else { 0.16 };
        let rotation =
            DMat3::from_rotation_z(side * 0.42) * DMat3::from_rotation_y(side * 0.20) * DMat3::from_rotation_x(bow);
        let origin = skeleton.joints[NECK] + DVec3::new(side * 0.148, -0.050, 0.105 - 0.10 * bow);
        let frame = Frame { origin, rotation, size: 1.10 };
        let line =
            [place.at(side * 0.042, 0.010, 2.15), place.at(side * 0.080, 0.016, 2.95), frame.at(0.0, 0.040, 0.080)];
        clay.tube(&line, &[0.092, 0.074, 0.070], 0.05, place.throat());
        parts.extend(head(&mut clay, &frame));
        // The mane: a ridge of tufts down the back of the neck, each as long as its neighbours are apart.
        const TUFTS: usize = 5;
        for k in 0..TUFTS {
            let t = k as f64 / (TUFTS - 1) as f64;
            let nape = sweep::spline(0.7 + 1.2 * t, 2, |i| line[i]) + DVec3::new(-0.01 * side, 0.068, 0.01);
            let away = DVec3::new(0.15 * side, 0.80, 0.25 * t - 0.60).normalize();
            let long = 0.85 + 0.15 * t;
            let rings = [(-0.050, 0.040), (0.010, 0.044), (0.070, 0.026), (0.115, 0.001)]
                .map(|(along, r)| sweep::ring(nape + long * along * away, 0.62 * r, r));
            parts.push(rigid(sweep(&rings, frame.rotation.z_axis, 7, 6), NECK));
        }
    }
    parts.insert(0, clay.harden());
    assemble(skeleton, parts)
}

/// Joins a wolf's head to the body and returns what lies on it.
fn head(clay: &mut Clay, frame: &Frame) -> Vec<Part> {
    let size = frame.size;
    let lump =
        |clay: &mut Clay, centre: [f64; 3], radii: [f64; 3], blend: f64| clay.lump(frame, centre, radii, blend, HEAD);
    lump(clay, [0.0, 0.010, 0.100], [0.078, 0.088, 0.074], 0.04);
    // Muzzle and jaw: tapering lofts, the jaw a little shorter.
    let up = frame.rotation.z_axis;
    let bar = |clay: &mut Clay, from: DVec3, to: DVec3, table: &[(f64, f64, f64)], blend: f64| {
        let sections: Vec<Section> = table.iter().map(|&(t, w, d)| Section::ellipse(t, w * size, d * size)).collect();
        clay.add(Shape::Loft(Loft::new(from, to, up, &sections).capped(0.8)), blend * size, HEAD);
    };
    let muzzle = [(0.0, 0.058, 0.046), (0.35, 0.046, 0.036), (0.75, 0.034, 0.028), (1.0, 0.028, 0.023)];
    bar(clay, frame.at(0.0, -0.030, 0.080), frame.at(0.0, -0.180, 0.062), &muzzle, 0.03);
    let jaw = [(0.0, 0.050, 0.026), (0.5, 0.034, 0.017), (1.0, 0.020, 0.012)];
    bar(clay, frame.at(0.0, -0.020, 0.036), frame.at(0.0, -0.158, 0.014), &jaw, 0.010);
    for side in SIDES {
        lump(clay, [side * 0.052, -0.030, 0.062], [0.034, 0.044, 0.040], 0.03);
        clay.hollow(frame, [side * 0.048, -0.088, 0.122], [0.020, 0.024, 0.016], 0.016, HEAD);
        let ridge = [
            frame.at(side * 0.014, -0.070, 0.124),
            frame.at(side * 0.042, -0.060, 0.142),
            frame.at(side * 0.068, -0.036, 0.148),
        ];
        clay.tube(&ridge, &[0.013, 0.016, 0.013].map(|r| r * size), 0.030 * size, HEAD);
    }
    clay.refine_along([frame.at(0.0, -0.03, 0.08), frame.at(0.0, -0.17, 0.05)], 0.055 * size, 0.0145 * size);
    clay.refine(frame.at(0.0, -0.055, 0.125), 0.07 * size, 0.0120 * size);

    let mut parts = Vec::new();
    let axes = [DVec3::X * 0.019, DVec3::Y * 0.015, DVec3::Z * 0.014].map(|axis| frame.rotation * axis * size);
    parts.push(rigid(sweep::ellipsoid(frame.at(0.0, -0.200, 0.078), axes, 8, 4), NECK));
    for side in SIDES {
        let turned = frame.rotation * DMat3::from_rotation_z(side * 0.55);
        let gaze = Frame { origin: frame.at(side * 0.044, -0.064, 0.116), rotation: turned, size };
        parts.extend(eyeball(&gaze, 0.0165, 0.45, 3.0 * side));
        let ear = [
            (0.044, 0.012, 0.140, 0.034, 0.020),
            (0.058, 0.012, 0.190, 0.034, 0.017),
            (0.070, 0.010, 0.230, 0.022, 0.011),
            (0.080, 0.008, 0.268, 0.001, 0.001),
        ]
        .map(|(x, y, z, wide, thick)| sweep::ring(frame.at(side * x, y, z), wide * size, thick * size));
        parts.push(rigid(sweep(&ear, frame.rotation * DVec3::new(-0.5 * side, -1.0, 0.0), 8, 8), NECK));
        // Fangs, and three tufts of fur behind the cheek.
        for (x, y, z, dz) in [(0.021, -0.168, 0.050, -0.040), (0.017, -0.142, 0.018, 0.034)] {
            let fang = [(0.0, 0.0065), (0.5, 0.0055), (1.0, 0.0006)]
                .map(|(t, r)| sweep::ring(frame.at(side * x, y, z + t * dz), r * size, r * size));
            parts.push(rigid(sweep(&fang, frame.rotation.y_axis, 6, 4), NECK));
        }
        for (z, drop) in [(0.085, 0.010), (0.058, -0.022), (0.030, -0.050)] {
            let tuft = [(0.048, -0.020, 0.0, 0.022), (0.078, 0.012, 0.35, 0.020), (0.105, 0.050, 1.0, 0.001)]
                .map(|(x, y, t, r)| sweep::ring(frame.at(side * x, y, z + t * drop), r * size, 0.7 * r * size));
            parts.push(rigid(sweep(&tuft, frame.rotation.x_axis * side + frame.rotation.y_axis * -0.8, 7, 6), NECK));
        }
    }
    parts
}
