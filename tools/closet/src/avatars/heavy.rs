//! The heavy human: a stout man with a hanging belly, a double chin, a moustache and a wreath of hair.

use super::super::Sample;
use super::super::implicit::Owner;
use super::super::skeleton::{NECK, Proportions, ROOT, WAIST};
use super::clay::{Clay, Frame, SIDES, assemble, rigid};
use super::extremities::{Foot, Hand, feet, hands};
use super::figure::{Arm, Leg, Trunk, arms, collar, legs, neck, ring, trunk};
use super::head::{Face, PLAIN, features, hair, head};
use super::sweep;

/// Models the body.
pub fn heavy() -> Sample {
    let skeleton = Proportions {
        ankle: 0.080,
        shin: 0.410,
        thigh: 0.415,
        leg_angle: 9.5,
        hip: 0.122,
        belly: 0.110,
        chest: 0.450,
        hunch: 0.020,
        shoulder: 0.205,
        shoulder_drop: 0.100,
        upper_arm: 0.265,
        forearm: 0.235,
        arm_angle: 46.0,
    }
    .skeleton();
    let mut clay = Clay::new(0.034, 0.010);
    trunk(
        &mut clay,
        &skeleton,
        &[
            ring(-0.45, 0.125, 0.080, 0.110),
            ring(-0.05, 0.205, 0.120, 0.130),
            ring(0.40, 0.220, 0.150, 0.125),
            ring(0.90, 0.215, 0.165, 0.115),
            ring(1.25, 0.205, 0.165, 0.118),
            ring(1.60, 0.192, 0.140, 0.130),
            ring(1.90, 0.172, 0.105, 0.130),
            ring(2.20, 0.130, 0.072, 0.105),
            ring(2.75, 0.075, 0.050, 0.066),
        ],
    );
    let place = Trunk::of(&skeleton);
    let own = place.owner();
    clay.ball(place.at(0.0, -0.105, 0.95), [0.180, 0.165, 0.165], 0.09, own);
    clay.ball(place.at(0.0, -0.110, 0.10), [0.170, 0.120, 0.080], 0.045, Owner::Joint(ROOT));
    for side in SIDES {
        // Hips over the belt, breast, seat and the fold under the shoulder blade.
        clay.ball(place.at(side * 0.150, 0.000, 0.60), [0.095, 0.125, 0.090], 0.06, own);
        clay.ball(place.at(side * 0.084, -0.112, 1.60), [0.086, 0.066, 0.076], 0.055, Owner::Joint(WAIST));
        clay.ball(place.at(side * 0.092, 0.085, -0.12), [0.110, 0.095, 0.110], 0.045, Owner::Joint(ROOT));
        clay.ball(place.at(side * 0.100, 0.070, 1.66), [0.100, 0.064, 0.110], 0.07, Owner::Joint(WAIST));
    }
    let arm = Arm { shoulder: 0.072, upper: 0.067, elbow: 0.050, forearm: 0.052, wrist: 0.032, muscle: 0.0 };
    let leg = Leg { thigh: 0.118, knee: 0.068, calf: 0.072, ankle: 0.045, muscle: 0.0 };
    collar(&mut clay, &skeleton, 0.052, 0.054);
    arms(&mut clay, &skeleton, &arm);
    let fingers = [0.88, 0.95, 0.90, 0.75];
    let hand = Hand { size: 1.05, fingers: &fingers, thickness: 1.16, curl: 0.14, spread: 46.0, edge: 0.0115 };
    hands(&mut clay, &skeleton, &hand, arm.wrist);
    legs(&mut clay, &skeleton, &leg);
    feet(&mut clay, &skeleton, &Foot { size: 1.0, width: 1.22, toes: 0, edge: 0.014 }, leg.ankle);

    let frame = Frame::upright(skeleton.joints[NECK], 1.06);
    let face = Face {
        wide: 1.20,
        jaw: 1.15,
        chin: 0.8,
        cheeks: 1.45,
        brow: 1.15,
        nose: 1.05,
        nostrils: 1.45,
        lips: 0.95,
        mouth: 0.95,
        ears: 1.10,
        eyebrows: 1.35,
        ..PLAIN
    };
    neck(&mut clay, &skeleton, frame.at(0.0, 0.012, 0.060), 0.070, 0.062);
    head(&mut clay, &frame, &face);
    clay.lump(&frame, [0.0, -0.040, -0.022], [0.066, 0.052, 0.030], 0.018, Owner::Joint(NECK));
    let mut wreath = hair(&frame, &face, 0.140, 0.050, 0.009);
    wreath.hollow(&frame, [0.0, -0.035, 0.230], [0.110, 0.130, 0.100], 0.012, Owner::Joint(NECK));
    let mut parts = vec![clay.harden(), wreath.harden()];
    parts.extend(features(&frame, &face, 0.62, 0.10));
    for side in SIDES {
        let rings = [
            (0.002, -0.110, 0.0395, 0.0055),
            (0.014, -0.112, 0.0385, 0.0095),
            (0.030, -0.103, 0.0330, 0.0085),
            (0.047, -0.090, 0.0330, 0.0050),
            (0.058, -0.083, 0.0430, 0.0015),
        ]
        .map(|(x, y, z, r)| sweep::ring(frame.at(side * x, y, z), 1.1 * r, r));
        parts.push(rigid(sweep::sweep(&rings, frame.rotation.z_axis, 7, 9), NECK));
    }
    assemble(skeleton, parts)
}
