//! The creature with very long arms: a lean goblin whose hands reach its ankles, with a long nose and drooping ears.

use glam::DVec3;

use super::super::Sample;
use super::super::implicit::Owner;
use super::super::skeleton::{NECK, Proportions, ROOT, WAIST};
use super::clay::{Clay, Frame, Part, SIDES, assemble, rigid};
use super::extremities::{Foot, Hand, feet, hands};
use super::figure::{Arm, Leg, Trunk, arms, collar, legs, neck, ring, trunk};
use super::head::eyeball;
use super::sweep::{self, sweep};

const HEAD: Owner = Owner::Joint(NECK);

/// Models the body.
pub fn long_arms() -> Sample {
    let skeleton = Proportions {
        ankle: 0.080,
        shin: 0.270,
        thigh: 0.270,
        leg_angle: 9.5,
        hip: 0.092,
        belly: 0.085,
        chest: 0.370,
        hunch: 0.080,
        shoulder: 0.162,
        shoulder_drop: 0.070,
        upper_arm: 0.460,
        forearm: 0.480,
        arm_angle: 50.0,
    }
    .skeleton();
    let mut clay = Clay::new(0.026, 0.009);
    trunk(
        &mut clay,
        &skeleton,
        &[
            ring(-0.48, 0.080, 0.048, 0.062),
            ring(-0.05, 0.124, 0.080, 0.078),
            ring(0.40, 0.120, 0.100, 0.070),
            ring(0.90, 0.108, 0.098, 0.062),
            ring(1.35, 0.112, 0.086, 0.078),
            ring(1.70, 0.134, 0.092, 0.100),
            ring(1.95, 0.130, 0.080, 0.108),
            ring(2.30, 0.095, 0.060, 0.092),
            ring(2.80, 0.048, 0.042, 0.050),
        ],
    );
    let place = Trunk::of(&skeleton);
    let chest = Owner::Joint(WAIST);
    clay.ball(place.at(0.0, -0.055, 0.62), [0.090, 0.078, 0.088], 0.05, place.owner());
    for side in SIDES {
        clay.ball(place.at(side * 0.062, -0.066, 1.75), [0.064, 0.034, 0.046], 0.030, chest);
        clay.ball(place.at(side * 0.070, 0.072, 1.80), [0.050, 0.036, 0.080], 0.035, chest);
        clay.ball(place.at(side * 0.055, 0.040, -0.15), [0.058, 0.052, 0.062], 0.035, Owner::Joint(ROOT));
        // The lowest ribs stand out over the belly.
        let rib = [
            place.at(side * 0.018, -0.082, 1.48),
            place.at(side * 0.070, -0.060, 1.32),
            place.at(side * 0.088, 0.010, 1.24),
        ];
        clay.tube(&rib, &[0.018, 0.022, 0.022], 0.022, chest);
    }
    let arm = Arm { shoulder: 0.050, upper: 0.040, elbow: 0.033, forearm: 0.042, wrist: 0.026, muscle: 0.6 };
    let leg = Leg { thigh: 0.066, knee: 0.045, calf: 0.047, ankle: 0.033, muscle: 0.5 };
    collar(&mut clay, &skeleton, 0.034, 0.031);
    arms(&mut clay, &skeleton, &arm);
    let hand = Hand { size: 1.42, fingers: &[1.05, 1.2, 1.0], thickness: 1.12, curl: 0.16, spread: 44.0, edge: 0.0125 };
    hands(&mut clay, &skeleton, &hand, arm.wrist);
    legs(&mut clay, &skeleton, &leg);
    feet(&mut clay, &skeleton, &Foot { size: 1.10, width: 1.25, toes: 3, edge: 0.013 }, leg.ankle);

    let frame = Frame::upright(skeleton.joints[NECK] + DVec3::new(0.0, -0.030, 0.010), 1.18);
    neck(&mut clay, &skeleton, frame.at(0.0, 0.020, 0.060), 0.040, 0.038);
    let mut parts = face(&mut clay, &frame);
    parts.insert(0, clay.harden());
    assemble(skeleton, parts)
}

