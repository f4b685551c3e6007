//! Where the joints of a full rig are, from the closet's 15 and the flesh around them.

use std::collections::BTreeMap;

use glam::DVec3;

use super::role::{FINGERS, Role, SIDES};
use crate::Sample;
use crate::skeleton::{ARMS, LEGS, NECK, ROOT, WAIST};

/// The place of every role, in the body's unit.
pub fn places(body: &Sample) -> BTreeMap<Role, DVec3> {
    let j = &body.skeleton.joints;
    // Vertices that move with a joint.
    let flesh = |joint: usize| {
        let row = &body.skin[joint];
        body.mesh.positions.iter().zip(row).filter(|(_, weight)| **weight > 0.5).map(|(p, _)| *p)
    };
    let floor = body.mesh.positions.iter().map(|p| p.z).fold(f64::INFINITY, f64::min);
    let mut places = BTreeMap::new();
    let mut put = |role: Role, place: DVec3| places.insert(role, place);

    let ground = DVec3::new(0.0, 0.0, floor);
    for role in [Role::Root, Role::FeetControl, Role::HandsControl] {
        put(role, ground);
    }
    put(Role::Hips, j[ROOT]);
    put(Role::Spine(0), j[ROOT].lerp(j[WAIST], 0.6));
    put(Role::Spine(1), j[WAIST].lerp(j[NECK], 0.2));
    put(Role::Spine(2), j[WAIST].lerp(j[NECK], 0.5));
    put(Role::Neck, j[WAIST].lerp(j[NECK], 0.86));
    put(Role::Head, j[NECK]);
    let head: Vec<DVec3> = flesh(NECK).collect();
    let top = head.iter().map(|p| p.z).fold(j[NECK].z + 0.2 * j[NECK].distance(j[WAIST]), f64::max);
    let middle = head.iter().map(|p| p.y).sum::<f64>() / head.len().max(1) as f64;
    put(Role::HeadEnd, DVec3::new(j[NECK].x, middle, top));

    for (side, ([shoulder, elbow, wrist], [hip, knee, ankle])) in SIDES.into_iter().zip(ARMS.into_iter().zip(LEGS)) {
        let [a, b, c] = [shoulder, elbow, wrist].map(|joint| j[joint]);
        let inner = j[WAIST].lerp(j[NECK], 0.78);
        put(Role::Clavicle(side), DVec3::new(0.16 * a.x, inner.y - 0.01, 0.5 * (inner.z + a.z)));
        put(Role::UpperArm(side), a);
        put(Role::UpperArmTwist(side), 0.5 * (a + b));
        put(Role::LowerArm(side), b);
        put(Role::LowerArmTwist(side), 0.5 * (b + c));
        put(Role::Wrist(side), c);

        let along = (c - b).normalize();
        let across = DVec3::NEG_Y.reject_from_normalized(along).normalize();
        let length = flesh(wrist).map(|p| (p - c).dot(along)).fold(0.3 * b.distance(c), f64::max);
        put(Role::Hand(side), c + 0.18 * length * along);
        put(Role::Slot(side), c + 0.5 * length * along);
        for finger in 0..FINGERS {
            // The thumb starts nearer and stands off; the others lie side by side.
            let (start, v) = if finger == 0 { (0.15, 0.22) } else { (0.5, 0.15 - 0.1 * (finger - 1) as f64) };
            for k in 0..3 {
                let spread = if finger == 0 { 0.1 * k as f64 } else { 0.0 };
                let at = length * (start + 0.16 * k as f64);
                put(Role::Finger(side, finger, k), c + at * along + (v + spread) * length * across);
            }
        }
        put(Role::HandTarget(side), c);
        put(Role::ElbowPole(side), b + 2.0 * b.distance(a) * DVec3::Y);

        let [a, b, c] = [hip, knee, ankle].map(|joint| j[joint]);
        put(Role::Thigh(side), a);
        put(Role::ThighTwist(side), 0.5 * (a + b));
        put(Role::Calf(side), b);
        put(Role::Foot(side), c);
        let low = floor + 0.2 * (c.z - floor);
        let front = flesh(ankle).fold(c - 0.25 * b.distance(c) * DVec3::Y, |tip, p| if p.y < tip.y { p } else { tip });
        put(Role::Toe(side), c.lerp(front, 0.68).with_z(low));
        put(Role::ToeEnd(side), front.with_z(low));
        put(Role::FootTarget(side), c);
        put(Role::KneePole(side), b - 1.2 * b.distance(a) * DVec3::Y);
    }
    places
}
