//! Which joints are hips, spine, neck and head. Their names overlap more than those of limbs, and what hangs on them decides.

use super::claims::{AGAINST_TABLE, BY_TABLE, BY_WORD, Claim, Reader};
use super::slot::Slot;
use crate::rig::body_part::{BodyPart, Side};

/// Weaker claims to be the hips are a root's, which may stand on the floor.
const STRONG: f64 = 0.4;
/// A joint that holds legs, or arms or head, is so much more likely the hips.
const HOLDS: f64 = 0.3;
/// What the tree says where names do not.
const BY_TREE: f64 = 0.75;
const BY_TREE_ROUGHLY: f64 = 0.62;
/// What nothing says for sure.
const GUESS: f64 = 0.45;
/// What hangs elsewhere than it should.
const ASTRAY: f64 = 0.6;

/// Finds the trunk, and what is on the head; the limbs have been found.
pub fn read(reader: &mut Reader) {
    let (legs, arms) =
        (fork(reader, &[Slot::UpperLeg]), fork(reader, &[Slot::Clavicle, Slot::UpperArm, Slot::LowerArm]));
    let head = find_head(reader, arms);
    find_hips(reader, legs, arms, head);
    let hips = reader.joint_of(BodyPart::Hips);
    // Arms that hang on what holds the hips too do not say where the trunk ends.
    let arms = arms.filter(|&arms| hips.is_none_or(|hips| !reader.tree.holds(arms, hips)));
    find_spine(reader, arms, head);
    for slot in [Slot::HeadTop, Slot::Jaw, Slot::Eye] {
        find_on_head(reader, slot);
    }
}

/// Where the left and the right limb part: the joint that holds the first of these that both have.
fn fork(reader: &Reader, slots: &[Slot]) -> Option<u32> {
    let of = |side| slots.iter().find_map(|slot| reader.joint_of(slot.part(Some(side))?));
    match (of(Side::Left), of(Side::Right)) {
        (Some(left), Some(right)) => reader.tree.common(left, right),
        (Some(one), None) | (None, Some(one)) => reader.tree.parents[one as usize],
        (None, None) => None,
    }
}

/// The joints in the middle that claim to be `slot`.
fn middle(reader: &Reader, slot: Slot) -> Vec<(u32, Claim)> {
    let claims = reader.claimants(slot).into_iter();
    claims.filter(|&(joint, _)| !reader.joints[joint as usize].says_side).collect()
}

fn by_name(claim: Claim) -> f64 {
    match claim {
        Claim { against_table: true, .. } => AGAINST_TABLE,
        Claim { by_table: true, .. } => BY_TABLE,
        Claim { strength, .. } => BY_WORD * strength.min(1.0),
    }
}

fn find_head(reader: &mut Reader, arms: Option<u32>) -> Option<u32> {
    let spine: Vec<u32> = [Slot::Neck, Slot::Spine, Slot::Trunk, Slot::Hips]
        .iter()
        .flat_map(|&slot| middle(reader, slot))
        .map(|(joint, _)| joint)
        .collect();
    let hangs = |joint: u32| {
        arms.is_some_and(|arms| reader.tree.is_above(arms, joint))
            || spine.iter().any(|&above| reader.tree.is_above(above, joint))
    };
    let graded = middle(reader, Slot::Head).into_iter().map(|(joint, claim)| {
        let holds_trunk = spine.iter().any(|&below| reader.tree.is_above(joint, below));
        (joint, claim, hangs(joint), holds_trunk)
    });
    let grade = |&(_, claim, hangs, holds): &(u32, Claim, bool, bool)| {
        claim.strength + HOLDS * f64::from(u8::from(hangs)) - f64::from(u8::from(holds))
    };
    let depth = |joint: u32| reader.tree.depth[joint as usize];
    let best =
        graded.max_by(|a, b| grade(a).total_cmp(&grade(b)).then(depth(b.0).cmp(&depth(a.0))).then(b.0.cmp(&a.0)));
    let (joint, claim, hangs, holds) = best?;
    let place = if holds {
        GUESS
    } else if hangs || spine.is_empty() {
        1.0
    } else {
        ASTRAY
    };
    reader.set(joint, BodyPart::Head, place * by_name(claim));
    Some(joint)
}

