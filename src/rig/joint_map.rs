//! Which joint of one rig corresponds to which of another, how sure that is, and why.

use std::collections::HashMap;

use super::body_part::BodyPart;
use super::names::Named;
use super::reading::{FoundBy, Reading};
use crate::error::{Error, ErrorKind, Result};
use crate::input::rig::Rig;

/// What a caller says of two joints: these two correspond, or the first corresponds to none.
pub type CallersPair = (u32, Option<u32>);

/// Why a joint is mapped as it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reason {
    /// Nothing corresponds: a control, a prop, or above everything that was recognised.
    Nothing,
    /// The caller said so.
    Caller,
    /// The names of both say that they are the same part of the body.
    Name,
    /// Their places in tree and space say so, for at least one of the two.
    Structure,
    /// Of several joints in spine or neck, it has the same place in the order.
    Order,
    /// Both have the same name, which stands for no part of the body.
    SameName,
    /// It has no counterpart and goes with the joint above it.
    Ancestor,
}

/// A joint of the source rig and its counterpart.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MappedJoint {
    /// The target rig's joint, if there is one.
    pub target: Option<u32>,
    /// The part of the body that both are.
    pub part: Option<BodyPart>,
    /// From 0, a guess, to 1, sure.
    pub confidence: f64,
    /// What the counterpart follows from.
    pub reason: Reason,
    /// It is no part of its own and helps one, as a joint that takes a share of a limb's twist does.
    pub helps: bool,
}

/// The map from a source rig to a target rig.
#[derive(Clone, Debug)]
pub struct JointMap {
    /// One for each joint of the source rig.
    pub joints: Vec<MappedJoint>,
    /// What each joint is, in the source rig and in the target rig.
    pub readings: [Reading; 2],
}

impl JointMap {
    /// Maps `source` to `target`, which were read as `readings`; `pairs` win over everything.
    ///
    /// # Errors
    /// [`ErrorKind::InvalidArgument`] for a pair with a joint that a rig does not have, or a joint in two pairs.
    pub fn new(source: &Rig, target: &Rig, mut readings: [Reading; 2], pairs: &[CallersPair]) -> Result<Self> {
        check_pairs(source, target, pairs)?;
        let [from, to] = &mut readings;
        for &(a, b) in pairs {
            let Some(b) = b else {
                from.named[a as usize] = Named::Unknown;
                continue;
            };
            // What is known of one of the two holds for the other; the source's where they differ.
            match (from.part(a), to.part(b)) {
                (Some(part), _) => {
                    to.set(b, part);
                    from.set(a, part);
                }
                (None, Some(part)) => from.set(a, part),
                (None, None) => {}
            }
        }
        let callers: HashMap<u32, Option<u32>> = pairs.iter().copied().collect();
        let taken: std::collections::HashSet<u32> = pairs.iter().filter_map(|pair| pair.1).collect();
        let by_name = same_names(source, target, &readings);
        let [from, to] = &readings;
        let order = source.parents_first("source rig")?;
        let parts = [Parts::new(source, from, &order), Parts::new(target, to, &target.parents_first("target rig")?)];
        let mut joints = vec![None; source.joints.len()];
        for joint in order {
            let part = from.part(joint);
            let sure = from.confidence[joint as usize];
            let found = if let Some(&target) = callers.get(&joint) {
                Some((target, 1.0, Reason::Caller))
            } else if let Some(part) = part {
                counterpart(part, joint, &parts, &readings)
                    .filter(|(target, ..)| !taken.contains(target))
                    .map(|(target, confidence, reason)| (Some(target), confidence.min(sure), reason))
            } else {
                let same = by_name.get(&joint).filter(|target| !taken.contains(target));
                same.map(|&target| (Some(target), 0.8, Reason::SameName))
            };
            let above: Option<MappedJoint> = source.joints[joint as usize].parent.and_then(|k| joints[k as usize]);
            let (target, confidence, reason) = found.unwrap_or_else(|| match above {
                Some(MappedJoint { target: Some(target), confidence, .. })
                    if !matches!(from.named[joint as usize], Named::Control | Named::Prop) =>
                {
                    (Some(target), 0.8 * confidence, Reason::Ancestor)
                }
                _ => (None, 0.0, Reason::Nothing),
            });
            let part = part.or_else(|| to.part(target?).filter(|_| reason == Reason::Caller));
            let helps = from.named[joint as usize] == Named::Twist;
            joints[joint as usize] = Some(MappedJoint { target, part, confidence, reason, helps });
        }
        Ok(Self { joints: joints.into_iter().flatten().collect(), readings })
    }
}

