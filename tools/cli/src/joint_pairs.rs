//! Joints of two rigs that correspond: those that the user says, and those of equal names.

use std::collections::HashMap;
use std::path::Path;

use bespoke::input::rig::{Rig, RigJoint};
use bespoke::input::skin::SkinWeights;
use bespoke::rig::joint_map::CallersPair;

use crate::failure::{Failure, Result};

/// Reads lines of two joints, of `source` and of `target`, each by name or number, with a tab or blanks between them; `-` is
/// none, and what follows a `#` at the beginning of a line is not read. Names with blanks need the tab.
///
/// # Errors
/// With file and line.
pub fn read(file: &Path, source: &Rig, target: &Rig) -> Result<Vec<CallersPair>> {
    let text = std::fs::read_to_string(file)
        .map_err(|e| Failure::no_result(format!("{}: it cannot be read: {e}", file.display())))?;
    let mut pairs = Vec::new();
    for (number, line) in (1..).zip(text.lines()) {
        let at = |message: String| Failure::no_result(format!("{}: line {number}: {message}", file.display()));
        let line = line.trim();
        if line.is_empty() || line.starts_with('#') {
            continue;
        }
        let halves: Vec<&str> = match line.contains('\t') {
            true => line.split('\t').map(str::trim).filter(|half| !half.is_empty()).collect(),
            false => line.split_whitespace().collect(),
        };
        let [from, to] = halves[..] else {
            return Err(at(format!(
                "'{line}' are not two joints: write the outfit's joint, a tab and the avatar's joint, or - for none"
            )));
        };
        let from = joint(from, source, "the outfit's rig").map_err(at)?;
        let to = if to == "-" { None } else { Some(joint(to, target, "the avatar's rig").map_err(at)?) };
        pairs.push((from, to));
    }
    Ok(pairs)
}

fn joint(text: &str, rig: &Rig, whose: &str) -> Result<u32, String> {
    let mut named = (0..).zip(&rig.joints).filter(|(_, joint)| joint.name == text).map(|(index, _)| index);
    match (named.next(), named.next()) {
        (Some(index), None) => return Ok(index),
        (Some(a), Some(b)) => {
            return Err(format!("'{text}' is the name of several joints of {whose}, {a} and {b}: write the number"));
        }
        (None, _) => {}
    }
    match text.parse::<u32>() {
        Ok(index) if (index as usize) < rig.joints.len() => Ok(index),
        Ok(index) => Err(format!("there is no joint {index}: {whose} has {}", rig.joints.len())),
        Err(_) => Err(format!("'{text}' is no joint of {whose}; `bespoke inspect` lists its joints")),
    }
}

/// Weights on the joints of `from` as weights on those of `to`, by name, or by the name of the next joint above. None where the
/// rigs have no name in common.
pub fn on_rig(skin: &SkinWeights, from: &Rig, to: &Rig) -> Option<SkinWeights> {
    let names = to.joints.iter().zip(0..).map(|(joint, index)| (joint.name.as_str(), index));
    let names: HashMap<&str, u32> = names.filter(|(name, _)| !name.is_empty()).collect();
    let order = from.parents_first("source rig").ok()?;
    let mut map: Vec<Option<u32>> = vec![None; from.joints.len()];
    for joint in order {
        let RigJoint { name, parent, .. } = &from.joints[joint as usize];
        let above = parent.and_then(|parent| map[parent as usize]);
        map[joint as usize] = names.get(name.as_str()).copied().or(above);
    }
    if map.iter().all(Option::is_none) {
        return None;
    }
    let there = |&(joint, weight): &(u32, f64)| (map[joint as usize].unwrap_or(0), weight);
    let moved = |v: usize| skin.weights(v).iter().map(there).collect();
    Some(SkinWeights::from_rows(to.joints.len(), (0..skin.vertex_count()).map(moved)))
}