fn find_hips(reader: &mut Reader, legs: Option<u32>, arms: Option<u32>, head: Option<u32>) {
    let upper: Vec<u32> = [arms, head].into_iter().flatten().collect();
    let holds_legs = |joint: u32| legs.is_some_and(|legs| reader.tree.holds(joint, legs));
    let holds_upper = |joint: u32| upper.iter().any(|&upper| reader.tree.is_above(joint, upper));
    let claims = middle(reader, Slot::Hips);
    let grade = |&(joint, claim): &(u32, Claim)| {
        let holds = u8::from(holds_legs(joint)) + u8::from(holds_upper(joint));
        claim.strength + HOLDS * f64::from(holds)
    };
    let depth = |joint: u32| reader.tree.depth[joint as usize];
    let best = |claims: Vec<(u32, Claim)>| {
        claims
            .into_iter()
            .max_by(|a, b| grade(a).total_cmp(&grade(b)).then(depth(b.0).cmp(&depth(a.0))).then(b.0.cmp(&a.0)))
    };
    let (strong, weak): (Vec<_>, Vec<_>) = claims.into_iter().partition(|(_, claim)| claim.strength >= STRONG);
    if let Some((joint, claim)) = best(strong) {
        let stands = holds_legs(joint) || holds_upper(joint) || (legs.is_none() && upper.is_empty());
        let place = if stands { 1.0 } else { ASTRAY };
        reader.set(joint, BodyPart::Hips, place * by_name(claim));
        return;
    }
    // No joint is called hips: the joint of the trunk on which the legs hang.
    let trunk: Vec<(u32, Claim)> = [Slot::Trunk, Slot::Spine].iter().flat_map(|&slot| middle(reader, slot)).collect();
    let at_legs = legs.and_then(|legs| trunk.iter().find(|(joint, _)| *joint == legs));
    let above_legs = || trunk.iter().filter(|&&(joint, _)| holds_legs(joint)).max_by_key(|(joint, _)| depth(*joint));
    if let Some(&(joint, _)) = at_legs {
        reader.set(joint, BodyPart::Hips, BY_TREE);
    } else if let Some(&(joint, _)) = above_legs() {
        reader.set(joint, BodyPart::Hips, BY_TREE_ROUGHLY);
    } else if let Some((joint, _)) = best(weak)
        && holds_legs(joint)
    {
        reader.set(joint, BodyPart::Hips, GUESS);
    }
}

