//! The parts of a body by how a rig is built and where its joints are, for rigs whose names say nothing.
//!
//! A person is two joints from which a pair of limbs of equal length leaves, with the trunk between them: the limbs that go on
//! along the trunk are the legs, and what else leaves the other joint is the head. Which way the tree of parents runs does
//! not matter, so that a skeleton of bones is read like a rig.

use glam::DVec3;

use super::body_part::{BodyPart, Side};

/// Limbs are a pair where their lengths differ by less than this share.
const ALIKE: f64 = 0.12;
/// A limb is longer than this share of the longest way in the rig.
const LEAST_LIMB: f64 = 0.12;
/// Parents in one place, up to this share of the longest way, are one joint.
const SAME_PLACE: f64 = 1e-4;
/// More joints than this are not read by their structure: the ways between all of them are compared.
const MOST_JOINTS: usize = 4096;
/// Of the branches at one joint, of all pairs of limbs, and of the joints of a limb, the longest or first so many are looked at.
const MOST_BRANCHES: usize = 12;
const MOST_PAIRS: usize = 40;
const MOST_SEGMENTS: usize = 24;
/// A joint with so many neighbours is a hand: a forearm and three fingers.
const FINGERS: usize = 4;
/// A joint nearer to the trunk's axis than this share of what lies beyond it is that of a collar bone.
const BREASTBONE: f64 = 0.12;
/// A shoulder is nearer to that axis than this share of what lies beyond it.
const SHOULDER: f64 = 0.6;
/// The two bones of a limb are at least this share of the whole way to its tip.
const LEAST_SHARE: f64 = 0.45;
/// What a bend within one of them counts, beside the difference of their lengths.
const BENT: f64 = 2.0;

/// What the structure says of each joint: a part and how sure that is, from 0 to 1. None where the rig is no person.
pub fn read(places: &[DVec3], parents: &[Option<u32>], used: &[bool]) -> Option<Vec<Option<(BodyPart, f64)>>> {
    if places.len() > MOST_JOINTS {
        return None;
    }
    let tree = Tree::new(places, parents, used)?;
    let person = Person::find(&tree)?;
    Some(person.parts(&tree))
}

/// The joints that are used as a graph without direction, joints in one place taken as one.
struct Tree<'a> {
    places: &'a [DVec3],
    neighbours: Vec<Vec<u32>>,
    /// The longest way from any joint.
    size: f64,
}

impl<'a> Tree<'a> {
    fn new(places: &'a [DVec3], parents: &[Option<u32>], used: &[bool]) -> Option<Self> {
        let low = places.iter().zip(used).filter(|(_, used)| **used).map(|(p, _)| *p).reduce(DVec3::min)?;
        let high = places.iter().zip(used).filter(|(_, used)| **used).map(|(p, _)| *p).reduce(DVec3::max)?;
        let size = (high - low).length();
        let mut neighbours = vec![Vec::new(); places.len()];
        for joint in (0..places.len()).filter(|&joint| used[joint]) {
            // Over joints that lie in the same place, which stand for no bone.
            let mut up = parents[joint];
            while let Some(k) = up
                && (places[k as usize].distance(places[joint]) <= SAME_PLACE * size || !used[k as usize])
            {
                up = parents[k as usize];
            }
            if let Some(k) = up {
                neighbours[joint].push(k);
                neighbours[k as usize].push(joint as u32);
            }
        }
        (size > 0.0).then_some(Self { places, neighbours, size })
    }

    fn length(&self, a: u32, b: u32) -> f64 {
        self.places[a as usize].distance(self.places[b as usize])
    }

    /// How far a joint is from the line through `from` along `up`.
    fn aside(&self, from: u32, joint: u32, up: DVec3) -> f64 {
        let there = self.places[joint as usize] - self.places[from as usize];
        (there - there.dot(up) * up).length()
    }

    /// The longest way from `from` by way of its neighbour `to`, without `from`.
    fn longest(&self, from: u32, to: u32) -> Branch {
        // Every joint once, each after the one it is reached from: that one's place in the list, the joint, how far it is.
        let mut reached = vec![(0, to, self.length(from, to))];
        let mut best = 0;
        let mut next = 0;
        while next < reached.len() {
            let (before, joint, length) = reached[next];
            if length > reached[best].2 {
                best = next;
            }
            let last = if next == 0 { from } else { reached[before].1 };
            let on = self.neighbours[joint as usize].iter().filter(|&&k| k != last);
            reached.extend(on.map(|&k| (next, k, length + self.length(joint, k))));
            next += 1;
        }
        let length = reached[best].2;
        let mut way = vec![reached[best].1];
        while best != 0 {
            best = reached[best].0;
            way.push(reached[best].1);
        }
        way.reverse();
        Branch { length, way }
    }

