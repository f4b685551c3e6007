//! Which of the tables of names a rig follows.

use std::collections::{HashMap, HashSet};

use super::affixes::Levels;
use super::profiles::{ALL, Profile};
use super::slot::Slot;
use super::tokens::{Words, is_number, key};
use super::tree::Tree;
use super::vocabulary::Place;
use crate::rig::body_part::Side;

/// Stands in a key for any number.
const ANY: &str = "ǁ";
/// A table is followed where it has at least so many parts of the body other than fingers.
const LEAST_PARTS: usize = 6;
/// Each joint that stands in the wrong order to its limb takes so many parts off.
const WRONG_ORDER: f64 = 0.75;

/// A name in a table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Row {
    /// What it stands for.
    pub slot: Slot,
    /// Which bone, where it is one of a finger.
    pub place: Place,
}

/// A table that a rig follows.
pub struct Match {
    /// Its name.
    pub profile: &'static str,
    /// What it says of each joint.
    pub rows: Vec<Option<Row>>,
}

/// A table, ready to look names up in.
struct Table {
    rows: HashMap<(String, bool), Row>,
}

impl Table {
    fn new(profile: &Profile) -> Self {
        let mut rows = HashMap::new();
        let prefixes: Vec<Vec<String>> = profile.prefixes.iter().map(|prefix| Words::new(prefix).words).collect();
        for &(slot, names) in profile.rows {
            for (index, name) in names.split(',').map(str::trim).enumerate() {
                let place = match slot {
                    Slot::Finger(_) if name.contains('#') => Place::Unsaid,
                    Slot::Finger(_) => Place::Segment(index as u8 + 1),
                    _ => Place::Segment(0),
                };
                let Words { side, words } = Words::new(&name.replace('#', ANY));
                let has_side = name.contains('*') || side.is_some();
                for prefix in std::iter::once(&Vec::new()).chain(&prefixes) {
                    let row = Row { slot, place };
                    rows.entry((key(&[prefix.as_slice(), &words].concat()), has_side)).or_insert(row);
                }
            }
        }
        Self { rows }
    }

    /// What the table says of a name with these keys.
    fn row(&self, keys: &Keys, has_side: bool) -> Option<Row> {
        let row = keys.keys.iter().find_map(|key| self.rows.get(&(key.clone(), has_side)).copied())?;
        let place = match (row.slot, row.place) {
            (Slot::Finger(_), Place::Unsaid) => keys.number.map_or(Place::Unsaid, Place::Number),
            (_, place) => place,
        };
        Some(Row { place, ..row })
    }
}

/// How a name is looked up.
struct Keys {
    /// The name as it is, and with numbers that may be any.
    keys: Vec<String>,
    number: Option<u32>,
}

impl Keys {
    fn new(words: &[String]) -> Self {
        let last = words.iter().rposition(|word| is_number(word));
        let replaced = |which: &dyn Fn(usize) -> bool| -> Vec<String> {
            let word = |(k, word): (usize, &String)| if which(k) { ANY.to_owned() } else { word.clone() };
            words.iter().enumerate().map(word).collect()
        };
        let mut keys = vec![key(words)];
        if last.is_some() {
            keys.push(key(&replaced(&|k| Some(k) == last)));
            keys.push(key(&replaced(&|k| is_number(&words[k]))));
        }
        keys.push(key(&[words, &[ANY.to_owned()]].concat()));
        Self { keys, number: last.and_then(|k| words[k].parse().ok()) }
    }
}

/// The table that has most of the joints with these sides and names; none where all have few.
pub fn best(sides: &[Option<Side>], levels: &Levels, tree: &Tree) -> Option<Match> {
    let keys: Vec<Vec<Keys>> =
        levels.words.iter().map(|names| names.iter().map(|words| Keys::new(words)).collect()).collect();
    let mut best: Option<(f64, Match)> = None;
    for profile in ALL {
        let table = Table::new(profile);
        for keys in &keys {
            let rows: Vec<Option<Row>> =
                keys.iter().zip(sides).map(|(keys, side)| table.row(keys, side.is_some())).collect();
            let Some(score) = score(&rows, sides, tree) else { continue };
            if best.as_ref().is_none_or(|(other, _)| score > *other) {
                best = Some((score, Match { profile: profile.name, rows }));
            }
        }
    }
    best.map(|(_, found)| found)
}

/// Chains in which each part hangs on the one before it.
const ORDERS: [&[Slot]; 2] =
    [&[Slot::UpperArm, Slot::LowerArm, Slot::Hand], &[Slot::UpperLeg, Slot::LowerLeg, Slot::Foot]];

/// How well a table explains a rig: how many parts it finds, and a little for all else that it knows.
fn score(rows: &[Option<Row>], sides: &[Option<Side>], tree: &Tree) -> Option<f64> {
    let (mut parts, mut spines, mut others) = (HashMap::new(), 0, 0);
    let mut bones = HashSet::new();
    for (joint, (row, side)) in (0u32..).zip(rows.iter().zip(sides)) {
        let Some(row) = row else { continue };
        match (row.slot, row.slot.part(*side)) {
            (Slot::Spine | Slot::Neck | Slot::Trunk | Slot::Arm | Slot::Leg, _) => spines += 1,
            (_, Some(_)) => {
                parts.entry((row.slot, *side)).or_insert(joint);
            }
            (Slot::Finger(_) | Slot::Palm(_), _) => {
                bones.insert((row.slot, *side, format!("{:?}", row.place)));
            }
            _ => others += 1,
        }
    }
    let count = parts.len() + spines;
    if count < LEAST_PARTS {
        return None;
    }
    let mut wrong = 0;
    for order in ORDERS {
        for side in Side::BOTH {
            let at = |slot: &Slot| parts.get(&(*slot, Some(side))).copied();
            for pair in order.windows(2) {
                if let (Some(upper), Some(lower)) = (at(&pair[0]), at(&pair[1])) {
                    wrong += usize::from(tree.is_above(lower, upper));
                }
            }
        }
    }
    Some(count as f64 - WRONG_ORDER * wrong as f64 + 0.2 * bones.len() as f64 + 0.1 * f64::from(others))
}
