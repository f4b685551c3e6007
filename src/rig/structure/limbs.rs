//! Pairs of limbs.

use glam::DVec3;

use super::tree::{Branch, Tree};

/// Limbs are a pair where their lengths differ by less than this share.
const ALIKE: f64 = 0.12;
/// A limb is longer than this share of the rig's size.
const LEAST_LIMB: f64 = 0.12;
/// Of the branches at one joint, and of all pairs of limbs, the longest so many are looked at.
const MOST_BRANCHES: usize = 12;
const MOST_PAIRS: usize = 40;
/// And their tips are farther apart than this share of their length.
const APART: f64 = 0.04;
/// What has fewer joints is no limb, but what a chain of joints is to reach for.
const LEAST_JOINTS: usize = 2;

/// Two limbs of equal length that leave a joint.
#[derive(Clone)]
pub struct Limbs {
    pub joint: u32,
    pub pair: [Branch; 2],
}

impl Limbs {
    pub fn length(&self) -> f64 {
        0.5 * (self.pair[0].length + self.pair[1].length)
    }

    /// The mean cosine between the two limbs and the way on from `other` by way of their joint: 1 where they go on straight.
    pub fn goes_on(&self, tree: &Tree<'_>, other: u32) -> f64 {
        let on = (tree.place(self.joint) - tree.place(other)).normalize_or_zero();
        // From their first joints on: hips may hang on a joint that stands on the floor.
        let along = |limb: &Branch| (limb.tip(tree) - tree.place(limb.way[0])).normalize_or_zero().dot(on);
        0.5 * (along(&self.pair[0]) + along(&self.pair[1]))
    }

    /// By how much one of the two is nearer to `other` than the other one, as a share of the rig's size.
    pub fn unevenness(&self, tree: &Tree<'_>, other: u32) -> f64 {
        let [a, b] = [0, 1].map(|k| self.pair[k].tip(tree).distance(tree.place(other)));
        (a - b).abs() / tree.size
    }

    /// Where the two end.
    pub fn ends(&self) -> [Option<u32>; 2] {
        let mut ends = [0, 1].map(|k| self.pair[k].way.last().copied());
        ends.sort_unstable();
        ends
    }

    /// Whether a joint is in one of these and in one of `others`.
    pub fn shares(&self, others: &Self) -> bool {
        self.pair.iter().flat_map(|limb| &limb.way).any(|joint| others.pair.iter().any(|o| o.way.contains(joint)))
    }
}

/// The pairs of limbs of a rig, the longest first.
pub fn find(tree: &Tree<'_>) -> Vec<Limbs> {
    let mut found = Vec::new();
    for joint in (0..tree.places.len() as u32).filter(|&joint| tree.neighbours[joint as usize].len() >= 3) {
        let mut branches: Vec<Branch> =
            tree.neighbours[joint as usize].iter().map(|&to| tree.longest(joint, to)).collect();
        branches.retain(|branch| branch.way.len() >= LEAST_JOINTS);
        branches.sort_by(|a, b| b.length.total_cmp(&a.length));
        branches.truncate(MOST_BRANCHES);
        for (k, a) in branches.iter().enumerate() {
            for b in &branches[k + 1..] {
                let longer = a.length.max(b.length);
                let apart = a.tip(tree).distance(b.tip(tree));
                if longer > LEAST_LIMB * tree.size
                    && (a.length - b.length).abs() < ALIKE * longer
                    && apart > APART * longer
                    && a.way.len().abs_diff(b.way.len()) <= 1
                {
                    found.push(Limbs { joint, pair: [a.clone(), b.clone()] });
                }
            }
        }
    }
    found.sort_by(|a, b| b.length().total_cmp(&a.length()));
    found.truncate(MOST_PAIRS);
    found
}

/// The middle between the first joints of two limbs that are `at` these places on their ways.
pub fn middle(tree: &Tree<'_>, limbs: &Limbs, at: [Option<usize>; 2]) -> Option<DVec3> {
    let place = |k: usize| Some(tree.place(*limbs.pair[k].way.get(at[k]?)?));
    Some(0.5 * (place(0)? + place(1)?))
}