/// Joins the head to the body and returns what lies on it.
fn face(clay: &mut Clay, frame: &Frame) -> Vec<Part> {
    let size = frame.size;
    let lump =
        |clay: &mut Clay, centre: [f64; 3], radii: [f64; 3], blend: f64| clay.lump(frame, centre, radii, blend, HEAD);
    // A broad flat skull over a wide jaw that runs to a pointed chin.
    lump(clay, [0.0, 0.010, 0.112], [0.090, 0.096, 0.072], 0.03);
    lump(clay, [0.0, -0.040, 0.065], [0.070, 0.058, 0.056], 0.04);
    lump(clay, [0.0, -0.055, 0.022], [0.056, 0.048, 0.028], 0.04);
    lump(clay, [0.0, -0.108, 0.000], [0.016, 0.020, 0.015], 0.035);
    for side in SIDES {
        lump(clay, [side * 0.058, -0.050, 0.050], [0.022, 0.028, 0.020], 0.025);
        clay.hollow(frame, [side * 0.042, -0.112, 0.092], [0.030, 0.026, 0.024], 0.020, HEAD);
        let ridge = [
            frame.at(side * 0.010, -0.100, 0.106),
            frame.at(side * 0.044, -0.094, 0.122),
            frame.at(side * 0.080, -0.056, 0.116),
        ];
        clay.tube(&ridge, &[0.010, 0.013, 0.010].map(|r| r * size), 0.022 * size, HEAD);
    }
    let nose = [
        frame.at(0.0, -0.088, 0.098),
        frame.at(0.0, -0.126, 0.080),
        frame.at(0.0, -0.165, 0.052),
        frame.at(0.0, -0.185, 0.018),
    ];
    clay.tube(&nose, &[0.012, 0.0135, 0.016, 0.011].map(|r| r * size), 0.016 * size, HEAD);
    for side in SIDES {
        lump(clay, [side * 0.016, -0.128, 0.058], [0.011, 0.016, 0.010], 0.010);
    }
    clay.refine(frame.at(0.0, -0.10, 0.06), 0.085 * size, 0.0095 * size);

    let mut parts = Vec::new();
    for side in SIDES {
        let gaze = Frame { origin: frame.at(side * 0.042, -0.078, 0.092), ..*frame };
        parts.extend(eyeball(&gaze, 0.0235, 0.72, -side));
        // A long ear that droops to the side: hollow in front, with a fold along its upper edge.
        let ear = [
            (0.070, 0.015, 0.085, 0.020, 0.014),
            (0.120, 0.030, 0.112, 0.044, 0.012),
            (0.185, 0.050, 0.108, 0.042, 0.010),
            (0.250, 0.065, 0.082, 0.024, 0.008),
            (0.300, 0.074, 0.046, 0.002, 0.002),
        ];
        let rings = ear.map(|(x, y, z, high, thick)| sweep::ring(frame.at(side * x, y, z), high * size, thick * size));
        parts.push(rigid(sweep(&rings, DVec3::new(-0.2 * side, -1.0, 0.15), 10, 11), NECK));
        let fold = ear.map(|(x, y, z, high, _)| {
            sweep::ring(frame.at(side * x, y - 0.010, z + 0.72 * high), 0.18 * high * size, 0.012 * size)
        });
        parts.push(rigid(sweep(&fold[..4], DVec3::NEG_Y, 6, 8), NECK));
        // A tooth out of the corner of the mouth.
        let tooth = [(-0.096, 0.014, 0.0055), (-0.104, 0.024, 0.0055), (-0.104, 0.040, 0.001)]
            .map(|(y, z, r)| sweep::ring(frame.at(side * 0.034, y, z), r * size, r * size));
        parts.push(rigid(sweep(&tooth, DVec3::X, 6, 5), NECK));
    }
    for (z, thick) in [(0.027, 0.0070), (0.017, 0.0075)] {
        // A grin from cheek to cheek.
        let lip = [
            (-0.064, -0.066, 0.018, 0.3),
            (-0.036, -0.098, 0.004, 0.9),
            (0.0, -0.114, -0.002, 1.0),
            (0.036, -0.098, 0.004, 0.9),
            (0.064, -0.066, 0.018, 0.3),
        ]
        .map(|(x, y, up, r)| sweep::ring(frame.at(x, y, z + up), 1.2 * r * thick * size, r * thick * size));
        parts.push(rigid(sweep(&lip, DVec3::Z, 6, 10), NECK));
    }
    // Three tufts of hair on the crown.
    for (x, lean) in [(0.0, 0.0), (0.030, 0.5), (-0.030, -0.5)] {
        let tuft = [(0.000, 0.165, 0.016), (0.025, 0.205, 0.015), (0.070, 0.225, 0.010), (0.120, 0.215, 0.001)].map(
            |(y, z, r)| {
                sweep::ring(
                    frame.at(x + lean * (y + 0.1 * (z - 0.165)), 0.01 + y, z - 0.3 * x.abs()),
                    r * size,
                    r * size,
                )
            },
        );
        parts.push(rigid(sweep(&tuft, DVec3::X, 7, 8), NECK));
    }
    parts
}
