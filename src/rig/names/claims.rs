//! What the names of a rig's joints claim to be, and which claims hold.

use std::collections::{HashMap, HashSet};

use super::affixes::Levels;
use super::slot::Slot;
use super::table::{self, Match};
use super::tokens::{Words, is_number};
use super::tree::Tree;
use super::vocabulary::{ARM, FingerBone, LEG, Meaning, Vocabulary};
use super::{Named, Naming, kind};
use crate::rig::body_part::{BodyPart, Side};

/// What the vocabulary claims of a joint that a table knows, for where the table leaves a hole.
const BESIDE_TABLE: f64 = 0.55;
/// What a table calls a helper is a part only where its name says so more clearly.
const HELPER: f64 = 0.85;
/// Where so many limbs say that they move the body, joints that do not say so are controls.
const DEFORMING: usize = 4;
/// How sure a table is, and the vocabulary of a word with one meaning.
pub const BY_TABLE: f64 = 0.95;
pub const BY_WORD: f64 = 0.85;
/// What a table says otherwise is no more than a guess.
pub const AGAINST_TABLE: f64 = 0.55;
/// Weaker claims are of words with several meanings.
pub const CLEAR: f64 = 0.75;
/// A table is named where it says so much of what was found.
const FOLLOWED: f64 = 0.7;

/// The parts that a rig is expected to have: what a table calls a helper is one of these where nothing else is.
pub const NEEDED: [Slot; 7] =
    [Slot::Hips, Slot::UpperArm, Slot::LowerArm, Slot::Hand, Slot::UpperLeg, Slot::LowerLeg, Slot::Foot];

/// A part that a joint claims to be.
#[derive(Clone, Copy, Debug)]
pub struct Claim {
    /// Which part, but for the side.
    pub slot: Slot,
    /// How strong the claim is, about 1 where it is clear.
    pub strength: f64,
    /// Whether a table says so, not the vocabulary.
    pub by_table: bool,
    /// Whether a table says otherwise.
    pub against_table: bool,
}

/// What a joint's name says.
#[derive(Clone, Debug, Default)]
pub struct Joint {
    /// The side in its name, or that of the nearest joint above with one.
    pub side: Option<Side>,
    /// Whether the side is in its name.
    pub says_side: bool,
    /// The parts that it claims to be.
    pub parts: Vec<Claim>,
    /// What it is where it is no part, and whether a table says so.
    pub class: Option<(Slot, bool)>,
    /// The bone of a finger that it claims to be, and whether a table says so.
    pub finger: Option<(FingerBone, bool)>,
    /// The last number in its name.
    pub number: Option<u32>,
}

impl Joint {
    /// The strongest claim to be `slot`.
    pub fn claim(&self, slot: Slot) -> Option<Claim> {
        let claims = self.parts.iter().copied().filter(|claim| claim.slot == slot);
        claims.max_by(|a, b| a.strength.total_cmp(&b.strength))
    }
}

/// The names of a rig's joints: all words, those that it does not share with the others, and what they say.
#[derive(Default)]
struct Names {
    words: Vec<Words>,
    bare: Vec<Vec<String>>,
    meanings: Vec<Meaning>,
}

/// A rig while it is read.
pub struct Reader {
    names: Names,
    /// What hangs on what.
    pub tree: Tree,
    /// What each joint's name says.
    pub joints: Vec<Joint>,
    /// What was found so far, with how sure it is.
    pub found: Vec<Option<(BodyPart, f64)>>,
    taken: HashMap<BodyPart, u32>,
    table: Option<Match>,
}

impl Reader {
    /// Reads every name by itself.
    pub fn new(names: &[&str], parents: &[Option<u32>]) -> Self {
        let vocabulary = Vocabulary::default();
        let tree = Tree::new(names.len(), parents);
        let mut words: Vec<Words> = names.iter().map(|name| Words::new(name)).collect();
        sides_by_letter(&mut words, &vocabulary);
        let levels = Levels::new(&words, &vocabulary);
        let sides: Vec<Option<Side>> = words.iter().map(|words| words.side).collect();
        let table = table::best(&sides, &levels, &tree);
        let meaning = |(words, bare): (&Words, &Vec<String>)| vocabulary.read(bare, words.side.is_some());
        let meanings = words.iter().zip(&levels.bare).map(meaning).collect();
        Self::with(Names { words, bare: levels.bare, meanings }, tree, table)
    }

