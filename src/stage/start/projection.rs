//! Projection: the target avatar, shrunk onto its skeleton and placed on the source skeleton inside the garment
//! (section 3.3 of the paper).
//!
//! Each vertex goes to the nearest point of the bone it belongs to. A triangle whose corners lie on different bones is
//! split: the edge whose ends are farthest apart in the skeleton gets a new corner for each joint between them, evenly
//! spaced on the target avatar and at the joint when shrunk, until every triangle collapses onto a single bone.
//! Triangles are split one by one, so neighbours need not agree: the avatar only is an obstacle. A piece with one edge on
//! a single bone and two that lead far away is cut into a strip along the joints that both pass, so that the number of
//! pieces grows with the square of the number of joints and not faster.

use std::collections::HashMap;

use glam::DVec3;

use crate::geometry::mesh::TriangleMesh;
use crate::input::skeleton::{BoneGraph, Location, Skeleton};
use crate::input::skin::SkinWeights;

use super::owners::{Owner, Owners};

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
    /// The bone that each triangle of the subdivided mesh collapses onto; `None` where bones form a cycle that the triangle
    /// spans, so that it keeps an area.
    pub bones: Vec<Option<u32>>,
    /// The caller's triangle that each triangle of the subdivided mesh is a piece of.
    pub origins: Vec<u32>,
    /// Where each of the caller's vertices is on the skeleton at t = 0.
    pub locations: Vec<Location>,
}

/// An end of a bone beyond which the body goes on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OpenEnd {
    /// The bone.
    pub bone: u32,
    /// Which of its joints: 0 or 1.
    pub end: usize,
    /// How far the body reaches beyond the joint, in the normalised space.
    pub reach: f64,
}

#[derive(Clone, Copy)]
struct Corner {
    location: Location,
    start: DVec3,
    end: DVec3,
}

/// Projects `avatar` (normalised) with its skeleton `target` onto `source`, whose bones `target` shares in order and
/// direction. Skin weights, where given, decide the joint that a vertex belongs to, and [`Owners`] elsewhere.
pub fn project(
    avatar: &TriangleMesh,
    target: &Skeleton,
    source: &Skeleton,
    skin: Option<&SkinWeights>,
) -> ProjectedAvatar {
    project_with(avatar, target, source, &Owners::find(avatar, target, skin), &[])
}

/// [`project`], where it is known what vertices belong to, with the body going on beyond `open` ends of bones as it does beyond leaf joints.
pub fn project_with(
    avatar: &TriangleMesh,
    target: &Skeleton,
    source: &Skeleton,
    owners: &Owners,
    open: &[OpenEnd],
) -> ProjectedAvatar {
    let graph = BoneGraph::new(source);
    let locations = avatar.positions.iter().enumerate().map(|(v, &end)| {
        let (bone, parameter) = attach(&graph, target, end, owners.of[v], open);
        Location::Bone { bone, parameter: on_source(parameter, bone, target, source) }
    });
    subdivide(avatar, locations.collect(), source, &graph)
}

/// The avatar with its vertices at `locations` of a skeleton at t = 0, subdivided so that every triangle collapses onto a
/// single bone of it. `graph` is that of `skeleton`.
pub fn subdivide(
    avatar: &TriangleMesh,
    locations: Vec<Location>,
    skeleton: &Skeleton,
    graph: &BoneGraph,
) -> ProjectedAvatar {
    let start = |location| match location {
        Location::Bone { bone, parameter } => skeleton.point_at(bone, parameter),
        Location::Joint(joint) => skeleton.joints[joint as usize],
    };
    let corners: Vec<Corner> = locations
        .iter()
        .zip(&avatar.positions)
        .map(|(&location, &end)| Corner { location, start: start(location), end })
        .collect();

    let shrunk = corners.iter().map(|c| c.start).collect();
    let mut out = ProjectedAvatar { shrunk, locations, ..Default::default() };
    let mut merged = HashMap::new();
    let mut pending = Vec::new();
    let mut paths: [Vec<u32>; 3] = Default::default();
    for (triangle, origin) in avatar.triangles.iter().zip(0..) {
        pending.push(triangle.map(|v| corners[v as usize]));
        while let Some(piece) = pending.pop() {
            for (edge, path) in paths.iter_mut().enumerate() {
                graph.joints_between(piece[edge].location, piece[(edge + 1) % 3].location, path);
            }
            let longest = (0..3).rev().max_by_key(|&e| paths[e].len()).unwrap_or(0);
            if paths[longest].is_empty() {
                out.push(&piece, graph.common_bone(&piece.map(|c| c.location)), origin, &mut merged);
                continue;
            }
            match (0..3)
                .find(|&e| paths[e].is_empty() && !paths[(e + 1) % 3].is_empty() && !paths[(e + 2) % 3].is_empty())
            {
                Some(base) => strip(&piece, base, &paths, skeleton, &mut pending),
                None => fan(&piece, longest, &paths[longest], skeleton, &mut pending),
            }
        }
    }
    out
}

