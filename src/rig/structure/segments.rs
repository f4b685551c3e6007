//! Where the two long bones of a limb are.

use super::tree::Tree;

/// Of the joints of a limb the first so many are looked at.
const MOST_SEGMENTS: usize = 24;
/// A joint with so many neighbours is a hand: a forearm and three fingers.
const FINGERS: usize = 4;
/// With a thumb and one finger it is one too where each of them has two joints or more.
const MITTEN: usize = 3;
/// The two bones of a limb are at least this share of the whole way to its tip.
const LEAST_SHARE: f64 = 0.45;
/// What a bend within one of them counts, beside the difference of their lengths.
const BENT: f64 = 2.0;
/// What the way to where they begin counts: a collar bone may be left that does not look like one.
const SKIPPED: f64 = 0.5;
/// What lies beyond them, hand or foot, is no more than this share of the whole, and what it counts where it is more.
const MOST_BEYOND: f64 = 0.35;
const BEYOND: f64 = 1.0;
/// Another choice whose cost is so little above that of the best is about as likely.
const AS_LIKELY: f64 = 0.03;

/// The joints of a limb by their places on its way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Segments {
    /// Where it begins, its middle, and where hand or foot begin.
    pub at: [Option<usize>; 3],
    /// No other choice is about as likely.
    pub sure: bool,
}

/// The three joints of a limb. The two bones between them are straight and of about the same length; what comes before is a collar
/// bone, and what comes after a hand, from which fingers branch off, or a foot.
pub fn find(tree: &Tree<'_>, way: &[u32], is_arm: bool) -> Segments {
    let mut along = vec![0.0];
    for pair in way.windows(2) {
        along.push(along[along.len() - 1] + tree.length(pair[0], pair[1]));
    }
    let total = along[along.len() - 1];
    let count = way.len().min(MOST_SEGMENTS);
    match count {
        0 => return Segments { at: [None; 3], sure: false },
        1 => return Segments { at: [Some(0), None, None], sure: false },
        2 => return Segments { at: [Some(0), Some(1), None], sure: true },
        _ => {}
    }
    let hand = if is_arm { (2..count).find(|&k| has_fingers(tree, way, k)) } else { None };
    let mut found = Vec::new();
    for a in 0..count - 2 {
        for b in a + 1..count - 1 {
            for c in b + 1..count {
                let (upper, lower) = (along[b] - along[a], along[c] - along[b]);
                let both = upper + lower;
                if hand.is_some_and(|hand| hand != c) || both < LEAST_SHARE * total {
                    continue;
                }
                let straight = tree.length(way[a], way[b]) + tree.length(way[b], way[c]);
                let beyond = ((total - along[c]) / total - MOST_BEYOND).max(0.0);
                let cost = ((upper - lower).abs() + BENT * (both - straight)) / both.max(f64::MIN_POSITIVE)
                    + SKIPPED * along[a] / total
                    + BEYOND * beyond;
                found.push((cost, [a, b, c]));
            }
        }
    }
    // Joints along one bone, such as those that take a share of its twist, make choices that differ by little.
    let Some(&(least, at)) = found.iter().min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1))) else {
        return Segments { at: [Some(0), Some(1), Some(2)], sure: false };
    };
    let near = |k: usize, other: usize| (along[k] - along[other]).abs() < 0.1 * total;
    let differs = |other: &[usize; 3]| (0..3).any(|k| !near(at[k], other[k]));
    let sure = !found.iter().any(|(cost, other)| *cost < least + AS_LIKELY && differs(other));
    Segments { at: at.map(Some), sure }
}

/// Whether fingers leave from the joint at place `k` of a way.
fn has_fingers(tree: &Tree<'_>, way: &[u32], k: usize) -> bool {
    let neighbours = &tree.neighbours[way[k] as usize];
    let is_finger = |&&joint: &&u32| joint != way[k - 1] && tree.longest(way[k], joint).way.len() >= 2;
    neighbours.len() >= FINGERS || (neighbours.len() == MITTEN && neighbours.iter().filter(is_finger).count() == 2)
}