    /// The same rig without its table, where that says little of what was found.
    pub fn without_table(&mut self) -> Option<Self> {
        if self.table.is_none() || self.profile().is_some() {
            return None;
        }
        let (names, tree) = (std::mem::take(&mut self.names), std::mem::take(&mut self.tree));
        Some(Self::with(names, tree, None))
    }

    fn with(names: Names, tree: Tree, table: Option<Match>) -> Self {
        let row = |index: usize| table.as_ref().and_then(|table| table.rows[index]);
        let one = |index: usize| joint(&names.words[index], &names.bare[index], &names.meanings[index], row(index));
        let mut joints: Vec<Joint> = (0..names.words.len()).map(one).collect();
        drop_controls(&names.words, &mut joints);
        for &index in &tree.order {
            let above = tree.parents[index as usize].and_then(|parent| joints[parent as usize].side);
            let joint = &mut joints[index as usize];
            joint.side = joint.side.or(above);
        }
        Self { names, tree, found: vec![None; joints.len()], joints, taken: HashMap::new(), table }
    }

    /// Says what a joint is, unless something has been said of it or another joint is that part.
    pub fn set(&mut self, joint: u32, part: BodyPart, confidence: f64) -> bool {
        let is_free = self.found[joint as usize].is_none() && (part.is_repeated() || !self.taken.contains_key(&part));
        if is_free {
            self.found[joint as usize] = Some((part, confidence.clamp(0.0, 1.0)));
            self.taken.insert(part, joint);
        }
        is_free
    }

    /// The joint that is `part`, the last that was found of several.
    pub fn joint_of(&self, part: BodyPart) -> Option<u32> {
        self.taken.get(&part).copied()
    }

    /// The joints that claim to be `slot`, of which nothing has been said yet.
    pub fn claimants(&self, slot: Slot) -> Vec<(u32, Claim)> {
        let free = (0u32..).zip(&self.joints).filter(|(joint, _)| self.found[*joint as usize].is_none());
        free.filter_map(|(joint, claims)| Some((joint, claims.claim(slot)?))).collect()
    }

    /// What was found, with the joints that are no part of the body.
    pub fn finish(self) -> Naming {
        let mut naming = Naming {
            profile: self.profile(),
            joints: vec![Named::Unknown; self.joints.len()],
            confidence: vec![0.0; self.joints.len()],
        };
        for (index, joint) in self.joints.iter().enumerate() {
            let (named, sure) = match (self.found[index], joint.class) {
                (Some((part, sure)), _) => (Named::Part(part), sure),
                (None, Some((slot, by_table))) => {
                    (kind(slot).unwrap_or(Named::Unknown), if by_table { 0.9 } else { 0.7 })
                }
                // It was taken for less fitting than another joint of the same limb: a helper beside it.
                (None, None) if self.is_helper(index as u32) => (Named::Twist, 0.5),
                _ => (Named::Unknown, 0.0),
            };
            naming.joints[index] = named;
            naming.confidence[index] = sure;
        }
        naming
    }

    /// Whether a joint has a claim that did not hold, and hangs on the body.
    fn is_helper(&self, index: u32) -> bool {
        let joint = &self.joints[index as usize];
        let is_sided = joint.side.is_some() || joint.parts.iter().any(|claim| claim.slot.part(None).is_some());
        let claims = is_sided && (!joint.parts.is_empty() || joint.finger.is_some());
        claims && self.tree.above(index).any(|above| self.found[above as usize].is_some())
    }

    /// The table's name, where the joints are what it says.
    fn profile(&self) -> Option<&'static str> {
        let table = self.table.as_ref()?;
        let (mut all, mut same) = (0, 0);
        for (index, found) in self.found.iter().enumerate() {
            let Some((part, _)) = found else { continue };
            all += 1;
            same += usize::from(table.rows[index].is_some_and(|row| match row.slot {
                Slot::Finger(_) | Slot::Palm(_) => matches!(part, BodyPart::Finger { .. }),
                Slot::Trunk | Slot::Arm | Slot::Leg | Slot::Neck => true,
                slot => slot.part(part.side()) == Some(*part),
            }));
        }
        (same > 0 && same as f64 >= FOLLOWED * f64::from(all)).then_some(table.profile)
    }
}