    /// The joints from `a` to `b`, both included.
    fn way(&self, a: u32, b: u32) -> Option<Vec<u32>> {
        let mut before = vec![None; self.places.len()];
        let mut queue = std::collections::VecDeque::from([a]);
        while let Some(joint) = queue.pop_front() {
            if joint == b {
                let mut way = vec![b];
                while let Some(&last) = way.last()
                    && last != a
                {
                    way.push(before[last as usize]?);
                }
                way.reverse();
                return Some(way);
            }
            for &k in &self.neighbours[joint as usize] {
                if k != a && before[k as usize].is_none() {
                    before[k as usize] = Some(joint);
                    queue.push_back(k);
                }
            }
        }
        None
    }
}

/// The longest way from a joint in one direction.
#[derive(Clone)]
struct Branch {
    length: f64,
    way: Vec<u32>,
}

impl Branch {
    fn tip(&self, tree: &Tree<'_>) -> DVec3 {
        self.way.last().map_or(DVec3::ZERO, |&joint| tree.places[joint as usize])
    }
}

/// Two limbs of equal length that leave a joint.
#[derive(Clone)]
struct Limbs {
    joint: u32,
    pair: [Branch; 2],
}

impl Limbs {
    fn length(&self) -> f64 {
        0.5 * (self.pair[0].length + self.pair[1].length)
    }

    /// The mean of the two tips.
    fn tips(&self, tree: &Tree<'_>) -> DVec3 {
        0.5 * (self.pair[0].tip(tree) + self.pair[1].tip(tree))
    }

    /// The cosine between the limbs and the way on from `other` by way of this joint: 1 where they go on straight.
    fn goes_on(&self, tree: &Tree<'_>, other: u32) -> f64 {
        let here = tree.places[self.joint as usize];
        (self.tips(tree) - here).normalize_or_zero().dot((here - tree.places[other as usize]).normalize_or_zero())
    }
}

