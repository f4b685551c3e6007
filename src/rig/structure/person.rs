//! Legs, arms and what is between and above.

use glam::DVec3;

use super::head;
use super::limbs::{self, Limbs};
use super::segments::{self, Segments};
use super::tree::Tree;
use crate::rig::body_part::{BodyPart, Side};

/// How sure a part is that nothing else can well be, and what about as likely is another.
const SURE: f64 = 0.7;
const LIKELY: f64 = 0.6;
const UNSURE: f64 = 0.5;
/// Of all choices of legs and arms the next best, with other ends, is about as likely where its score is so near.
const AS_LIKELY: f64 = 0.25;
/// Hips are nearer to the middle between the legs than this share of the way to the arms.
const NEAR_HIPS: f64 = 0.3;
/// The spine rises from the hips: a joint of the trunk that is above its first one by less than this share of the way to the arms may be
/// the hips as well.
const RISES: f64 = 0.02;
/// Legs go on along the trunk with at least this cosine.
const LEAST_ON: f64 = 0.3;
/// A joint nearer to the trunk's axis than this share of what lies beyond it is that of a collar bone.
const BREASTBONE: f64 = 0.12;
/// One that is farther from it than this share surely is none.
const NO_COLLAR: f64 = 0.2;
/// A shoulder is nearer to that axis than this share of what lies beyond it.
const SHOULDER: f64 = 0.6;
/// A foot that hangs on something else than its leg is as far from the knee as this times the thigh, within these bounds, and
/// so far aside from the line of the thigh, in lengths of the thigh.
const SHIN: [f64; 2] = [0.5, 1.8];
const ASIDE: f64 = 0.6;

/// Legs, arms and what is between and above.
pub struct Person {
    legs: Limbs,
    arms: Limbs,
    /// From the legs' joint to the arms', both included.
    trunk: Vec<u32>,
    /// From the arms' joint on, without it; may be empty.
    head: Vec<u32>,
    /// No other choice of legs and arms is about as likely.
    sure: bool,
}

impl Person {
    pub fn find(tree: &Tree<'_>) -> Option<Self> {
        let pairs = limbs::find(tree);
        let mut scores: Vec<(f64, usize, usize)> = Vec::new();
        for (l, legs) in pairs.iter().enumerate() {
            for (a, arms) in pairs.iter().enumerate() {
                if let Some(score) = score(tree, legs, arms) {
                    scores.push((score, l, a));
                }
            }
        }
        let &(most, l, a) = scores.iter().rev().max_by(|a, b| a.0.total_cmp(&b.0))?;
        let (legs, arms) = (pairs[l].clone(), pairs[a].clone());
        if legs.goes_on(tree, arms.joint) < LEAST_ON {
            return None;
        }
        let ends = |l: usize, a: usize| (pairs[l].ends(), pairs[a].ends());
        let sure = !scores.iter().any(|&(score, k, b)| score > most - AS_LIKELY && ends(k, b) != ends(l, a));
        let trunk = tree.way(legs.joint, arms.joint)?;
        let up = up(tree, &legs, &arms);
        let taken = [trunk[trunk.len() - 2], arms.pair[0].way[0], arms.pair[1].way[0]];
        let others = tree.neighbours[arms.joint as usize].iter().filter(|joint| !taken.contains(joint));
        let others = others.map(|&to| tree.longest(arms.joint, to).way);
        let rise = |way: &Vec<u32>| head::rise(tree, arms.joint, way, up);
        let head = others.max_by(|a, b| rise(a).total_cmp(&rise(b))).unwrap_or_default();
        Some(Self { legs, arms, trunk, head, sure })
    }