fn find_spine(reader: &mut Reader, arms: Option<u32>, mut head: Option<u32>) {
    let mut spine: Vec<(u32, Claim)> = middle(reader, Slot::Trunk);
    let unsaid: Vec<u32> = spine.iter().map(|&(joint, _)| joint).collect();
    spine.extend(middle(reader, Slot::Spine).into_iter().filter(|(joint, _)| !unsaid.contains(joint)));
    spine.sort_by_key(|&(joint, _)| (reader.tree.depth[joint as usize], joint));
    let mut necks = middle(reader, Slot::Neck);
    let hips = reader.joint_of(BodyPart::Hips);
    let on_trunk = |joint: u32| {
        let trunk = spine.iter().map(|&(joint, _)| joint).chain(hips).chain(arms);
        trunk.into_iter().any(|other| reader.tree.is_above(other, joint) || arms == Some(joint))
    };
    if necks.iter().any(|&(joint, _)| on_trunk(joint)) {
        necks.retain(|&(joint, _)| on_trunk(joint));
    }
    // Beyond the arms it is neck, where nothing else is called so.
    let is_beyond = |joint: u32| arms.is_some_and(|arms| reader.tree.is_above(arms, joint));
    let is_below_head = |joint: u32| head.is_none_or(|head| reader.tree.is_above(joint, head));
    let beyond: Vec<u32> = match necks.is_empty() {
        true => {
            spine.iter().map(|&(joint, _)| joint).filter(|&joint| is_beyond(joint) && is_below_head(joint)).collect()
        }
        false => Vec::new(),
    };
    let by_number = if arms.is_none() && head.is_none() { numbered(reader, &unsaid) } else { Vec::new() };
    let mut chain: Vec<(u32, f64)> = beyond.iter().map(|&joint| (joint, BY_TREE)).collect();
    chain.extend(&by_number);
    chain.extend(necks.iter().map(|&(joint, claim)| (joint, by_name(claim))));
    chain.sort_by_key(|&(joint, _)| (reader.tree.depth[joint as usize], joint));
    // The last of several is the head, where nothing else is called so.
    if head.is_none()
        && let Some(&(last, sure)) = chain.last()
        && (chain.len() > 1 || !unsaid.is_empty())
        && chain.iter().all(|&(joint, _)| reader.tree.holds(joint, last))
    {
        reader.set(last, BodyPart::Head, sure.min(if unsaid.contains(&last) { BY_TREE } else { BY_TREE_ROUGHLY }));
        head = Some(last);
    }
    for &(joint, sure) in &chain {
        let leads = head.is_none_or(|head| reader.tree.holds(joint, head));
        let aside = !leads && chain.iter().any(|&(other, _)| head.is_some_and(|head| reader.tree.holds(other, head)));
        if !aside {
            reader.set(joint, BodyPart::Neck, if leads { sure } else { ASTRAY * sure });
        }
    }
    let upper: Vec<u32> = arms.into_iter().chain(head).chain(chain.iter().map(|&(joint, _)| joint)).collect();
    for (joint, claim) in spine {
        let leads = upper.is_empty() || upper.iter().any(|&upper| reader.tree.holds(joint, upper));
        let holds_hips = hips.is_some_and(|hips| reader.tree.is_above(joint, hips));
        let unclear = unsaid.contains(&joint) && arms.is_none() && by_number.is_empty();
        match (leads && !holds_hips, claim.by_table) {
            (true, _) => reader.set(joint, BodyPart::Spine, if unclear { GUESS } else { by_name(claim) }),
            (false, true) if !holds_hips => reader.set(joint, BodyPart::Spine, ASTRAY * by_name(claim)),
            _ => false,
        };
    }
}

/// Neck and head in a trunk of which only the numbers are known, as the meta-rig has them: the fourth and fifth, and the
/// sixth.
fn numbered(reader: &Reader, unsaid: &[u32]) -> Vec<(u32, f64)> {
    let mut numbers: Vec<(u32, u32)> =
        unsaid.iter().filter_map(|&joint| Some((reader.joints[joint as usize].number?, joint))).collect();
    numbers.sort_unstable();
    let is_whole = numbers.iter().map(|&(number, _)| number).eq(1..=6);
    if !is_whole {
        return Vec::new();
    }
    numbers[3..].iter().map(|&(_, joint)| (joint, BY_TREE_ROUGHLY)).collect()
}

fn find_on_head(reader: &mut Reader, slot: Slot) {
    let head = reader.joint_of(BodyPart::Head);
    let sides: &[Option<Side>] = if slot == Slot::Eye { &[Some(Side::Left), Some(Side::Right)] } else { &[None] };
    for &side in sides {
        let Some(part) = slot.part(side) else { continue };
        let hangs = |joint: u32| head.is_none_or(|head| reader.tree.is_above(head, joint));
        let claims = reader.claimants(slot).into_iter().filter(|&(joint, _)| {
            let says = &reader.joints[joint as usize];
            if side.is_some() { says.side == side } else { !says.says_side }
        });
        let depth = |joint: u32| reader.tree.depth[joint as usize];
        let order = |a: &(u32, Claim), b: &(u32, Claim)| {
            hangs(a.0)
                .cmp(&hangs(b.0))
                .then(a.1.strength.total_cmp(&b.1.strength))
                .then((depth(b.0), b.0).cmp(&(depth(a.0), a.0)))
        };
        let Some((joint, claim)) = claims.max_by(order) else { continue };
        let place = if hangs(joint) { 1.0 } else { ASTRAY };
        reader.set(joint, part, place * by_name(claim));
    }
}