/// What one joint's name says.
fn joint(words: &Words, bare: &[String], meaning: &Meaning, row: Option<table::Row>) -> Joint {
    let mut joint = Joint {
        side: words.side,
        says_side: words.side.is_some(),
        number: bare.iter().rev().find(|word| is_number(word)).and_then(|word| word.parse().ok()),
        ..Joint::default()
    };
    let says_other = row.is_some();
    let mut add = |slot, strength, by_table| {
        joint.parts.push(Claim { slot, strength, by_table, against_table: says_other && !by_table });
    };
    let slot = row.map(|row| row.slot);
    match slot {
        None | Some(Slot::Twist | Slot::Control | Slot::Prop | Slot::Secondary) => {}
        Some(Slot::Arm) => ARM.iter().for_each(|&(slot, strength)| add(slot, strength, true)),
        Some(Slot::Leg) => LEG.iter().for_each(|&(slot, strength)| add(slot, strength, true)),
        Some(Slot::Finger(_) | Slot::Palm(_)) => {}
        Some(slot) => add(slot, 1.0, true),
    }
    if slot.is_some_and(|slot| slot == Slot::Trunk || slot.part(None).is_some()) {
        // The L of L5, a vertebra, is no side.
        (joint.side, joint.says_side) = (None, false);
    }
    // What a table calls a control is none of the parts that its words mean.
    if !matches!(slot, Some(Slot::Control | Slot::Prop | Slot::Secondary | Slot::Arm | Slot::Leg)) {
        let share = if slot.is_some() { BESIDE_TABLE } else { 1.0 };
        // A helper is one of the needed parts, where nothing else is and its name says nothing but that.
        let can_be = |&&(part, strength): &&(Slot, f64)| {
            slot != Some(Slot::Twist) || (NEEDED.contains(&part) && strength > HELPER)
        };
        let parts = meaning.parts.iter().filter(can_be);
        parts.for_each(|&(slot, strength)| add(slot, share * strength, false));
    }
    joint.finger = match row {
        Some(table::Row { slot: Slot::Finger(finger), place }) => Some((FingerBone { finger, place }, true)),
        Some(table::Row { slot: Slot::Palm(finger), .. }) => {
            Some((FingerBone { finger, place: super::vocabulary::Place::Segment(0) }, true))
        }
        Some(_) => None,
        None => meaning.finger.map(|bone| (bone, false)),
    };
    joint.class = match slot {
        Some(slot) if kind(slot).is_some() => Some((slot, true)),
        Some(_) => None,
        None => meaning.class.map(|slot| (slot, false)),
    };
    joint
}

/// Takes the claims from joints that move others. A rig with all its controls has several joints for each part, and those
/// that move the body say so, as Rigify's `DEF-` do.
fn drop_controls(words: &[Words], joints: &mut [Joint]) {
    let deforms: Vec<bool> =
        words.iter().map(|words| words.words.iter().any(|word| word == "def" || word == "deform")).collect();
    let limbs: HashSet<(Option<Side>, Slot)> = (joints.iter().zip(&deforms))
        .filter(|(_, deforms)| **deforms)
        .flat_map(|(joint, _)| joint.parts.iter().map(|claim| (joint.side, claim.slot)))
        .filter(|(_, slot)| NEEDED.contains(slot))
        .collect();
    if limbs.len() < DEFORMING {
        return;
    }
    for (joint, _) in joints.iter_mut().zip(deforms).filter(|(_, deforms)| !deforms) {
        if !joint.parts.is_empty() || joint.finger.is_some() {
            joint.parts.clear();
            joint.finger = None;
            joint.class = joint.class.or(Some((Slot::Control, false)));
        }
    }
}

/// Finds sides in names such as `lthigh`, where there is an `rthigh` too.
fn sides_by_letter(names: &mut [Words], vocabulary: &Vocabulary) {
    let all: HashSet<String> = names.iter().filter_map(|name| name.words.first().cloned()).collect();
    for name in names.iter_mut().filter(|name| name.side.is_none()) {
        let Some(first) = name.words.first().filter(|word| word.is_ascii() && !vocabulary.is_known(word)) else {
            continue;
        };
        let (side, other) = match first.as_bytes() {
            [b'l', ..] => (Side::Left, 'r'),
            [b'r', ..] => (Side::Right, 'l'),
            _ => continue,
        };
        let rest = first[1..].to_owned();
        if !all.contains(&format!("{other}{rest}")) {
            continue;
        }
        let words = [std::slice::from_ref(&rest), &name.words[1..]].concat();
        let meaning = vocabulary.read(&words, true);
        if !meaning.parts.is_empty() || meaning.finger.is_some() {
            *name = Words { side: Some(side), words };
        }
    }
}