    pub fn parts(&self, tree: &Tree<'_>) -> Vec<Option<(BodyPart, f64)>> {
        let mut parts = vec![None; tree.places.len()];
        let up = up(tree, &self.legs, &self.arms);
        let legs = [0, 1].map(|k| segments::find(tree, &self.legs.pair[k].way, false));
        let hips = self.hips_apart(tree, up, &legs);
        let arms = [0, 1].map(|k| {
            let way = &self.arms.pair[k].way;
            let (begins, clear) = self.begins_with_collar(tree, up, way, hips);
            let first = usize::from(begins);
            let found = segments::find(tree, &way[first..], true);
            Segments { at: found.at.map(|at| at.map(|at| at + first)), sure: found.sure && clear }
        });
        let feet = [0, 1].map(|k| self.foot_elsewhere(tree, k, &legs[k]));
        let (left_leg, sees) = self.left(tree, up, &self.legs, &legs);
        let (left_arm, _) = self.left(tree, up, &self.arms, &legs);
        let sure_of = |segments: &[Segments; 2]| {
            let alike = segments[0].at == segments[1].at;
            let sure = self.sure && sees && alike && segments.iter().all(|own| own.sure);
            if sure { SURE } else { UNSURE }
        };
        let (leg_sure, arm_sure) = (sure_of(&legs), sure_of(&arms));
        self.read_trunk(tree, up, &legs, &mut parts);
        for k in 0..2 {
            let side = if k == left_leg { Side::Left } else { Side::Right };
            let way = &self.legs.pair[k].way;
            let [hip, knee, ankle] = legs[k].at;
            let mut set = |joint: Option<u32>, part| {
                if let Some(joint) = joint {
                    parts[joint as usize] = Some((part, leg_sure));
                }
            };
            let at = |place: Option<usize>| place.and_then(|place| way.get(place).copied());
            set(at(hip), BodyPart::UpperLeg(side));
            set(at(knee), BodyPart::LowerLeg(side));
            set(at(ankle), BodyPart::Foot(side));
            set(at(ankle.map(|at| at + 1)), BodyPart::Toes(side));
            if feet.iter().all(Option::is_some) {
                set(feet[k], BodyPart::Foot(side));
            }
            let side = if k == left_arm { Side::Left } else { Side::Right };
            let way = &self.arms.pair[k].way;
            let [shoulder, elbow, wrist] = arms[k].at;
            let mut set = |at: Option<usize>, part| {
                if let Some(&joint) = at.and_then(|at| way.get(at)) {
                    parts[joint as usize] = Some((part, arm_sure));
                }
            };
            set(shoulder.and_then(|at| at.checked_sub(1)), BodyPart::Clavicle(side));
            set(shoulder, BodyPart::UpperArm(side));
            set(elbow, BodyPart::LowerArm(side));
            set(wrist, BodyPart::Hand(side));
        }
        self.read_head(tree, up, &arms, &mut parts);
        parts
    }

    /// Hips and spine. What comes before the first joint near the legs stands elsewhere, such as on the floor; and where the legs hang
    /// on a joint in the belly, as the hips below it do, either may be the hips.
    fn read_trunk(&self, tree: &Tree<'_>, up: DVec3, legs: &[Segments; 2], parts: &mut [Option<(BodyPart, f64)>]) {
        let sure = if self.sure { SURE } else { UNSURE };
        let hips = limbs::middle(tree, &self.legs, legs.map(|own| own.at[0]));
        let from_hips = |joint: u32| hips.map_or(0.0, |hips| tree.place(joint).distance(hips));
        // The arms' joint is none of them.
        let below = &self.trunk[..self.trunk.len() - 1];
        let is_near = |&joint: &u32| from_hips(joint) < NEAR_HIPS * tree.length(joint, self.arms.joint);
        let nearest = || (0..below.len()).min_by(|&a, &b| from_hips(below[a]).total_cmp(&from_hips(below[b])));
        let first = below.iter().position(is_near).or_else(nearest).unwrap_or(0);
        let rises = |joint: u32| {
            let from = self.trunk[first];
            (tree.place(joint) - tree.place(from)).dot(up) > RISES * tree.length(from, self.arms.joint)
        };
        let lower = self.trunk.iter().rposition(|&joint| !rises(joint)).unwrap_or(first);
        for (k, &joint) in self.trunk.iter().enumerate().skip(first) {
            let sure = if lower > first && k <= lower { UNSURE } else { sure };
            parts[joint as usize] = Some((if k == first { BodyPart::Hips } else { BodyPart::Spine }, sure));
        }
    }

    /// How far the legs begin from the trunk's axis, in the mean.
    fn hips_apart(&self, tree: &Tree<'_>, up: DVec3, legs: &[Segments; 2]) -> f64 {
        let hip = |k: usize| self.legs.pair[k].way.get(legs[k].at[0]?).copied();
        let apart: Vec<f64> = (0..2).filter_map(hip).map(|hip| tree.aside(self.legs.joint, hip, up)).collect();
        apart.iter().sum::<f64>() / apart.len().max(1) as f64
    }

    /// Whether an arm begins with a collar bone, whose joint is beside the breastbone, or nearer to the trunk's axis than the `hips`:
    /// in all people shoulders are farther apart than these. What comes next is then a shoulder and no elbow, so that most of the
    /// arm lies beyond it. And whether that is clear.
    fn begins_with_collar(&self, tree: &Tree<'_>, up: DVec3, way: &[u32], hips: f64) -> (bool, bool) {
        let Some((&first, rest)) = way.split_first().filter(|(_, rest)| rest.len() >= 3) else { return (false, true) };
        let (next, tip) = (rest[0], rest[rest.len() - 1]);
        let aside = |joint: u32| tree.aside(self.arms.joint, joint, up);
        let is_shoulder = aside(first) < aside(next) && aside(next) < SHOULDER * tree.length(next, tip);
        let share = aside(first) / tree.length(first, tip).max(f64::MIN_POSITIVE);
        let begins = share < BREASTBONE || (aside(first) < hips && is_shoulder);
        (begins, begins || share > NO_COLLAR)
    }

