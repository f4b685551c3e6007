//! A last joint at the tip of its limb, such as an ankle at the sole, where the other skeleton's is before it: what ends there
//! in the design, a cuff or a hem, would end at the tip and cover all of the hand or foot.
//!
//! Only that the two differ is wrong. Many rigs have their last joints at the tips, in the top of the head or the toes.

use super::{Figure, Flesh, Misplaced};
use crate::input::diagnostic::JointFault;
use crate::maths;
use crate::stage::start::projection::attach;

/// At the tip, the body goes on beyond the joint by less than this share of the bone; before it, by more than the second.
/// In 30 real bodies it went on by 0.15 to 1.1 beyond ankles and wrists, but for one with 0.06, and by up to 0.09 beyond a
/// joint at the top of the head.
const AT_TIP: f64 = 0.1;
const BEFORE_TIP: f64 = 0.12;
/// And by less than this share of what it does in the other figure: 0.4 was the least in real pairs.
const LESS: f64 = 0.2;
/// A joint that is farther from the body than this is at no tip.
const NEAR: f64 = 0.1;
/// A better place is not below this share of the bone.
const LEAST: f64 = 0.5;

/// The joints of `figure` that lie at tips, seen from `other`.
pub(super) fn find(figure: &Figure, other: &Figure) -> Vec<Misplaced> {
    let (Some(flesh), Some(other_flesh)) = (&figure.flesh, &other.flesh) else { return Vec::new() };
    let leaves: Vec<[u32; 2]> = (0..figure.skeleton.joints.len() as u32)
        .filter_map(|joint| match figure.graph.bones_at(joint) {
            &[bone] => Some([bone, joint]),
            _ => None,
        })
        .collect();
    let (beyond, beyond_other) = (figure.reach_beyond(&leaves, flesh), other.reach_beyond(&leaves, other_flesh));
    let at_tip = |(&[bone, joint], (reach, other_reach)): (&[u32; 2], (f64, f64))| {
        let (length, other_length) = (figure.length(bone), other.length(bone));
        let is_tip = reach < AT_TIP * length
            && other_reach > BEFORE_TIP * other_length
            && reach < LESS * other_reach
            && flesh.distance(figure.place(joint)) < NEAR;
        if !is_tip {
            return None;
        }
        // As in the other figure, by the length of the bone or by that of the hand; the nearer of the two.
        let by_bone = (1.0 + reach / length) / (1.0 + other_reach / other_length);
        let by_body = 1.0 + (reach - other_reach) / length;
        let share = by_bone.max(by_body).min(1.0);
        if share < LEAST {
            return None;
        }
        let from = figure.place(figure.other(bone, joint));
        let place = from.lerp(figure.place(joint), share);
        let found = figure.misplaced(bone, joint, JointFault::AtTip, (1.0 - share) * length, Some(place));
        Some(Misplaced { is_sure: figure.becomes_alike(other, bone, joint, share), ..found })
    };
    leaves.iter().zip(beyond.into_iter().zip(beyond_other)).filter_map(at_tip).collect()
}

impl Figure {
    fn length(&self, bone: u32) -> f64 {
        let [a, b] = self.skeleton.bones[bone as usize].map(|joint| self.place(joint));
        a.distance(b)
    }

    /// How far the body goes on beyond each of these bones' ends.
    fn reach_beyond(&self, leaves: &[[u32; 2]], flesh: &Flesh) -> Vec<f64> {
        let mut reach = vec![0.0_f64; self.skeleton.joints.len()];
        for (&p, _) in flesh.mesh.positions.iter().zip(flesh.mesh.used_vertices()).filter(|(_, used)| *used) {
            let (bone, parameter) = attach(&self.graph, &self.skeleton, p, None, &[]);
            let [a, b] = self.skeleton.bones[bone as usize];
            let (joint, beyond) = if parameter > 1.0 { (b, parameter - 1.0) } else { (a, -parameter) };
            reach[joint as usize] = reach[joint as usize].max(beyond * self.length(bone));
        }
        leaves.iter().map(|&[_, joint]| reach[joint as usize]).collect()
    }

    /// Whether the last bone of a limb, this share of it, is more like the other figure's beside the bone that it hangs on. A
    /// hand that the body goes without has its wrist where the mesh ends, and a forearm as it should be.
    fn becomes_alike(&self, other: &Self, bone: u32, joint: u32, share: f64) -> bool {
        let &[first, second] = self.graph.bones_at(self.other(bone, joint)) else { return false };
        let before = if first == bone { second } else { first };
        let ratio = |figure: &Self| figure.length(bone) / figure.length(before);
        let odds = ratio(self) / ratio(other);
        maths::ln(odds * share).abs() < maths::ln(odds).abs()
    }
}