/// The pairs of limbs of a rig.
fn limbs(tree: &Tree<'_>) -> Vec<Limbs> {
    let mut found = Vec::new();
    for joint in (0..tree.places.len() as u32).filter(|&joint| tree.neighbours[joint as usize].len() >= 3) {
        let mut branches: Vec<Branch> =
            tree.neighbours[joint as usize].iter().map(|&to| tree.longest(joint, to)).collect();
        branches.sort_by(|a, b| b.length.total_cmp(&a.length));
        branches.truncate(MOST_BRANCHES);
        for (k, a) in branches.iter().enumerate() {
            for b in &branches[k + 1..] {
                let longer = a.length.max(b.length);
                let apart = a.tip(tree).distance(b.tip(tree));
                if longer > LEAST_LIMB * tree.size
                    && (a.length - b.length).abs() < ALIKE * longer
                    && apart > 0.1 * longer
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

/// Legs, arms and what is between and above.
struct Person {
    legs: Limbs,
    arms: Limbs,
    /// From the legs' joint to the arms', both included.
    trunk: Vec<u32>,
    /// From the arms' joint on, without it; may be empty.
    head: Vec<u32>,
}

impl Person {
    fn find(tree: &Tree<'_>) -> Option<Self> {
        let pairs = limbs(tree);
        let mut best: Option<(f64, usize, usize)> = None;
        for (l, legs) in pairs.iter().enumerate() {
            for (a, arms) in pairs.iter().enumerate() {
                let first = |limbs: &Limbs| [limbs.pair[0].way[0], limbs.pair[1].way[0]];
                let Some(trunk) = (legs.joint != arms.joint).then(|| tree.way(legs.joint, arms.joint)).flatten() else {
                    continue;
                };
                // The way from one to the other is no limb of either.
                if trunk.iter().any(|joint| first(legs).contains(joint) || first(arms).contains(joint)) {
                    continue;
                }
                let straight = legs.goes_on(tree, arms.joint) - arms.goes_on(tree, legs.joint);
                let score = straight + (2.0 * legs.length() + arms.length()) / tree.size;
                if best.is_none_or(|(most, ..)| score > most) {
                    best = Some((score, l, a));
                }
            }
        }
        let (_, l, a) = best?;
        let (legs, arms) = (pairs[l].clone(), pairs[a].clone());
        if legs.goes_on(tree, arms.joint) < 0.3 {
            return None;
        }
        let trunk = tree.way(legs.joint, arms.joint)?;
        let taken = [trunk[trunk.len() - 2], arms.pair[0].way[0], arms.pair[1].way[0]];
        let others = tree.neighbours[arms.joint as usize].iter().filter(|joint| !taken.contains(joint));
        let head = others.map(|&to| tree.longest(arms.joint, to)).max_by(|a, b| a.length.total_cmp(&b.length));
        Some(Self { legs, arms, trunk, head: head.map_or_else(Vec::new, |branch| branch.way) })
    }

    /// The direction from the legs' joint to the arms'.
    fn up(&self, tree: &Tree<'_>) -> DVec3 {
        (tree.places[self.arms.joint as usize] - tree.places[self.legs.joint as usize]).normalize_or_zero()
    }

    fn parts(&self, tree: &Tree<'_>) -> Vec<Option<(BodyPart, f64)>> {
        const SURE: f64 = 0.7;
        let mut parts = vec![None; tree.places.len()];
        let up = self.up(tree);
        let legs = [0, 1].map(|k| segments(tree, &self.legs.pair[k].way));
        let hips = self.hips_apart(tree, up, &legs);
        let arms = [0, 1].map(|k| {
            let way = &self.arms.pair[k].way;
            let first = usize::from(self.begins_with_collar(tree, up, way, hips));
            segments(tree, &way[first..]).map(|at| at.map(|at| at + first))
        });
        let (left_leg, leg_sure) = self.left(tree, up, &self.legs, &legs);
        let (left_arm, arm_sure) = self.left(tree, up, &self.arms, &legs);
        for (k, &joint) in self.trunk.iter().enumerate() {
            parts[joint as usize] = Some((if k == 0 { BodyPart::Hips } else { BodyPart::Spine }, SURE));
        }
        for k in 0..2 {
            let side = if k == left_leg { Side::Left } else { Side::Right };
            let way = &self.legs.pair[k].way;
            let [hip, knee, ankle] = legs[k];
            let mut set = |at: Option<usize>, part| {
                if let Some(&joint) = at.and_then(|at| way.get(at)) {
                    parts[joint as usize] = Some((part, leg_sure));
                }
            };
            set(hip, BodyPart::UpperLeg(side));
            set(knee, BodyPart::LowerLeg(side));
            set(ankle, BodyPart::Foot(side));
            set(ankle.map(|at| at + 1), BodyPart::Toes(side));
            let side = if k == left_arm { Side::Left } else { Side::Right };
            let way = &self.arms.pair[k].way;
            let [shoulder, elbow, wrist] = arms[k];
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

    /// How far the legs begin from the trunk's axis, in the mean.
    fn hips_apart(&self, tree: &Tree<'_>, up: DVec3, legs: &[[Option<usize>; 3]; 2]) -> f64 {
        let hip = |k: usize| self.legs.pair[k].way.get(legs[k][0]?).copied();
        let apart: Vec<f64> = (0..2).filter_map(hip).map(|hip| tree.aside(self.legs.joint, hip, up)).collect();
        apart.iter().sum::<f64>() / apart.len().max(1) as f64
    }

    /// Whether an arm begins with a collar bone, whose joint is beside the breastbone, or nearer to the trunk's axis than the `hips`:
    /// in all people shoulders are farther apart than these. What comes next is then a shoulder and no elbow, so that most of the
    /// arm lies beyond it.
    fn begins_with_collar(&self, tree: &Tree<'_>, up: DVec3, way: &[u32], hips: f64) -> bool {
        let Some((&first, rest)) = way.split_first().filter(|(_, rest)| rest.len() >= 3) else { return false };
        let (next, tip) = (rest[0], rest[rest.len() - 1]);
        let aside = |joint: u32| tree.aside(self.arms.joint, joint, up);
        let is_shoulder = aside(first) < aside(next) && aside(next) < SHOULDER * tree.length(next, tip);
        aside(first) < BREASTBONE * tree.length(first, tip) || (aside(first) < hips && is_shoulder)
    }

    /// Neck, head and its top, from how many joints there are, and whether the arms leave from below the shoulders, at the
    /// chest, or from above them, at the neck.
    fn read_head(
        &self,
        tree: &Tree<'_>,
        up: DVec3,
        arms: &[[Option<usize>; 3]; 2],
        parts: &mut [Option<(BodyPart, f64)>],
    ) {
        let height = |joint: u32| tree.places[joint as usize].dot(up);
        let shoulders: Vec<f64> =
            (0..2).filter_map(|k| Some(height(*self.arms.pair[k].way.get(arms[k][0]?)?))).collect();
        let shoulder = shoulders.iter().sum::<f64>() / shoulders.len().max(1) as f64;
        let is_neck = !shoulders.is_empty() && height(self.arms.joint) > shoulder;
        let sure = 0.6;
        if is_neck {
            parts[self.arms.joint as usize] = Some((BodyPart::Neck, sure));
        }
        let list: &[BodyPart] = match (is_neck, self.head.len()) {
            (true, 1) => &[BodyPart::HeadTop],
            (true, _) => &[BodyPart::Head, BodyPart::HeadTop],
            (false, 1) => &[BodyPart::Head],
            (false, 2) => &[BodyPart::Neck, BodyPart::Head],
            (false, _) => &[BodyPart::Neck, BodyPart::Head, BodyPart::HeadTop],
        };
        for (&joint, &part) in self.head.iter().zip(list) {
            parts[joint as usize] = Some((part, sure));
        }
    }

    /// Which of two limbs is on the left, and how sure that is: feet point forward; without feet, a body faces along +z.
    fn left(&self, tree: &Tree<'_>, up: DVec3, limbs: &Limbs, legs: &[[Option<usize>; 3]; 2]) -> (usize, f64) {
        let foot = |k: usize| {
            let (way, ankle) = (&self.legs.pair[k].way, legs[k][2]?);
            let (ankle, tip) = (*way.get(ankle)?, *way.last()?);
            Some(tree.places[tip as usize] - tree.places[ankle as usize])
        };
        let feet = (0..2).filter_map(foot).sum::<DVec3>();
        let forward = feet - feet.dot(up) * up;
        let sees = forward.length() > 0.01 * tree.size;
        let forward = if sees { forward } else { DVec3::Z };
        let left = up.cross(forward);
        let across = limbs.pair[0].tip(tree) - limbs.pair[1].tip(tree);
        (usize::from(across.dot(left) < 0.0), if sees { 0.7 } else { 0.5 })
    }
}

/// The three joints of a limb: where it begins, its middle and where hand or foot begin, as places on its `way`. The two
/// bones between them are straight and of about the same length; what comes before is a collar bone, and what comes after
/// a hand, from which fingers branch off, or a foot.
fn segments(tree: &Tree<'_>, way: &[u32]) -> [Option<usize>; 3] {
    let mut along = vec![0.0];
    for pair in way.windows(2) {
        along.push(along[along.len() - 1] + tree.length(pair[0], pair[1]));
    }
    let total = along[along.len() - 1];
    let count = way.len().min(MOST_SEGMENTS);
    match count {
        0 => return [None; 3],
        1 => return [Some(0), None, None],
        2 => return [Some(0), Some(1), None],
        _ => {}
    }
    let has_fingers = |&k: &usize| tree.neighbours[way[k] as usize].len() >= FINGERS;
    let hand = (2..count).find(has_fingers);
    let mut best = (f64::INFINITY, [0, 1, 2]);
    for a in 0..count - 2 {
        for b in a + 1..count - 1 {
            for c in b + 1..count {
                let (upper, lower) = (along[b] - along[a], along[c] - along[b]);
                let both = upper + lower;
                if hand.is_some_and(|hand| hand != c) || both < LEAST_SHARE * total {
                    continue;
                }
                let straight = tree.length(way[a], way[b]) + tree.length(way[b], way[c]);
                let cost = ((upper - lower).abs() + BENT * (both - straight)) / both.max(f64::MIN_POSITIVE);
                if cost < best.0 - 1e-9 {
                    best = (cost, [a, b, c]);
                }
            }
        }
    }
    best.1.map(Some)
}
