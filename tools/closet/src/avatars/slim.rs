//! The slim human: a slender woman with long limbs and neck and her hair in a bun.

use super::super::Sample;
use super::super::implicit::Owner;
use super::super::skeleton::{NECK, Proportions, ROOT, WAIST};
use super::clay::{Clay, Frame, SIDES, assemble};
use super::extremities::{Foot, Hand, feet, hands};
use super::figure::{Arm, Leg, Trunk, arms, collar, legs, neck, ring, trunk};
use super::head::{Face, PLAIN, features, hair, head};

/// Models the body.
pub fn slim() -> Sample {
    let skeleton = Proportions {
        ankle: 0.082,
        shin: 0.455,
        thigh: 0.465,
        leg_angle: 6.5,
        hip: 0.092,
        belly: 0.105,
        chest: 0.440,
        hunch: 0.006,
        shoulder: 0.148,
        shoulder_drop: 0.112,
        upper_arm: 0.280,
        forearm: 0.255,
        arm_angle: 54.0,
    }
    .skeleton();
    let mut clay = Clay::new(0.028, 0.009);
    trunk(
        &mut clay,
        &skeleton,
        &[
            ring(-0.55, 0.080, 0.050, 0.066),
            ring(-0.10, 0.140, 0.078, 0.080),
            ring(0.25, 0.143, 0.082, 0.078),
            ring(0.70, 0.112, 0.078, 0.064),
            ring(1.05, 0.094, 0.076, 0.058),
            ring(1.35, 0.100, 0.082, 0.066),
            ring(1.65, 0.122, 0.088, 0.078),
            ring(1.90, 0.129, 0.074, 0.080),
            ring(2.15, 0.096, 0.052, 0.066),
            ring(2.75, 0.044, 0.036, 0.044),
        ],
    );
    let place = Trunk::of(&skeleton);
    for side in SIDES {
        clay.ball(place.at(side * 0.058, -0.070, 1.60), [0.050, 0.046, 0.050], 0.030, Owner::Joint(WAIST));
        clay.ball(place.at(side * 0.060, 0.046, -0.10), [0.066, 0.062, 0.080], 0.045, Owner::Joint(ROOT));
        clay.ball(place.at(side * 0.066, 0.048, 1.75), [0.040, 0.028, 0.070], 0.035, Owner::Joint(WAIST));
    }
    let arm = Arm { shoulder: 0.037, upper: 0.034, elbow: 0.027, forearm: 0.030, wrist: 0.0195, muscle: 0.0 };
    let leg = Leg { thigh: 0.074, knee: 0.043, calf: 0.045, ankle: 0.029, muscle: 0.35 };
    collar(&mut clay, &skeleton, 0.026, 0.029);
    arms(&mut clay, &skeleton, &arm);
    let fingers = [0.95, 1.05, 1.0, 0.80];
    let hand = Hand { size: 0.98, fingers: &fingers, thickness: 0.92, curl: 0.10, spread: 30.0, edge: 0.0095 };
    hands(&mut clay, &skeleton, &hand, arm.wrist);
    legs(&mut clay, &skeleton, &leg);
    feet(&mut clay, &skeleton, &Foot { size: 0.95, width: 0.92, toes: 0, edge: 0.011 }, leg.ankle);

    let frame = Frame::upright(skeleton.joints[NECK], 1.0);
    let face = Face {
        wide: 0.90,
        jaw: 0.92,
        chin: 0.7,
        nose: 0.8,
        nostrils: 0.80,
        brow: 0.7,
        eyes: 1.15,
        lips: 1.25,
        mouth: 0.85,
        ears: 0.85,
        eyebrows: 0.7,
        ..PLAIN
    };
    neck(&mut clay, &skeleton, frame.at(0.0, 0.012, 0.070), 0.035, 0.033);
    head(&mut clay, &frame, &face);
    let mut cap = hair(&frame, &face, 0.150, 0.050, 0.009);
    cap.lump(&frame, [0.0, 0.095, 0.190], [0.044, 0.042, 0.040], 0.008, Owner::Joint(NECK));
    let mut parts = vec![clay.harden(), cap.harden()];
    parts.extend(features(&frame, &face, 0.8, -0.10));
    assemble(skeleton, parts)
}
