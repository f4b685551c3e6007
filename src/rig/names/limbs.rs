//! Which joints are the arms and legs.

use super::claims::{AGAINST_TABLE, BY_TABLE, BY_WORD, CLEAR, Claim, NEEDED, Reader};
use super::slot::Slot;
use crate::rig::body_part::Side;

/// The parts of a limb in order, with what a limb that goes on without one loses.
type Limb = [(Slot, f64)];

const ARM: &Limb = &[(Slot::Clavicle, 0.0), (Slot::UpperArm, 0.8), (Slot::LowerArm, 0.8), (Slot::Hand, 0.6)];
const LEG: &Limb =
    &[(Slot::UpperLeg, 0.8), (Slot::LowerLeg, 0.8), (Slot::Foot, 0.6), (Slot::Toes, 0.1), (Slot::ToeTip, 0.0)];

/// A joint beside the chain of its limb is so much less sure, and one that stands in the wrong order to it.
const BESIDE: f64 = 0.8;
const BESIDE_BY_WORD: f64 = 0.6;
const WRONG_ORDER: f64 = 0.4;
/// A part of which no other joint of its limb is known.
const ALONE: f64 = 0.85;
const ALONE_BY_WORD: f64 = 0.7;

/// Finds the joints of all four limbs.
pub fn read(reader: &mut Reader) {
    for side in Side::BOTH {
        for limb in [ARM, LEG] {
            let chain = best_chain(reader, limb, side);
            set_chain(reader, limb, side, &chain);
            set_others(reader, limb, side);
        }
    }
}

/// A joint and its place in the limb.
type Link = (u32, usize);

/// The chain of joints from the trunk outwards whose claims together are the strongest.
fn best_chain(reader: &Reader, limb: &Limb, side: Side) -> Vec<Link> {
    let count = reader.joints.len();
    // The best chain that ends with each part at a joint or above it: its strength and its last joint.
    let mut best: Vec<Vec<Option<(f64, u32)>>> = vec![vec![None; limb.len()]; count];
    // The link before, for chains that end at the joint itself.
    let mut before: Vec<Vec<Option<Link>>> = vec![Vec::new(); count];
    let mut longest: Option<(f64, Link)> = None;
    for &joint in &reader.tree.order {
        let above = reader.tree.parents[joint as usize].map(|parent| best[parent as usize].clone());
        let above = above.unwrap_or_else(|| vec![None; limb.len()]);
        let mut own = above.clone();
        if reader.joints[joint as usize].side == Some(side) {
            before[joint as usize] = vec![None; limb.len()];
            for (place, &(slot, _)) in limb.iter().enumerate() {
                let Some(claim) = reader.joints[joint as usize].claim(slot) else { continue };
                let skipped = |from: usize| limb[from..place].iter().map(|(_, loss)| loss).sum::<f64>();
                let mut from = (-skipped(0), None);
                for (last, chain) in above[..place].iter().enumerate() {
                    if let Some((strength, last_joint)) = chain
                        && strength - skipped(last + 1) > from.0
                    {
                        from = (strength - skipped(last + 1), Some((*last_joint, last)));
                    }
                }
                let strength = claim.strength + from.0;
                before[joint as usize][place] = from.1;
                if own[place].is_none_or(|(other, _)| strength > other) {
                    own[place] = Some((strength, joint));
                }
                if longest.is_none_or(|(other, _)| strength > other) {
                    longest = Some((strength, (joint, place)));
                }
            }
        }
        best[joint as usize] = own;
    }
    let mut chain = Vec::new();
    let mut at = longest.map(|(_, link)| link);
    while let Some((joint, place)) = at {
        chain.push((joint, place));
        at = before[joint as usize][place];
    }
    chain.reverse();
    chain
}

/// How sure a claim is by itself, in a limb that is complete or not.
fn confidence(claim: Claim, is_complete: bool) -> f64 {
    match (claim.strength >= CLEAR, claim.by_table) {
        _ if claim.against_table => AGAINST_TABLE,
        (true, true) => BY_TABLE,
        (true, false) => BY_WORD,
        // A word with several meanings is clear where all its limb is there.
        (false, _) if is_complete => 0.55 + 0.35 * claim.strength,
        (false, _) => 0.3 + 0.3 * claim.strength,
    }
}

fn set_chain(reader: &mut Reader, limb: &Limb, side: Side, chain: &[Link]) {
    let has = |slot: &Slot| chain.iter().any(|&(_, place)| limb[place].0 == *slot);
    let is_complete = limb.iter().filter(|(slot, _)| NEEDED.contains(slot)).all(|(slot, _)| has(slot));
    for &(joint, place) in chain {
        let slot = limb[place].0;
        let (Some(claim), Some(part)) = (reader.joints[joint as usize].claim(slot), slot.part(Some(side))) else {
            continue;
        };
        let alone = match (chain.len(), claim.by_table) {
            (2.., _) => 1.0,
            (_, true) => ALONE,
            (_, false) => ALONE_BY_WORD,
        };
        let other_side = reader.tree.above(joint).find_map(|above| reader.found[above as usize]?.0.side());
        let crossed = if other_side.is_some_and(|other| other != side) { WRONG_ORDER } else { 1.0 };
        let inherited = if reader.joints[joint as usize].says_side { 1.0 } else { 0.8 };
        reader.set(joint, part, crossed * inherited * alone * confidence(claim, is_complete));
    }
}

/// The parts that no joint of the chain is, by joints beside it: feet that hang on a root, moved by controls.
fn set_others(reader: &mut Reader, limb: &Limb, side: Side) {
    for (place, &(slot, _)) in limb.iter().enumerate() {
        let Some(part) = slot.part(Some(side)) else { continue };
        if reader.joint_of(part).is_some() {
            continue;
        }
        let claims = reader.claimants(slot).into_iter();
        let own = claims.filter(|&(joint, claim)| {
            let says = &reader.joints[joint as usize];
            says.says_side && says.side == Some(side) && claim.strength >= CLEAR
        });
        let wrong = |joint: u32| {
            limb.iter().enumerate().any(|(other, (slot, _))| {
                let known = slot.part(Some(side)).and_then(|part| reader.joint_of(part));
                known.is_some_and(|known| {
                    (other < place && reader.tree.is_above(joint, known))
                        || (other > place && reader.tree.is_above(known, joint))
                })
            })
        };
        let graded = own.map(|(joint, claim)| (joint, claim, wrong(joint)));
        let order = |&(joint, claim, wrong): &(u32, Claim, bool)| {
            (wrong, -(1e6 * claim.strength) as i64, reader.tree.depth[joint as usize], joint)
        };
        let Some((joint, claim, is_wrong)) = graded.min_by_key(order) else { continue };
        let share = match (is_wrong, claim.by_table) {
            (true, _) => WRONG_ORDER,
            (false, true) => BESIDE,
            (false, false) => BESIDE_BY_WORD,
        };
        reader.set(joint, part, share * confidence(claim, false));
    }
}
