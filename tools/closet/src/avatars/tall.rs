//! The tall human: a lanky man with long legs and neck, swept-back hair and a goatee.

use super::super::Sample;
use super::super::implicit::Owner;
use super::super::skeleton::{NECK, Proportions, ROOT, WAIST};
use super::clay::{Clay, Frame, SIDES, assemble, rigid};
use super::extremities::{Foot, Hand, feet, hands};
use super::figure::{Arm, Leg, Trunk, arms, collar, legs, neck, ring, trunk};
use super::head::{Face, PLAIN, features, hair, head};
use super::sweep;

/// Models the body.
pub fn tall() -> Sample {
    let skeleton = Proportions {
        ankle: 0.092,
        shin: 0.600,
        thigh: 0.590,
        leg_angle: 5.5,
        hip: 0.100,
        belly: 0.120,
        chest: 0.590,
        hunch: 0.022,
        shoulder: 0.186,
        shoulder_drop: 0.200,
        upper_arm: 0.345,
        forearm: 0.320,
        arm_angle: 56.0,
    }
    .skeleton();
    let mut clay = Clay::new(0.038, 0.010);
    trunk(
        &mut clay,
        &skeleton,
        &[
            ring(-0.50, 0.085, 0.056, 0.070),
            ring(-0.05, 0.136, 0.084, 0.088),
            ring(0.45, 0.136, 0.086, 0.080),
            ring(1.00, 0.130, 0.088, 0.070),
            ring(1.35, 0.142, 0.098, 0.080),
            ring(1.65, 0.162, 0.104, 0.098),
            ring(1.88, 0.160, 0.090, 0.100),
            ring(2.10, 0.118, 0.060, 0.080),
            ring(2.55, 0.052, 0.042, 0.050),
        ],
    );
    let place = Trunk::of(&skeleton);
    for side in SIDES {
        clay.ball(place.at(side * 0.072, -0.064, 1.72), [0.086, 0.042, 0.070], 0.050, Owner::Joint(WAIST));
        clay.ball(place.at(side * 0.066, 0.046, -0.05), [0.070, 0.062, 0.082], 0.045, Owner::Joint(ROOT));
        clay.ball(place.at(side * 0.082, 0.060, 1.76), [0.056, 0.036, 0.084], 0.040, Owner::Joint(WAIST));
        // From the nape down to the shoulder.
        let nape = [
            place.at(side * 0.016, 0.026, 2.42),
            place.at(side * 0.060, 0.022, 2.14),
            place.at(side * 0.130, 0.012, 2.03),
        ];
        clay.tube(&nape, &[0.026, 0.030, 0.030], 0.035, Owner::Joint(WAIST));
    }
    let arm = Arm { shoulder: 0.052, upper: 0.046, elbow: 0.034, forearm: 0.038, wrist: 0.024, muscle: 0.5 };
    let leg = Leg { thigh: 0.083, knee: 0.050, calf: 0.052, ankle: 0.033, muscle: 0.5 };
    collar(&mut clay, &skeleton, 0.030, 0.038);
    arms(&mut clay, &skeleton, &arm);
    let fingers = [1.05, 1.18, 1.10, 0.88];
    let hand = Hand { size: 1.12, fingers: &fingers, thickness: 0.92, curl: 0.14, spread: 30.0, edge: 0.011 };
    hands(&mut clay, &skeleton, &hand, arm.wrist);
    legs(&mut clay, &skeleton, &leg);
    feet(&mut clay, &skeleton, &Foot { size: 1.18, width: 0.95, toes: 0, edge: 0.013 }, leg.ankle);

    let frame = Frame::upright(skeleton.joints[NECK], 1.0);
    let face = Face {
        wide: 0.90,
        jaw: 1.05,
        chin: 1.35,
        cheeks: 0.9,
        brow: 1.15,
        nose: 1.45,
        nostrils: 0.95,
        lips: 0.9,
        ears: 1.15,
        ..PLAIN
    };
    neck(&mut clay, &skeleton, frame.at(0.0, 0.012, 0.070), 0.047, 0.045);
    head(&mut clay, &frame, &face);
    // Adam's apple.
    clay.ball(frame.at(0.0, -0.034, -0.052), [0.012, 0.014, 0.016], 0.02, place.throat());
    let mut swept = hair(&frame, &face, 0.158, 0.030, 0.008);
    swept.lump(&frame, [0.0, -0.035, 0.200], [0.056, 0.062, 0.026], 0.030, Owner::Joint(NECK));
    let mut parts = vec![clay.harden(), swept.harden()];
    parts.extend(features(&frame, &face, 0.62, 0.12));
    let beard = [
        (-0.100, 0.010, 0.006, 0.005),
        (-0.106, 0.002, 0.016, 0.011),
        (-0.108, -0.016, 0.018, 0.013),
        (-0.106, -0.036, 0.012, 0.009),
        (-0.104, -0.054, 0.002, 0.002),
    ]
    .map(|(y, z, wide, deep)| sweep::ring(frame.at(0.0, y, z), wide, deep));
    parts.push(rigid(sweep::sweep(&beard, frame.rotation.y_axis, 8, 7), NECK));
    assemble(skeleton, parts)
}
