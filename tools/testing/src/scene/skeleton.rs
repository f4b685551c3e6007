//! Two skeletons of one topology: random trees of 2 to 9 joints, in the same kind of pose, with different proportions.

use bespoke::input::skeleton::Skeleton;
use glam::{DQuat, DVec3};

use super::{below, between, chance, direction};
use crate::Random;

/// Bones at one joint are at least this angle apart on the source (cosine).
const SPREAD: f64 = 0.45;
/// On the target they may be somewhat nearer.
const TARGET_SPREAD: f64 = 0.6;
/// Bones that share no joint keep this distance.
const APART: f64 = 0.5;
const TARGET_APART: f64 = 0.35;
const MAX_DEGREE: usize = 4;

/// Source and target skeleton. `other_pose` turns the target's bones by up to half a turn instead of up to 20 degrees.
pub fn pair(random: &mut Random, other_pose: bool) -> (Skeleton, Skeleton) {
    let count = 2 + below(random, 8);
    let mut source = Skeleton { joints: vec![DVec3::ZERO], bones: Vec::new() };
    while source.joints.len() < count {
        let Some((parent, joint)) = (0..60).find_map(|_| {
            let last = source.joints.len() - 1;
            let parent = if chance(random, 0.5) { last } else { below(random, last + 1) };
            let joint = source.joints[parent] + between(random, 0.5, 1.2) * direction(random);
            fits(&source, parent as u32, joint, SPREAD, APART).then_some((parent as u32, joint))
        }) else {
            break;
        };
        source.bones.push([parent, source.joints.len() as u32]);
        source.joints.push(joint);
    }
    let target = (0..40)
        .find_map(|attempt| {
            // The longer it takes, the nearer to the source.
            let turn = (1.0 - f64::from(attempt) / 40.0) * if other_pose { 3.0 } else { 0.35 };
            posed(random, &source, turn, other_pose)
        })
        .unwrap_or_else(|| source.clone());
    (source, target)
}

/// `source` with every bone turned by up to `turn` and its length changed; nothing where bones come too near.
fn posed(random: &mut Random, source: &Skeleton, turn: f64, anyhow: bool) -> Option<Skeleton> {
    let size = between(random, 0.7, 1.4);
    let mut target = Skeleton { joints: vec![DVec3::ZERO], bones: Vec::new() };
    for &[parent, child] in &source.bones {
        let span = source.joints[child as usize] - source.joints[parent as usize];
        let rotation = DQuat::from_axis_angle(direction(random), turn * random.unit());
        let joint = target.joints[parent as usize] + rotation * span * size * between(random, 0.75, 1.35);
        if !anyhow && !fits(&target, parent, joint, TARGET_SPREAD, TARGET_APART * size) {
            return None;
        }
        target.bones.push([parent, child]);
        target.joints.push(joint);
    }
    Some(target)
}

/// Whether a bone from `parent` to `joint` is clear of the others.
fn fits(skeleton: &Skeleton, parent: u32, joint: DVec3, spread: f64, apart: f64) -> bool {
    let from = skeleton.joints[parent as usize];
    let way = (joint - from).normalize();
    let at_parent = skeleton.bones.iter().filter(|b| b.contains(&parent)).count();
    at_parent < MAX_DEGREE
        && skeleton.bones.iter().all(|bone| {
            let [a, b] = bone.map(|j| skeleton.joints[j as usize]);
            if bone.contains(&parent) {
                let other = if bone[0] == parent { b } else { a };
                return (other - from).normalize().dot(way) < spread;
            }
            // Sampled: the distance only has to be about right.
            (0..=8).all(|k| distance_to_segment(from.lerp(joint, f64::from(k) / 8.0), a, b) > apart)
        })
}

/// Distance of `p` from the segment from `a` to `b`.
pub fn distance_to_segment(p: DVec3, a: DVec3, b: DVec3) -> f64 {
    let along = ((p - a).dot(b - a) / a.distance_squared(b)).clamp(0.0, 1.0);
    p.distance(a.lerp(b, along))
}
