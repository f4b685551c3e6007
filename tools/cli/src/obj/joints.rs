//! Joints and skin weights in files beside an OBJ file, in the forms that `retarget` reads.

use std::path::Path;

use bespoke::input::coordinate_system::CoordinateSystem;
use bespoke::input::rig::{Rig, RigJoint};
use bespoke::input::skeleton::Skeleton;
use glam::{DMat4, DVec3};

use super::file::ObjFile;
use crate::failure::{Failure, Result};

/// For each vertex, joints with weights; they sum to 1.
pub type Rows = Vec<Vec<(u32, f64)>>;

/// What moves a mesh.
#[derive(Clone, Debug)]
pub enum Joints {
    /// Joints and bones without names, as OBJ has them.
    Skeleton(Skeleton),
    /// Joints with names.
    Rig(Rig),
}

impl Joints {
    /// Reads a skeleton (OBJ: a `v` line for each joint, an `l` line for each bone), or a rig (text: `joint NAME PARENT` and the 16
    /// numbers of the bind transform).
    ///
    /// # Errors
    /// With file and line, or where the joints cannot be used.
    pub fn open(path: &Path, space: &CoordinateSystem) -> Result<Self> {
        let said = |what: String| Failure::no_result(format!("{}: {what}", path.display()));
        let text = std::fs::read_to_string(path).map_err(|e| said(format!("it cannot be read: {e}")))?;
        if text.split_whitespace().next() == Some("joint") {
            let rig = rig(&text).map_err(said)?.mapped(DMat4::from(space.affine_to_internal()));
            rig.check("rig").map_err(|e| said(e.message))?;
            return Ok(Self::Rig(rig));
        }
        let file = ObjFile::open(path)?;
        let place = |p: &[f32; 3]| space.position_to_internal(DVec3::from_array(p.map(f64::from)));
        let skeleton = Skeleton { joints: file.positions.iter().map(place).collect(), bones: file.segments };
        skeleton.check("skeleton").map_err(|e| {
            said(format!("{}; a joint is a line such as 'v 0 1 0', a bone one such as 'l 1 2'", e.message))
        })?;
        Ok(Self::Skeleton(skeleton))
    }

    /// As a rig; that of a skeleton has no names.
    pub fn rig(&self) -> Rig {
        match self {
            Self::Skeleton(skeleton) => Rig::of_skeleton(skeleton),
            Self::Rig(rig) => rig.clone(),
        }
    }
}

/// # Errors
/// With the line.
fn rig(text: &str) -> Result<Rig, String> {
    let mut joints = Vec::new();
    for (number, line) in (1..).zip(text.lines()) {
        let words: Vec<&str> = line.split_whitespace().collect();
        if words.is_empty() {
            continue;
        }
        if words[0] != "joint" || words.len() < 18 {
            return Err(format!("line {number}: is not: joint NAME PARENT and 16 numbers"));
        }
        // A name may have blanks in it.
        let (name, tail) = words[1..].split_at(words.len() - 18);
        let parent = match tail[0].parse::<i64>() {
            Ok(-1) => None,
            Ok(parent) if (0..i64::from(u32::MAX)).contains(&parent) => Some(parent as u32),
            _ => return Err(format!("line {number}: the parent is no joint counted from 0, and not -1")),
        };
        let mut bind = [0.0; 16];
        for (k, (word, entry)) in tail[1..].iter().zip(&mut bind).enumerate() {
            let value = word.parse::<f64>().ok().filter(|value| value.is_finite());
            *entry = value.ok_or_else(|| {
                format!("line {number}: number {} of the bind transform is not a finite number", k + 1)
            })?;
        }
        joints.push(RigJoint { name: name.join(" "), parent, bind: DMat4::from_cols_array(&bind) });
    }
    Ok(Rig { joints })
}

/// Reads skin weights of `vertices` vertices on `joints` joints: a matrix with a row for each joint and a column for each vertex, or
/// a line `JOINT WEIGHT JOINT WEIGHT ...` for each vertex, joints from 0.
///
/// # Errors
/// With file and line, or with the sizes that do not agree.
pub fn skin(path: &Path, joints: usize, vertices: usize) -> Result<Rows> {
    let said = |what: String| Failure::no_result(format!("{}: {what}", path.display()));
    let text = std::fs::read_to_string(path).map_err(|e| said(format!("it cannot be read: {e}")))?;
    let lines = || text.lines().enumerate().filter(|(_, line)| !line.trim().is_empty());
    let first = lines().next().map_or(0, |(_, line)| line.split_whitespace().count());
    let count = lines().count();
    let mut rows: Rows = vec![Vec::new(); vertices];
    if count == joints && first == vertices {
        for (joint, (index, line)) in (0..).zip(lines()) {
            let words: Vec<&str> = line.split_whitespace().collect();
            if words.len() != vertices {
                return Err(said(format!(
                    "line {}: has {} columns, and the first has {first}",
                    index + 1,
                    words.len()
                )));
            }
            for (row, word) in rows.iter_mut().zip(words) {
                let weight = weight(word).ok_or_else(|| said(format!("line {}: '{word}' is no weight", index + 1)))?;
                if weight > 0.0 {
                    row.push((joint, weight));
                }
            }
        }
    } else if count == vertices {
        for (row, (index, line)) in rows.iter_mut().zip(lines()) {
            let at = |what: String| said(format!("line {}: {what}", index + 1));
            let words: Vec<&str> = line.split_whitespace().collect();
            for pair in words.chunks(2) {
                let &[joint, own] = pair else {
                    return Err(at(format!("has {} words; a joint and its weight are two", words.len())));
                };
                let joint: u32 = joint.parse().map_err(|_| at(format!("'{joint}' is no joint counted from 0")))?;
                if joint as usize >= joints {
                    return Err(at(format!("there is no joint {joint}; the skeleton has {joints}")));
                }
                let own = weight(own).ok_or_else(|| at(format!("'{own}' is no weight")))?;
                if own > 0.0 {
                    row.push((joint, own));
                }
            }
        }
    } else {
        return Err(said(format!(
            "has {count} lines of {first} words; needed is a line for each of {joints} joints with a weight for each of \
             {vertices} vertices, or a line 'JOINT WEIGHT ...' for each vertex"
        )));
    }
    for row in &mut rows {
        row.sort_by_key(|&(joint, _)| joint);
        row.dedup_by(|next, first| {
            let is_same = next.0 == first.0;
            first.1 += if is_same { next.1 } else { 0.0 };
            is_same
        });
        let sum: f64 = row.iter().map(|(_, weight)| weight).sum();
        row.iter_mut().for_each(|(_, weight)| *weight /= sum);
    }
    Ok(rows)
}

fn weight(word: &str) -> Option<f64> {
    word.parse::<f64>().ok().filter(|weight| weight.is_finite() && *weight >= 0.0)
}
