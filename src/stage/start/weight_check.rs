//! Skin weights that contradict the positions: vertices that belong to a joint far away while a bone lies right beneath them.
//!
//! Distance alone does not tell a leg that an export bound to the root from a skirt that belongs there. So it takes one of
//! two more signs. A bone is *deserted* where nothing around it belongs near it: then what lies around it is its flesh. And a
//! patch is *astray* where the surface beside it belongs to quite other joints: a long hair or a cape goes on into the head or
//! the shoulders, to which it is bound.

use std::borrow::Cow;

use glam::DVec3;
use rayon::prelude::*;

use crate::geometry::mesh::{TriangleMesh, label_pieces};
use crate::input::diagnostic::Diagnostic;
use crate::input::skeleton::{BoneGraph, Skeleton};
use crate::input::skin::SkinWeights;
use crate::input::weld::weld_vertices;
use crate::maths;

/// A vertex contradicts where its own bone is farther than the nearest one by this, in the normalised space...
const FARTHER: f64 = 0.25;
/// ...and by this factor.
const TIMES_FARTHER: f64 = 3.0;
/// Weights of this share of the largest are a second opinion: a vertex with one for the nearest bone contradicts nothing.
const ALMOST: f64 = 0.5;
/// The flesh beyond a leaf joint counts up to so many lengths of its bone.
const LEAF_REACH: f64 = 1.0;
/// Sectors around a bone, and stations along it, for which it is asked what lies there.
const SECTORS: usize = 6;
const STATIONS: usize = 4;
/// Fewer sectors with a vertex than this tell nothing.
const FEWEST_SECTORS: usize = 6;
/// A patch is astray where the surface beside it belongs to bones that are so many joints away from its own.
const ASTRAY_HOPS: usize = 2;
/// Weights with a larger share of contradictions than this are believed nowhere: their joints are in another order.
const BELIEVABLE: f64 = 0.3;

/// Where a vertex lies, and where its weights put it.
#[derive(Clone, Copy)]
struct Place {
    /// The nearest bone, and the sector around it.
    near: u32,
    sector: u8,
    /// The joint of largest weight; none decides nothing.
    joint: Option<u32>,
    /// That joint's bones are far away.
    contradicts: bool,
}

/// Vertices whose weights contradict their positions.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Contradictions {
    /// The vertices, ascending.
    pub vertices: Vec<u32>,
    /// The clearest ones, at most four.
    pub first: Vec<u32>,
    /// Of the first of these: its joint of largest weight, and the bone that is nearest to it.
    pub example: Option<(u32, u32)>,
    /// Vertices that have weights and belong to a triangle.
    pub weighted: usize,
}

/// The vertices of `avatar` (normalised, as is its skeleton `target`) whose weights in `skin` contradict their positions.
pub fn contradictions(avatar: &TriangleMesh, target: &Skeleton, skin: &SkinWeights) -> Contradictions {
    let graph = BoneGraph::new(target);
    let used = avatar.used_vertices();
    let frames: Vec<[DVec3; 2]> = target.bones.iter().map(|&bone| axes_across(target, bone)).collect();
    let places: Vec<Place> = (0..avatar.positions.len())
        .into_par_iter()
        .map(|v| {
            let joint = if used[v] { skin.dominant_joint(v) } else { None };
            let place = place(&graph, target, &frames, avatar.positions[v], joint);
            let contradicts = place.contradicts && !binds_to(skin, v, target.bones[place.near as usize]);
            Place { contradicts, ..place }
        })
        .collect();
    let weighted = places.iter().filter(|p| p.joint.is_some()).count();
    if !places.iter().any(|p| p.contradicts) {
        return Contradictions { weighted, ..Contradictions::default() };
    }
    let deserted = deserted(&places, target);
    let is_lost =
        |p: &Place| deserted[p.near as usize] && p.joint.is_some_and(|j| !target.bones[p.near as usize].contains(&j));
    let mut wrong: Vec<bool> = places.iter().map(is_lost).collect();
    mark_astray(&mut wrong, avatar, &places, &graph);
    if wrong.iter().filter(|&&w| w).count() as f64 > BELIEVABLE * weighted as f64 {
        wrong = places.iter().map(|p| p.joint.is_some()).collect();
    }
    let vertices: Vec<u32> = (0u32..).zip(&wrong).filter(|(_, w)| **w).map(|(v, _)| v).collect();
    let clear = |v: &u32| places[*v as usize].contradicts;
    let first: Vec<u32> = vertices.iter().copied().filter(clear).take(4).collect();
    let example = first.first().map(|&v| places[v as usize]);
    Contradictions { vertices, first, example: example.and_then(|p| Some((p.joint?, p.near))), weighted }
}

/// `skin` where it can be believed: the nearest bone decides for vertices whose weights contradict their positions, unless
/// `strict`. Adds to `diagnostics`.
pub fn believed<'a>(
    skin: &'a SkinWeights,
    avatar: &TriangleMesh,
    target: &Skeleton,
    strict: bool,
    diagnostics: &mut Vec<Diagnostic>,
) -> Cow<'a, SkinWeights> {
    let found = contradictions(avatar, target, skin);
    if found.vertices.is_empty() {
        return Cow::Borrowed(skin);
    }
    diagnostics.push(Diagnostic::WeightsContradict {
        count: found.vertices.len(),
        weighted: found.weighted,
        first: found.first,
        example: found.example.map(|(joint, bone)| (joint, target.bones[bone as usize])),
        mended: !strict,
    });
    if strict { Cow::Borrowed(skin) } else { Cow::Owned(skin.without(&found.vertices)) }
}

