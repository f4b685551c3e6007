//! The child: a large head with big eyes and two bunches of hair, a round belly, short limbs.

use glam::DVec3;

use super::super::Sample;
use super::super::implicit::Owner;
use super::super::skeleton::{NECK, Proportions, ROOT};
use super::clay::{Clay, Frame, SIDES, assemble, rigid};
use super::extremities::{Foot, Hand, feet, hands};
use super::figure::{Arm, Leg, Trunk, arms, collar, legs, neck, ring, trunk};
use super::head::{Face, PLAIN, features, hair, head};
use super::sweep;

/// Models the body.
pub fn child() -> Sample {
    let skeleton = Proportions {
        ankle: 0.060,
        shin: 0.215,
        thigh: 0.225,
        leg_angle: 9.0,
        hip: 0.072,
        belly: 0.080,
        chest: 0.275,
        hunch: 0.004,
        shoulder: 0.112,
        shoulder_drop: 0.062,
        upper_arm: 0.160,
        forearm: 0.145,
        arm_angle: 48.0,
    }
    .skeleton();
    let mut clay = Clay::new(0.021, 0.008);
    trunk(
        &mut clay,
        &skeleton,
        &[
            ring(-0.45, 0.070, 0.050, 0.060),
            ring(0.00, 0.116, 0.078, 0.080),
            ring(0.45, 0.118, 0.094, 0.072),
            ring(1.00, 0.112, 0.094, 0.066),
            ring(1.40, 0.106, 0.080, 0.068),
            ring(1.75, 0.102, 0.066, 0.070),
            ring(2.05, 0.082, 0.050, 0.060),
            ring(2.65, 0.042, 0.036, 0.040),
        ],
    );
    let place = Trunk::of(&skeleton);
    clay.ball(place.at(0.0, -0.042, 0.72), [0.096, 0.074, 0.092], 0.06, place.owner());
    for side in SIDES {
        clay.ball(place.at(side * 0.052, 0.042, -0.10), [0.060, 0.052, 0.060], 0.035, Owner::Joint(ROOT));
    }
    let arm = Arm { shoulder: 0.036, upper: 0.034, elbow: 0.028, forearm: 0.030, wrist: 0.021, muscle: 0.0 };
    let leg = Leg { thigh: 0.064, knee: 0.042, calf: 0.044, ankle: 0.030, muscle: 0.0 };
    collar(&mut clay, &skeleton, 0.026, 0.029);
    arms(&mut clay, &skeleton, &arm);
    let fingers = [0.80, 0.88, 0.84, 0.70];
    let hand = Hand { size: 0.78, fingers: &fingers, thickness: 1.22, curl: 0.12, spread: 44.0, edge: 0.0095 };
    hands(&mut clay, &skeleton, &hand, arm.wrist);
    legs(&mut clay, &skeleton, &leg);
    feet(&mut clay, &skeleton, &Foot { size: 0.72, width: 1.20, toes: 0, edge: 0.011 }, leg.ankle);

    // Higher than on the others, or no collar would find room under the large head.
    let frame = Frame::upright(skeleton.joints[NECK] + 0.022 * DVec3::Z, 1.22);
    let face = Face {
        skull: 1.10,
        wide: 1.12,
        jaw: 0.88,
        chin: 0.4,
        cheeks: 1.35,
        brow: 0.6,
        nose: 0.35,
        nostrils: 0.85,
        eyes: 1.55,
        lips: 0.95,
        mouth: 0.80,
        eyebrows: 0.8,
        ..PLAIN
    };
    neck(&mut clay, &skeleton, frame.at(0.0, 0.012, 0.060), 0.036, 0.036);
    head(&mut clay, &frame, &face);
    let cap = hair(&frame, &face, 0.152, 0.040, 0.010);
    let mut parts = vec![clay.harden(), cap.harden()];
    parts.extend(features(&frame, &face, 0.95, -0.12));
    for side in SIDES {
        // A bunch of hair, and the ring of cloth that holds it.
        let bunch = [
            (0.078, 0.045, 0.168, 0.012),
            (0.108, 0.048, 0.182, 0.019),
            (0.142, 0.052, 0.166, 0.034),
            (0.160, 0.056, 0.118, 0.030),
            (0.164, 0.060, 0.070, 0.004),
        ]
        .map(|(x, y, z, r)| sweep::ring(frame.at(side * x, y, z), r, r));
        parts.push(rigid(sweep::sweep(&bunch, frame.rotation.y_axis, 9, 10), NECK));
        let band =
            [(0.092, 0.176), (0.106, 0.182)].map(|(x, z)| sweep::ring(frame.at(side * x, 0.047, z), 0.023, 0.023));
        parts.push(rigid(sweep::sweep(&band, frame.rotation.y_axis, 9, 3), NECK));
    }
    assemble(skeleton, parts)
}
