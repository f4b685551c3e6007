//! Neck, head and its top.

use glam::DVec3;

use super::tree::Tree;
use crate::rig::body_part::BodyPart;

/// The head moves at least this share of what the joint moves that moves most, of those that leave the shoulders upwards: the neck
/// moves less, and hair may move more.
const OF_MOST: f64 = 0.5;
/// Where the next one moves more than this share it may be the head as well.
const ALSO: f64 = 0.3;
/// The last of several joints is the top of the head where it is so far from the one before, in lengths of the trunk, and the head
/// where it is nearer than the other; between the two both are likely.
const HEAD: f64 = 0.5;
const NECK: f64 = 0.12;
/// A joint with so many neighbours, of those above the shoulders, is the head: a neck and three parts of a face.
const FACE: usize = 4;
/// Shoulders lower than the joint that they leave by this share of the trunk leave a neck.
const LOWER: f64 = 0.03;

/// What rises from the shoulders.
pub struct Rising {
    /// Whether the joint that the arms leave is the neck.
    pub from_neck: bool,
    /// The parts of the joints above it.
    pub parts: Vec<BodyPart>,
    /// No other reading is about as likely.
    pub sure: bool,
}

/// Reads the joints above the one that the arms leave, `base`; `trunk` is the trunk's length, and `shoulder` how high the shoulders
/// are above that joint.
pub fn read(tree: &Tree<'_>, base: u32, way: &[u32], trunk: f64, shoulder: Option<f64>) -> Rising {
    let (head, has_top, sure) = find_head(tree, base, way, trunk);
    // Above the shoulders there is a neck, by a joint of its own or by that which the arms leave.
    let from_neck = head == Some(0) && shoulder.is_some_and(|height| height < -LOWER * trunk);
    let part = |k: usize| match head {
        Some(head) if k < head => Some(BodyPart::Neck),
        Some(head) if k == head => Some(BodyPart::Head),
        Some(head) if k == head + 1 && has_top => Some(BodyPart::HeadTop),
        _ => None,
    };
    Rising { from_neck, parts: (0..way.len()).map_while(part).collect(), sure }
}

/// Which joint on the way is the head, whether the next is its top, and whether that is sure.
fn find_head(tree: &Tree<'_>, base: u32, way: &[u32], trunk: f64) -> (Option<usize>, bool, bool) {
    let Some(last) = way.len().checked_sub(1) else { return (None, false, false) };
    if let Some(moved) = tree.moved {
        // With all that leaves it aside: the joints of a face.
        let own = |k: usize| {
            let on_way = [k.checked_sub(1).map_or(base, |k| way[k]), way.get(k + 1).copied().unwrap_or(way[k])];
            moved[way[k] as usize] + aside(tree, way[k], on_way, moved)
        };
        let owns: Vec<f64> = (0..way.len()).map(own).collect();
        let most = owns.iter().copied().fold(0.0, f64::max);
        if most > 0.0 {
            let head = owns.iter().position(|&own| own >= OF_MOST * most).unwrap_or(last);
            let next = owns.get(head + 1).copied();
            return (Some(head), next == Some(0.0), next.is_none_or(|own| own < ALSO * most));
        }
    }
    if last == 0 {
        return (Some(0), false, true);
    }
    // Eyes, jaw and ears hang on the head.
    let branches = |k: usize| tree.neighbours[way[k] as usize].len();
    if let Some(head) = (0..last).find(|&k| branches(k) >= FACE) {
        return (Some(head), false, true);
    }
    let length = tree.length(way[last - 1], way[last]) / trunk.max(f64::MIN_POSITIVE);
    let is_top = length > 0.5 * (HEAD + NECK);
    let sure = !(NECK..HEAD).contains(&length) && branches(last - 1) == 2;
    (Some(if is_top { last - 1 } else { last }), is_top, sure)
}

/// What all joints together move that hang on `joint`, but for those by way of two others.
fn aside(tree: &Tree<'_>, joint: u32, on_way: [u32; 2], moved: &[f64]) -> f64 {
    let mut reached: Vec<(u32, u32)> =
        tree.neighbours[joint as usize].iter().filter(|k| !on_way.contains(k)).map(|&k| (joint, k)).collect();
    let mut next = 0;
    let mut sum = 0.0;
    while next < reached.len() {
        let (from, at) = reached[next];
        sum += moved[at as usize];
        reached.extend(tree.neighbours[at as usize].iter().filter(|&&k| k != from).map(|&k| (at, k)));
        next += 1;
    }
    sum
}

/// How high the way rises, and how far it keeps to the trunk's axis on that: of all that leaves the shoulders the head is what
/// is most of both.
pub fn rise(tree: &Tree<'_>, base: u32, way: &[u32], up: DVec3) -> f64 {
    let height = |joint: u32| (tree.place(joint) - tree.place(base)).dot(up);
    way.iter().map(|&joint| height(joint) - tree.aside(base, joint, up)).fold(f64::NEG_INFINITY, f64::max)
}