/// Whether the weights of vertex `v` bind it to one of these joints almost as much as to any.
fn binds_to(skin: &SkinWeights, v: usize, joints: [u32; 2]) -> bool {
    let weights = skin.weights(v);
    let largest = weights.iter().map(|&(_, weight)| weight).fold(0.0, f64::max);
    weights.iter().any(|&(joint, weight)| joints.contains(&joint) && weight >= ALMOST * largest)
}

/// Two axes across a bone.
fn axes_across(skeleton: &Skeleton, [a, b]: [u32; 2]) -> [DVec3; 2] {
    let along = skeleton.joints[b as usize] - skeleton.joints[a as usize];
    let (u, v) = along.try_normalize().unwrap_or(DVec3::Z).any_orthonormal_pair();
    [u, v]
}

/// Where `p` lies among the bones, and whether the bones at `joint` are far away.
fn place(graph: &BoneGraph, target: &Skeleton, frames: &[[DVec3; 2]], p: DVec3, joint: Option<u32>) -> Place {
    let (mut near, mut own) = ((f64::INFINITY, 0u32, 0.0), f64::INFINITY);
    for (bone, ends) in (0u32..).zip(&target.bones) {
        // Beyond a leaf its own bone may reach any distance, but it takes no vertex of others there.
        let unbounded = graph.project(target, bone, p);
        if joint.is_some_and(|j| ends.contains(&j)) {
            own = own.min(p.distance(target.point_at(bone, unbounded)));
        }
        let parameter = unbounded.clamp(-LEAF_REACH, 1.0 + LEAF_REACH);
        let distance = p.distance(target.point_at(bone, parameter));
        if distance < near.0 {
            near = (distance, bone, parameter);
        }
    }
    let (distance, bone, parameter) = near;
    let offset = p - target.point_at(bone, parameter);
    let angle = maths::atan2(offset.dot(frames[bone as usize][1]), offset.dot(frames[bone as usize][0]));
    let turn = (angle / std::f64::consts::TAU).rem_euclid(1.0);
    let around = ((turn * SECTORS as f64) as usize).min(SECTORS - 1);
    let along = ((parameter.clamp(0.0, 1.0) * STATIONS as f64) as usize).min(STATIONS - 1);
    Place {
        near: bone,
        sector: (along * SECTORS + around) as u8,
        joint,
        contradicts: joint.is_some() && own > distance + FARTHER && own > TIMES_FARTHER * distance,
    }
}

/// The bones around most of which there are only vertices that contradict.
fn deserted(places: &[Place], target: &Skeleton) -> Vec<bool> {
    // A bit for each sector: what contradicts there, and what does not.
    let mut occupied = vec![[0u32; 2]; target.bones.len()];
    for place in places.iter().filter(|p| p.joint.is_some()) {
        occupied[place.near as usize][usize::from(!place.contradicts)] |= 1 << place.sector;
    }
    occupied
        .iter()
        .map(|&[wrong, right]| {
            let all = (wrong | right).count_ones() as usize;
            all >= FEWEST_SECTORS && 2 * right.count_ones() as usize <= all
        })
        .collect()
}

/// Adds to `wrong` the patches of vertices that contradict beside a surface that belongs to quite other joints.
fn mark_astray(wrong: &mut [bool], avatar: &TriangleMesh, places: &[Place], graph: &BoneGraph) {
    let (to_welded, first) = weld_vertices(avatar);
    // All copies of a vertex count as one; where their weights differ, as the first.
    let at = |v: u32| first[to_welded[v as usize] as usize];
    let edges = || {
        let corners = avatar.triangles.iter().map(|t| t.map(at));
        corners.flat_map(|[a, b, c]| [[a, b], [b, c], [c, a]])
    };
    let suspect = |v: u32| places[v as usize].contradicts;
    let inside = edges().filter(|&[a, b]| suspect(a) && suspect(b));
    let alone = edges().flatten().filter(|&v| suspect(v)).map(|v| [v, v]);
    let (patches, count) = label_pieces(places.len(), inside.chain(alone));
    // Edges that lead out of each patch: all, and those to other joints.
    let mut rims = vec![[0usize; 2]; count];
    for [a, b] in edges().filter(|&[a, b]| suspect(a) != suspect(b)) {
        let (v, beside) = if suspect(a) { (a, b) } else { (b, a) };
        let (Some(own), Some(other)) = (places[v as usize].joint, places[beside as usize].joint) else { continue };
        let rim = &mut rims[patches[v as usize] as usize];
        rim[0] += 1;
        rim[1] += usize::from(graph.joint_distance(own, other) >= ASTRAY_HOPS);
    }
    for v in (0..places.len() as u32).filter(|&v| suspect(at(v))) {
        let patch = patches[at(v) as usize];
        wrong[v as usize] |= rims.get(patch as usize).is_some_and(|&[all, other]| 2 * other > all);
    }
}
