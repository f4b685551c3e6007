//! The giant: a trunk like an inverted triangle, a small head with tusks, thick forearms, fists like hammers.

use glam::DVec3;

use super::super::Sample;
use super::super::implicit::Owner;
use super::super::skeleton::{NECK, Proportions, ROOT, WAIST};
use super::clay::{Clay, Frame, SIDES, assemble, rigid};
use super::extremities::{Foot, Hand, feet, hands};
use super::figure::{Arm, Leg, Trunk, arms, collar, legs, neck, ring, trunk};
use super::head::{Face, features, head};
use super::sweep;

/// Models the body.
pub fn giant() -> Sample {
    let skeleton = Proportions {
        ankle: 0.105,
        shin: 0.460,
        thigh: 0.470,
        leg_angle: 9.0,
        hip: 0.140,
        belly: 0.130,
        chest: 0.660,
        hunch: 0.080,
        shoulder: 0.390,
        shoulder_drop: 0.110,
        upper_arm: 0.400,
        forearm: 0.400,
        arm_angle: 52.0,
    }
    .skeleton();
    let mut clay = Clay::new(0.048, 0.014);
    trunk(
        &mut clay,
        &skeleton,
        &[
            ring(-0.55, 0.120, 0.085, 0.105),
            ring(-0.05, 0.195, 0.125, 0.130),
            ring(0.50, 0.185, 0.130, 0.115),
            ring(1.00, 0.182, 0.138, 0.110),
            ring(1.30, 0.230, 0.165, 0.140),
            ring(1.60, 0.310, 0.195, 0.185),
            ring(1.85, 0.345, 0.190, 0.205),
            ring(2.10, 0.290, 0.135, 0.180),
            ring(2.45, 0.190, 0.095, 0.130),
            ring(2.90, 0.095, 0.070, 0.085),
        ],
    );
    let place = Trunk::of(&skeleton);
    let chest = Owner::Joint(WAIST);
    for side in SIDES {
        clay.ball(place.at(side * 0.145, -0.135, 1.78), [0.165, 0.095, 0.115], 0.045, chest);
        // Broad muscles of the back, down to the waist.
        let back = [
            place.at(side * 0.300, 0.060, 1.75),
            place.at(side * 0.235, 0.060, 1.40),
            place.at(side * 0.130, 0.055, 1.02),
        ];
        clay.tube(&back, &[0.120, 0.100, 0.055], 0.06, chest);
        clay.ball(place.at(side * 0.160, 0.130, 1.88), [0.130, 0.080, 0.150], 0.05, chest);
        // From the nape to the shoulder.
        let nape = [
            place.at(side * 0.035, 0.050, 3.05),
            place.at(side * 0.140, 0.050, 2.72),
            place.at(side * 0.300, 0.030, 2.22),
        ];
        clay.tube(&nape, &[0.065, 0.092, 0.085], 0.07, chest);
        clay.ball(place.at(side * 0.090, 0.080, -0.10), [0.105, 0.095, 0.120], 0.045, Owner::Joint(ROOT));
        for (level, y) in [(1.36, -0.125), (1.10, -0.108), (0.78, -0.098)] {
            clay.ball(place.at(side * 0.062, y, level), [0.062, 0.050, 0.052], 0.025, place.owner());
        }
    }
    clay.refine_along([place.at(0.0, -0.15, 0.8), place.at(0.0, -0.17, 1.4)], 0.10, 0.030);
    let arm = Arm { shoulder: 0.130, upper: 0.096, elbow: 0.080, forearm: 0.118, wrist: 0.070, muscle: 0.9 };
    let leg = Leg { thigh: 0.128, knee: 0.080, calf: 0.088, ankle: 0.060, muscle: 0.8 };
    collar(&mut clay, &skeleton, 0.090, 0.105);
    arms(&mut clay, &skeleton, &arm);
    let hand =
        Hand { size: 2.05, fingers: &[1.0, 1.05, 1.0, 0.9], thickness: 1.45, curl: 0.92, spread: 10.0, edge: 0.022 };
    hands(&mut clay, &skeleton, &hand, arm.wrist);
    legs(&mut clay, &skeleton, &leg);
    feet(&mut clay, &skeleton, &Foot { size: 1.30, width: 1.35, toes: 3, edge: 0.018 }, leg.ankle);

    let frame = Frame::upright(skeleton.joints[NECK] + DVec3::new(0.0, -0.050, 0.0), 1.12);
    let face = Face {
        skull: 0.92,
        wide: 1.15,
        jaw: 1.40,
        chin: 1.6,
        cheeks: 1.0,
        brow: 1.75,
        nose: 0.75,
        nostrils: 1.55,
        eyes: 0.85,
        lips: 1.0,
        mouth: 1.35,
        ears: 0.95,
        eyebrows: 0.0,
        edge: 0.0095,
    };
    neck(&mut clay, &skeleton, frame.at(0.0, 0.012, 0.070), 0.105, 0.085);
    head(&mut clay, &frame, &face);
    let mut parts = vec![clay.harden()];
    parts.extend(features(&frame, &face, 0.45, 0.0));
    for side in SIDES {
        let tusk = [
            (0.024, -0.100, 0.014, 0.010),
            (0.031, -0.122, 0.026, 0.0095),
            (0.035, -0.128, 0.042, 0.0065),
            (0.033, -0.122, 0.060, 0.001),
        ]
        .map(|(x, y, z, r)| sweep::ring(frame.at(side * x, y, z), r, r));
        parts.push(rigid(sweep::sweep(&tusk, frame.rotation.x_axis, 8, 8), NECK));
    }
    // A crest of hair from the forehead to the nape.
    let crest = [
        (-0.082, 0.160, 0.014),
        (-0.052, 0.204, 0.034),
        (0.012, 0.226, 0.044),
        (0.074, 0.196, 0.044),
        (0.100, 0.136, 0.038),
        (0.090, 0.070, 0.014),
    ]
    .map(|(y, z, high)| sweep::ring(frame.at(0.0, y, z), high, 0.45 * high));
    parts.push(rigid(sweep::sweep(&crest, frame.rotation.x_axis, 8, 14), NECK));
    assemble(skeleton, parts)
}