/// The bone that a point belongs to, and its parameter there: the closest among the bones of `owner`, or among all.
pub(super) fn attach(
    graph: &BoneGraph,
    skeleton: &Skeleton,
    p: DVec3,
    owner: Option<Owner>,
    open: &[OpenEnd],
) -> (u32, f64) {
    let mut best = (f64::INFINITY, 0, 0.0);
    for (bone, ends) in skeleton.bones.iter().enumerate() {
        if owner.is_some_and(|owner| !owner.has(bone as u32, *ends)) {
            continue;
        }
        let mut parameter = graph.project(skeleton, bone as u32, p);
        if open.iter().any(|o| o.bone == bone as u32 && parameter == o.end as f64) {
            let [a, b] = ends.map(|j| skeleton.joints[j as usize]);
            let free = (p - a).dot(b - a) / (b - a).length_squared();
            let is_open = |end| open.iter().any(|o| o.bone == bone as u32 && o.end == end);
            let low = if is_open(0) { f64::NEG_INFINITY } else { parameter.min(0.0) };
            let high = if is_open(1) { f64::INFINITY } else { parameter.max(1.0) };
            parameter = free.clamp(low, high);
        }
        let distance = p.distance_squared(skeleton.point_at(bone as u32, parameter));
        if distance < best.0 {
            best = (distance, bone as u32, parameter);
        }
    }
    (best.1, best.2)
}

/// The parameter on the source skeleton. It is that on the target; but beyond the end of a bone that is many times longer
/// or shorter on one of them, the length beyond is scaled with the body and not with that bone.
fn on_source(parameter: f64, bone: u32, target: &Skeleton, source: &Skeleton) -> f64 {
    let inside = parameter.clamp(0.0, 1.0);
    let length = |s: &Skeleton| {
        let [a, b] = s.bones[bone as usize].map(|j| s.joints[j as usize]);
        a.distance(b)
    };
    let (on_source, on_target) = (length(source), length(target));
    if inside == parameter || on_source == 0.0 {
        return parameter;
    }
    let scale = (on_source / on_target).clamp(1.0 / ODD_BONE, ODD_BONE);
    inside + (parameter - inside) * (on_target / on_source) * scale
}

/// A bone whose lengths in the two skeletons differ by more than this factor tells nothing of what lies beyond its end.
const ODD_BONE: f64 = 4.0;

/// The corner at `joint`, the `k`-th of `count` equal parts along the edge from `a` to `b`.
fn at_joint(a: &Corner, b: &Corner, joint: u32, k: usize, count: usize, skeleton: &Skeleton) -> Corner {
    // Both triangles at an edge must find the same points on it, to the bit, whichever way they walk along it.
    let turned = a.end.to_array() > b.end.to_array();
    let (from, to, k) = if turned { (b.end, a.end, count - k) } else { (a.end, b.end, k) };
    Corner {
        location: Location::Joint(joint),
        start: skeleton.joints[joint as usize],
        end: from.lerp(to, k as f64 / count as f64),
    }
}

/// Replaces edge `edge` of `piece` by a chain over `joints` and fans the pieces to the opposite corner.
fn fan(piece: &[Corner; 3], edge: usize, joints: &[u32], skeleton: &Skeleton, pending: &mut Vec<[Corner; 3]>) {
    let [a, b, opposite] = [piece[edge], piece[(edge + 1) % 3], piece[(edge + 2) % 3]];
    let mut last = a;
    for (k, &joint) in joints.iter().enumerate() {
        let next = at_joint(&a, &b, joint, k + 1, joints.len() + 1, skeleton);
        pending.push([last, next, opposite]);
        last = next;
    }
    pending.push([last, b, opposite]);
}

/// Cuts `piece`, whose edge `base` passes no joint while the two others do, along the joints that both pass on the way from
/// the corner opposite to `base`.
fn strip(piece: &[Corner; 3], base: usize, paths: &[Vec<u32>; 3], skeleton: &Skeleton, pending: &mut Vec<[Corner; 3]>) {
    let [b, c, apex] = [piece[base], piece[(base + 1) % 3], piece[(base + 2) % 3]];
    // From the apex to b, as the edge runs; from the apex to c, against it.
    let (to_b, to_c) = (&paths[(base + 2) % 3], &paths[(base + 1) % 3]);
    let shared = to_b.iter().zip(to_c.iter().rev()).take_while(|(j, k)| j == k).count();
    if shared == 0 {
        return fan(piece, (base + 2) % 3, to_b, skeleton, pending);
    }
    let (mut left, mut right) = (apex, apex);
    for k in 0..shared {
        let next_left = at_joint(&apex, &b, to_b[k], k + 1, to_b.len() + 1, skeleton);
        let next_right = at_joint(&apex, &c, to_b[k], k + 1, to_c.len() + 1, skeleton);
        pending.push([left, next_left, next_right]);
        if k > 0 {
            pending.push([left, next_right, right]);
        }
        (left, right) = (next_left, next_right);
    }
    pending.push([left, b, c]);
    pending.push([left, c, right]);
}

impl ProjectedAvatar {
    /// The subdivided mesh at t = 0.
    pub fn start_mesh(&self) -> TriangleMesh {
        TriangleMesh { positions: self.start.clone(), triangles: self.triangles.clone() }
    }

    /// Vertices and triangles that the first `count` of the caller's triangles have been split into.
    pub fn size_of_first(&self, count: usize) -> [usize; 2] {
        // Both are in the order in which the caller's triangles came.
        let triangles = self.origins.partition_point(|&origin| (origin as usize) < count);
        let last = self.triangles[..triangles].iter().flatten().max();
        [last.map_or(0, |&v| v as usize + 1), triangles]
    }

    fn push(&mut self, piece: &[Corner; 3], bone: Option<u32>, origin: u32, merged: &mut HashMap<[u64; 6], u32>) {
        let corners = piece.map(|c| {
            let key = [c.start.x, c.start.y, c.start.z, c.end.x, c.end.y, c.end.z].map(f64::to_bits);
            *merged.entry(key).or_insert_with(|| {
                self.start.push(c.start);
                self.end.push(c.end);
                self.start.len() as u32 - 1
            })
        });
        self.triangles.push(corners);
        self.bones.push(bone);
        self.origins.push(origin);
    }
}