    /// The foot of a leg that ends with its shin, where it hangs on something else, such as a root on the floor: beyond the knee
    /// and along the thigh, of several the one that moves most.
    fn foot_elsewhere(&self, tree: &Tree<'_>, k: usize, leg: &Segments) -> Option<u32> {
        let [Some(hip), Some(knee), None] = leg.at else { return None };
        let way = &self.legs.pair[k].way;
        let (hip, knee) = (way[hip], way[knee]);
        let thigh = tree.length(hip, knee);
        let along = (tree.place(knee) - tree.place(hip)).normalize_or_zero();
        let of_person = [&self.legs, &self.arms].into_iter().flat_map(|limbs| &limbs.pair).flat_map(|limb| &limb.way);
        let mut is_free = tree.used.clone();
        of_person.chain(&self.trunk).chain(&self.head).for_each(|&joint| is_free[joint as usize] = false);
        let moves = |joint: u32| tree.moved.map_or(0.0, |moved| moved[joint as usize]);
        let beyond = |joint: u32| (tree.place(joint) - tree.place(knee)).dot(along);
        let suits = |joint: u32| {
            let beyond = beyond(joint);
            SHIN[0] * thigh < beyond && beyond < SHIN[1] * thigh && tree.aside(knee, joint, along) < ASIDE * thigh
        };
        let feet = (0..tree.places.len() as u32).filter(|&joint| is_free[joint as usize] && suits(joint));
        feet.max_by(|&a, &b| {
            let by_aside = || tree.aside(knee, b, along).total_cmp(&tree.aside(knee, a, along));
            moves(a).total_cmp(&moves(b)).then_with(by_aside)
        })
    }

    /// Neck, head and its top, by what they move, else by their number and lengths; and whether the arms leave from below the
    /// shoulders, at the chest, or from above them, at the neck.
    fn read_head(&self, tree: &Tree<'_>, up: DVec3, arms: &[Segments; 2], parts: &mut [Option<(BodyPart, f64)>]) {
        let base = self.arms.joint;
        let hips = limbs::middle(tree, &self.legs, [Some(0); 2]);
        let shoulders = limbs::middle(tree, &self.arms, [0, 1].map(|k| arms[k].at[0]));
        let trunk = hips.zip(shoulders).map_or(0.0, |(hips, shoulders)| shoulders.distance(hips));
        let shoulder = shoulders.map(|p| (p - tree.place(base)).dot(up));
        let rising = head::read(tree, base, &self.head, trunk, shoulder);
        let sure = if self.sure && rising.sure { LIKELY } else { UNSURE };
        if rising.from_neck {
            parts[base as usize] = Some((BodyPart::Neck, sure));
        }
        for (&joint, part) in self.head.iter().zip(rising.parts) {
            parts[joint as usize] = Some((part, sure));
        }
    }

    /// Which of two limbs is on the left, and whether that can be seen: feet point forward; without feet, a body faces along +z.
    fn left(&self, tree: &Tree<'_>, up: DVec3, limbs: &Limbs, legs: &[Segments; 2]) -> (usize, bool) {
        let foot = |k: usize| {
            let (way, ankle) = (&self.legs.pair[k].way, legs[k].at[2]?);
            let (ankle, tip) = (*way.get(ankle)?, *way.last()?);
            Some(tree.place(tip) - tree.place(ankle))
        };
        let feet = (0..2).filter_map(foot).sum::<DVec3>();
        let forward = feet - feet.dot(up) * up;
        let sees = forward.length() > 0.01 * tree.size;
        let forward = if sees { forward } else { DVec3::Z };
        let left = up.cross(forward);
        let across = limbs.pair[0].tip(tree) - limbs.pair[1].tip(tree);
        (usize::from(across.dot(left) < 0.0), sees)
    }
}

/// The direction from the legs' joint to the arms'.
fn up(tree: &Tree<'_>, legs: &Limbs, arms: &Limbs) -> DVec3 {
    (tree.place(arms.joint) - tree.place(legs.joint)).normalize_or_zero()
}

/// How well two pairs of limbs do for legs and arms: legs go on along the trunk, arms do not, both are long and even. None where they
/// are not apart.
fn score(tree: &Tree<'_>, legs: &Limbs, arms: &Limbs) -> Option<f64> {
    if legs.joint == arms.joint || legs.shares(arms) {
        return None;
    }
    // The way from one to the other is no limb of either.
    let trunk = tree.way(legs.joint, arms.joint)?;
    let first = |limbs: &Limbs| [limbs.pair[0].way[0], limbs.pair[1].way[0]];
    if trunk.iter().any(|joint| first(legs).contains(joint) || first(arms).contains(joint)) {
        return None;
    }
    let straight = legs.goes_on(tree, arms.joint) - arms.goes_on(tree, legs.joint);
    let uneven = legs.unevenness(tree, arms.joint) + arms.unevenness(tree, legs.joint);
    Some(straight - uneven + (2.0 * legs.length() + arms.length()) / tree.size)
}
