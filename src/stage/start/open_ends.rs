//! Where the body goes on straight beyond a joint and no bone does: a head without a bone of its own, above a neck joint
//! from which the shoulders branch off.
//!
//! The projection clamps at such a joint, so that all of the head would start in one point of the collar's plane or below
//! it. Taken for an open end, as a leaf joint is, the head starts beyond the collar, where it belongs.

use glam::DVec3;

use super::owners::Owners;
use super::projection::{OpenEnd, ProjectedAvatar, attach, project_with};
use crate::error::Result;
use crate::geometry::mesh::TriangleMesh;
use crate::input::diagnostic::{Bone, Diagnostic};
use crate::input::skeleton::{BoneGraph, Skeleton};
use crate::verify::intersections;

/// A bone goes on where another leaves its end within 60 degrees of its direction.
const GOES_ON: f64 = 0.5;
/// Bones at the joint at least: where one limb just bends, its flesh is beyond the joint, too.
const FORK: usize = 3;
/// No other joint lies farther in its direction than this, in the normalised space: there the body belongs to others.
const LAST: f64 = 0.15;
/// The body reaches as far beyond the joint at least.
const MIN_REACH: f64 = 0.25;
/// As many vertices lie there at least.
const FEWEST: usize = 8;

/// The avatar on the source skeleton: as `straight` has it, or where it goes on beyond a bone's end without a bone, beginning
/// beyond that end, if the `garment` is open there and the caller does not want it `strict`. Adds to `diagnostics`.
///
/// # Errors
/// `InvalidMesh` where the garment cannot be judged.
pub fn begin_beyond(
    straight: ProjectedAvatar,
    garment: &TriangleMesh,
    avatar: &TriangleMesh,
    [target, source]: [&Skeleton; 2],
    owners: &Owners,
    strict: bool,
    diagnostics: &mut Vec<Diagnostic>,
) -> Result<ProjectedAvatar> {
    let open = find(avatar, target, owners);
    let mut mended = None;
    if !open.is_empty() && !strict {
        let beyond = project_with(avatar, target, source, owners, &open);
        mended = (intersections(garment, Some(&beyond.start_mesh()), 0)?.count == 0).then_some(beyond);
    }
    diagnostics.extend(open.iter().map(|open| {
        let mut joints = target.bones[open.bone as usize];
        if open.end == 0 {
            joints.reverse();
        }
        let bone = Bone { index: open.bone, joints };
        Diagnostic::EndWithoutBone { bone, reach: open.reach, mended: mended.is_some() }
    }));
    Ok(mended.unwrap_or(straight))
}

/// The open ends of `target`, the skeleton of `avatar`, leaf joints apart, which always are.
pub fn find(avatar: &TriangleMesh, target: &Skeleton, owners: &Owners) -> Vec<OpenEnd> {
    let graph = BoneGraph::new(target);
    let candidates: Vec<OpenEnd> = (0..target.bones.len() as u32)
        .flat_map(|bone| [0, 1].map(|end| OpenEnd { bone, end, reach: 0.0 }))
        .filter(|&open| is_last(target, &graph, open))
        .collect();
    if candidates.is_empty() {
        return candidates;
    }
    let used = avatar.used_vertices();
    let mut reached = vec![Vec::new(); candidates.len()];
    for (v, &p) in avatar.positions.iter().enumerate().filter(|(v, _)| used[*v]) {
        let (bone, parameter) = attach(&graph, target, p, owners.of[v], &candidates);
        for (open, lengths) in candidates.iter().zip(&mut reached).filter(|(open, _)| open.bone == bone) {
            let beyond = if open.end == 1 { parameter - 1.0 } else { -parameter };
            if beyond > 0.0 {
                lengths.push(beyond * span(target, *open).length());
            }
        }
    }
    let reach = |(open, mut lengths): (OpenEnd, Vec<f64>)| {
        lengths.sort_by(f64::total_cmp);
        let reach = lengths.last().copied().unwrap_or(0.0);
        (lengths.len() >= FEWEST && reach > MIN_REACH).then_some(OpenEnd { reach, ..open })
    };
    candidates.into_iter().zip(reached).filter_map(reach).collect()
}

/// From the other joint of the bone to this one.
fn span(target: &Skeleton, open: OpenEnd) -> DVec3 {
    let ends = target.bones[open.bone as usize].map(|j| target.joints[j as usize]);
    ends[open.end] - ends[1 - open.end]
}

/// A fork where no bone goes on in this one's direction, and no joint lies beyond.
fn is_last(target: &Skeleton, graph: &BoneGraph, open: OpenEnd) -> bool {
    let joint = target.bones[open.bone as usize][open.end];
    let place = target.joints[joint as usize];
    let Some(along) = span(target, open).try_normalize() else { return false };
    let goes_on = |&other: &u32| {
        let [a, b] = target.bones[other as usize];
        let far = target.joints[if a == joint { b } else { a } as usize];
        other != open.bone && (far - place).normalize_or_zero().dot(along) > GOES_ON
    };
    graph.degree(joint) >= FORK
        && !graph.bones_at(joint).iter().any(goes_on)
        && target.joints.iter().all(|&p| (p - place).dot(along) < LAST)
}
