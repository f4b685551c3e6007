//! Step 1: the target avatar, shrunk onto its skeleton and placed on the source skeleton inside the garment
//! (section 3.3 of the paper).
//!
//! Each vertex goes to the nearest point of the bone it belongs to. A triangle whose corners lie on different bones is
//! split: the edge whose ends are farthest apart in the skeleton gets a new corner for each joint between them, evenly
//! spaced on the target avatar and at the joint when shrunk, until every triangle collapses onto a single bone.
//! Triangles are split one by one, so neighbours need not agree: the avatar only is an obstacle.

use std::collections::HashMap;

use glam::DVec3;

use crate::error::{Error, ErrorKind, Result};
use crate::input::mesh::TriangleMesh;
use crate::input::skeleton::{BoneGraph, Location, Skeleton};
use crate::input::skin::SkinWeights;

/// The target avatar between its shrunk shape (t = 0) and its own (t = 1), subdivided so that the shrunk one is the
/// skeleton and nothing else.
#[derive(Clone, Debug, Default)]
pub struct ProjectedAvatar {
    /// Vertices of the subdivided mesh at t = 0.
    pub start: Vec<DVec3>,
    /// Vertices of the subdivided mesh at t = 1.
    pub end: Vec<DVec3>,
    /// Triangles of the subdivided mesh.
    pub triangles: Vec<[u32; 3]>,
    /// The caller's vertices at t = 0.
    pub shrunk: Vec<DVec3>,
    /// The segments that the avatar is at t = 0: bone, and its two ends.
    pub segments: Vec<(u32, [DVec3; 2])>,
}

#[derive(Clone, Copy)]
struct Corner {
    location: Location,
    start: DVec3,
    end: DVec3,
}

/// Projects `avatar` (normalised) with its skeleton `target` onto `source`, whose bones `target` shares in order and
/// direction. Skin weights, where given, decide the joint that a vertex belongs to.
///
/// # Errors
/// `InvalidSkeleton` where bones form a cycle that no split can resolve.
pub fn project(
    avatar: &TriangleMesh,
    target: &Skeleton,
    source: &Skeleton,
    skin: Option<&SkinWeights>,
) -> Result<ProjectedAvatar> {
    let graph = BoneGraph::new(source);
    let corners: Vec<Corner> = avatar
        .positions
        .iter()
        .enumerate()
        .map(|(v, &end)| {
            let (bone, parameter) = attach(&graph, target, end, skin.and_then(|s| s.dominant_joint(v)));
            Corner { location: Location::Bone { bone, parameter }, start: source.point_at(bone, parameter), end }
        })
        .collect();

    let mut out = ProjectedAvatar { shrunk: corners.iter().map(|c| c.start).collect(), ..Default::default() };
    let mut merged = HashMap::new();
    let mut pending = Vec::new();
    let mut paths: [Vec<u32>; 3] = Default::default();
    for (index, triangle) in avatar.triangles.iter().enumerate() {
        pending.push(triangle.map(|v| corners[v as usize]));
        // Each split strictly shortens the longest path, so a triangle never needs more pieces than this.
        let mut budget = 64 * (source.bones.len() + 1);
        while let Some(piece) = pending.pop() {
            for (edge, path) in paths.iter_mut().enumerate() {
                graph.joints_between(piece[edge].location, piece[(edge + 1) % 3].location, path);
            }
            let longest = (0..3).rev().max_by_key(|&e| paths[e].len()).unwrap_or(0);
            if paths[longest].is_empty() {
                out.push(&piece, &mut merged);
                continue;
            }
            budget -= 1;
            if budget == 0 {
                return Err(Error::new(
                    ErrorKind::InvalidSkeleton,
                    format!(
                        "target avatar: triangle {index} spans bones that form a cycle; it cannot be shrunk onto the \
                         skeleton. Remove a bone from the cycle"
                    ),
                ));
            }
            split(&piece, longest, &paths[longest], source, &mut pending);
        }
    }
    out.segments = segments(&corners, source);
    Ok(out)
}

/// The bone that a point belongs to, and its parameter there: the closest among the bones at `joint`, or among all.
fn attach(graph: &BoneGraph, skeleton: &Skeleton, p: DVec3, joint: Option<u32>) -> (u32, f64) {
    let mut best = (f64::INFINITY, 0, 0.0);
    for (bone, ends) in skeleton.bones.iter().enumerate() {
        if joint.is_some_and(|j| !ends.contains(&j)) {
            continue;
        }
        let parameter = graph.project(skeleton, bone as u32, p);
        let distance = p.distance_squared(skeleton.point_at(bone as u32, parameter));
        if distance < best.0 {
            best = (distance, bone as u32, parameter);
        }
    }
    (best.1, best.2)
}

/// Replaces edge `edge` of `piece` by a chain over `joints` and fans the pieces to the opposite corner.
fn split(piece: &[Corner; 3], edge: usize, joints: &[u32], source: &Skeleton, pending: &mut Vec<[Corner; 3]>) {
    let [a, b, opposite] = [piece[edge], piece[(edge + 1) % 3], piece[(edge + 2) % 3]];
    // Both triangles at an edge must find the same points on it, to the bit, whichever way they walk along it.
    let turned = a.end.to_array() > b.end.to_array();
    let count = joints.len() + 1;
    let point = |k: usize| {
        let (from, to, k) = if turned { (b.end, a.end, count - k) } else { (a.end, b.end, k) };
        from.lerp(to, k as f64 / count as f64)
    };
    let mut last = a;
    for (k, &joint) in joints.iter().enumerate() {
        let next = Corner { location: Location::Joint(joint), start: source.joints[joint as usize], end: point(k + 1) };
        pending.push([last, next, opposite]);
        last = next;
    }
    pending.push([last, b, opposite]);
}

impl ProjectedAvatar {
    fn push(&mut self, piece: &[Corner; 3], merged: &mut HashMap<[u64; 6], u32>) {
        let corners = piece.map(|c| {
            let key = [c.start.x, c.start.y, c.start.z, c.end.x, c.end.y, c.end.z].map(f64::to_bits);
            *merged.entry(key).or_insert_with(|| {
                self.start.push(c.start);
                self.end.push(c.end);
                self.start.len() as u32 - 1
            })
        });
        self.triangles.push(corners);
    }
}

/// The stretch of each bone that the shrunk avatar covers. New corners lie at joints between old ones, so they never
/// reach beyond these stretches and the joints.
fn segments(corners: &[Corner], source: &Skeleton) -> Vec<(u32, [DVec3; 2])> {
    let mut reach: HashMap<u32, (f64, f64)> = HashMap::new();
    for corner in corners {
        if let Location::Bone { bone, parameter } = corner.location {
            let (low, high) = reach.entry(bone).or_insert((parameter, parameter));
            *low = low.min(parameter);
            *high = high.max(parameter);
        }
    }
    let mut segments: Vec<_> = reach
        .into_iter()
        .map(|(bone, (low, high))| {
            let ends = [low.min(0.0), high.max(1.0)].map(|s| source.point_at(bone, s));
            (bone, ends)
        })
        .collect();
    segments.sort_by_key(|s| s.0);
    segments
}