fn check_pairs(source: &Rig, target: &Rig, pairs: &[CallersPair]) -> Result<()> {
    let fail = |message: String| Err(Error::new(ErrorKind::InvalidArgument, message));
    let mut seen: [HashMap<u32, usize>; 2] = Default::default();
    for (index, &(a, b)) in pairs.iter().enumerate() {
        for (side, name, joint, rig) in [(0, "source", Some(a), source), (1, "target", b, target)] {
            let Some(joint) = joint else { continue };
            if joint as usize >= rig.joints.len() {
                return fail(format!(
                    "joint pairs: pair {index} has joint {joint} of the {name} rig, which has {} joints",
                    rig.joints.len()
                ));
            }
            if let Some(first) = seen[side].insert(joint, index) {
                return fail(format!(
                    "joint pairs: {} of the {name} rig is in pair {first} and in pair {index}; each joint can be in one",
                    rig.called(joint as usize)
                ));
            }
        }
    }
    Ok(())
}

/// The joints of a rig by the parts that they are.
struct Parts {
    /// The joints of each part, those with fewer joints above them first.
    joints: HashMap<BodyPart, Vec<u32>>,
    /// The place of each joint among those of its part.
    at: Vec<usize>,
}

impl Parts {
    /// Those of `rig`; `order` has each joint after its parent.
    fn new(rig: &Rig, reading: &Reading, order: &[u32]) -> Self {
        let mut depth = vec![0_usize; rig.joints.len()];
        for &joint in order {
            depth[joint as usize] = rig.joints[joint as usize].parent.map_or(0, |above| depth[above as usize] + 1);
        }
        let mut joints: HashMap<BodyPart, Vec<u32>> = HashMap::new();
        for joint in 0..rig.joints.len() as u32 {
            if let Some(part) = reading.part(joint) {
                joints.entry(part).or_default().push(joint);
            }
        }
        let mut at = vec![0; rig.joints.len()];
        for list in joints.values_mut() {
            list.sort_by_key(|&joint| depth[joint as usize]);
            list.iter().enumerate().for_each(|(place, &joint)| at[joint as usize] = place);
        }
        Self { joints, at }
    }
}

/// The joint of the target rig that is the same part.
fn counterpart(part: BodyPart, joint: u32, parts: &[Parts; 2], readings: &[Reading; 2]) -> Option<(u32, f64, Reason)> {
    let [from, to] = readings;
    let (own, others) = (parts[0].joints.get(&part)?, parts[1].joints.get(&part)?);
    let at = parts[0].at[joint as usize];
    // The first to the first, the last to the last.
    let place = if own.len() == 1 {
        0
    } else {
        (at as f64 * (others.len() - 1) as f64 / (own.len() - 1) as f64).round() as usize
    };
    let target = others[place];
    let confidence = to.confidence[target as usize];
    let by_name =
        from.found_by[joint as usize] != FoundBy::Structure && to.found_by[target as usize] != FoundBy::Structure;
    let reason = match (own.len() == 1 && others.len() == 1, by_name) {
        (false, _) => Reason::Order,
        (true, true) => Reason::Name,
        (true, false) => Reason::Structure,
    };
    let evenly = if own.len() == others.len() { 1.0 } else { 0.9 };
    Some((target, evenly * confidence, reason))
}

/// Joints that are no part of a body and have the same name, which no other has, in both rigs.
fn same_names(source: &Rig, target: &Rig, readings: &[Reading; 2]) -> HashMap<u32, u32> {
    let unique = |rig: &Rig, reading: &Reading| {
        let mut found: HashMap<String, Option<u32>> = HashMap::new();
        for (index, joint) in (0u32..).zip(&rig.joints) {
            if reading.part(index).is_none() && !joint.name.is_empty() {
                found.entry(plain(&joint.name)).and_modify(|first| *first = None).or_insert(Some(index));
            }
        }
        found
    };
    let (from, to) = (unique(source, &readings[0]), unique(target, &readings[1]));
    from.iter().filter_map(|(name, joint)| Some(((*joint)?, (*to.get(name)?)?))).collect()
}

/// A name without namespace, case and punctuation.
fn plain(name: &str) -> String {
    let own = name.rsplit([':', '|']).next().unwrap_or(name);
    own.chars().filter(|c| c.is_alphanumeric()).flat_map(char::to_lowercase).collect()
}
