//! What lies beyond an opening by its weights starts beyond it: a big head beyond the collar, a big glove beyond the cuff.
//!
//! A chin that hangs below the neck's joint, or the wide cuff of a glove on the forearm, lies on the garment's side of the opening
//! where it is measured along the bone. If it starts there, the opening closes around it, and no later step mends that. But the rig
//! knows what moves with the head or the hand. Where the garment ends on the last bone of a limb, such flesh of the
//! target reaches farther back than that of the body on which the garment was designed, and farther back than the opening, all
//! of it is moved along the bone, and keeps its order there:
//!
//! ```text
//! w -> b + (w - first) (last - b) / (last - first),
//! ```
//!
//! w the parameter along the bone from `first` to `last`, and b the first place beyond the opening.
//!
//! Feet are left where they are: a trouser leg goes over a boot, and one that was lifted off it would leave the shin bare.
//!
//! The opening, too, has its place by that: on what is free of the limb before such flesh begins, at the same share of it as on the
//! source body. The neck is free from the shoulders on, a forearm from the elbow.

use glam::DVec3;

use super::projection::{ProjectedAvatar, subdivide};
use super::winding::windings_of_loops;
use crate::geometry::mesh::{Topology, TriangleMesh};
use crate::geometry::quantile::quantile;
use crate::input::skeleton::{BoneGraph, Location, Skeleton};

/// The first place beyond an opening is so far from its farthest point, in the normalised space.
const BEYOND: f64 = 0.02;
/// What reaches farther back than on the source body by less than this, in the normalised space, lies as it does there.
const FARTHER_BACK: f64 = 0.02;
/// Flesh begins where this share of its area lies: of weights that were painted some are always elsewhere.
const BEGINS: f64 = 0.02;
/// A garment that covers more than this share of the flesh on the source body is worn on it.
const COVERED: f64 = 0.3;
/// As much of a limb counts as free where its end begins at once, in the normalised space.
const LEAST_FREE: f64 = 0.03;
/// How far bones reach beyond the skeleton's ends, in lengths of the bone.
const LEAF_REACH: f64 = 0.25;

/// A body in the normalised space, and what of it is the end of a limb by weights: a head and no neck, a hand and no forearm.
#[derive(Clone, Copy)]
pub struct Ends<'a> {
    /// The body.
    pub body: &'a TriangleMesh,
    /// For each vertex of an end the joint at which that limb of the skeleton ends.
    pub joints: &'a [Option<u32>],
}

/// An opening of a garment that ends there, on the last bone of a limb.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LimbOpening {
    /// The bone.
    pub bone: u32,
    /// Which of its joints is the leaf: 0 or 1.
    pub leaf: usize,
    /// Where on the bone, from 0 at its other joint to 1 at the leaf, the opening is: its mean, and its farthest point.
    pub at: [f64; 2],
}

/// An end of a limb that has moved beyond an opening.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MovedEnd {
    /// The opening, on the source skeleton.
    pub opening: LimbOpening,
    /// On source and target, where the limb begins to be free, and where its end begins, along the bone.
    pub free: [[f64; 2]; 2],
}

/// The `projected` avatar with what belongs to ends of its limbs, and starts before an opening of `garment`, beyond that, and these
/// ends; `source_ends` are those of the source body, where it is known. `skeletons` are those of target and source.
pub fn begin_beyond(
    projected: ProjectedAvatar,
    garment: &TriangleMesh,
    skeletons: [&Skeleton; 2],
    target_ends: Ends<'_>,
    source_ends: Option<Ends<'_>>,
) -> (ProjectedAvatar, Vec<MovedEnd>) {
    let source = skeletons[1];
    let graph = BoneGraph::new(source);
    let mut locations = projected.locations.clone();
    let moved = moved(&mut locations, garment, skeletons, &graph, target_ends, source_ends);
    let projected = if moved.is_empty() { projected } else { subdivide(target_ends.body, locations, source, &graph) };
    (projected, moved)
}

impl MovedEnd {
    /// Where `p` beside this bone of the source skeleton belongs on the target's: on the line of the bone.
    pub fn place(&self, p: DVec3, source: &Skeleton, target: &Skeleton) -> DVec3 {
        let [[from, to], [target_from, target_to]] = self.free;
        let share = (Line::new(source, &self.opening).parameter(p) - from) / (to - from);
        let line = Line::new(target, &self.opening);
        line.start + (target_from + share * (target_to - target_from)) * line.span
    }
}

/// Moves such flesh in the `locations` of its vertices on the source skeleton. Returns the ends that moved.
fn moved(
    locations: &mut [Location],
    garment: &TriangleMesh,
    [target, source]: [&Skeleton; 2],
    graph: &BoneGraph,
    target_ends: Ends<'_>,
    source_ends: Option<Ends<'_>>,
) -> Vec<MovedEnd> {
    let mut moved = Vec::new();
    let areas = target_ends.body.vertex_areas();
    for opening in openings(garment, source, graph) {
        let line = Line::new(target, &opening);
        let leaf = Some(line.leaf);
        let floor = line.floor(target, graph);
        let starts = |v: usize| match locations[v] {
            Location::Bone { bone, parameter } if bone == opening.bone && target_ends.joints[v] == leaf => {
                let parameter = if opening.leaf == 1 { parameter } else { 1.0 - parameter };
                // Before the bone's joint the projection does not count on.
                let own = line.parameter(target_ends.body.positions[v]);
                let parameter = if parameter > 0.0 { parameter } else { own };
                (own >= floor && areas[v] > 0.0).then_some(parameter)
            }
            _ => None,
        };
        let flesh: Vec<(usize, f64)> =
            (0..areas.len()).filter_map(|v| starts(v).map(|parameter| (v, parameter))).collect();
        let Some(begins) = quantile(flesh.iter().map(|&(v, w)| (w, areas[v])).collect(), BEGINS) else { continue };
        let on_source = Line::new(source, &opening);
        let beyond = opening.at[1] + BEYOND / on_source.length;
        let mut own = beyond;
        if let Some(ends) = source_ends {
            let Some([covered, begins_there]) = on_source.design(&opening, ends) else { continue };
            if covered > COVERED || begins > begins_there - FARTHER_BACK / on_source.length {
                continue;
            }
            own = begins_there;
        } else if opening.at[0] > 1.0 {
            continue;
        }
        let first = flesh.iter().map(|&(_, w)| w).fold(f64::INFINITY, f64::min);
        let last = flesh.iter().map(|&(_, w)| w).fold(f64::NEG_INFINITY, f64::max);
        if begins >= beyond || first >= last || last <= beyond {
            continue;
        }
        for (v, w) in flesh {
            let w = beyond + (w - first) * (last - beyond) / (last - first);
            let parameter = if opening.leaf == 1 { w } else { 1.0 - w };
            locations[v] = Location::Bone { bone: opening.bone, parameter };
        }
        let least = |from: f64, to: f64, line: &Line| [from, to.max(from + LEAST_FREE / line.length)];
        let from = on_source.floor(source, graph);
        moved.push(MovedEnd { opening, free: [least(from, own, &on_source), least(floor, begins, &line)] });
    }
    moved
}

/// The openings at which `garment` ends on last bones of limbs of the `source` skeleton; of several on one bone the farthest.
pub fn openings(garment: &TriangleMesh, source: &Skeleton, graph: &BoneGraph) -> Vec<LimbOpening> {
    let topology = Topology::new(garment.positions.len(), &garment.triangles);
    let loops: Vec<&[u32]> = topology.loops.iter().map(|border| border.vertices.as_slice()).collect();
    let wound = windings_of_loops(garment, &loops, &source.lengthened(LEAF_REACH));
    let mut found: Vec<LimbOpening> = Vec::new();
    for (vertices, winding) in loops.iter().zip(wound).filter(|(_, winding)| winding.linked) {
        for bone in winding.segments {
            let [a, b] = source.bones[bone as usize].map(|joint| graph.is_leaf(joint));
            if a == b {
                continue;
            }
            let mut opening = LimbOpening { bone, leaf: usize::from(b), at: [0.0; 2] };
            let line = Line::new(source, &opening);
            let parameters = || vertices.iter().map(|&v| line.parameter(garment.positions[v as usize]));
            let mean = parameters().sum::<f64>() / vertices.len() as f64;
            opening.at = [mean, parameters().fold(f64::NEG_INFINITY, f64::max)];
            if !ends_there(garment, vertices, &line) {
                continue;
            }
            match found.iter_mut().find(|other| other.bone == bone) {
                Some(other) if other.at[1] < opening.at[1] => *other = opening,
                Some(_) => {}
                None => found.push(opening),
            }
        }
    }
    found
}

/// Whether the triangles at this border lie before it, as at a cuff, and not beyond it, as at the border of a glove or a hat.
fn ends_there(garment: &TriangleMesh, border: &[u32], line: &Line) -> bool {
    let mut is_border = vec![false; garment.positions.len()];
    border.iter().for_each(|&v| is_border[v as usize] = true);
    let parameter = |v: u32| line.parameter(garment.positions[v as usize]);
    let (mut inner, mut outer) = ((0.0, 0), (0.0, 0));
    for triangle in garment.triangles.iter().filter(|t| t.iter().any(|&v| is_border[v as usize])) {
        for &v in triangle {
            let sum = if is_border[v as usize] { &mut outer } else { &mut inner };
            *sum = (sum.0 + parameter(v), sum.1 + 1);
        }
    }
    inner.1 > 0 && inner.0 / f64::from(inner.1) < outer.0 / f64::from(outer.1)
}

/// The line along a bone, from its inner joint to its leaf.
struct Line {
    joint: u32,
    leaf: u32,
    start: DVec3,
    span: DVec3,
    length: f64,
}

impl Line {
    fn new(skeleton: &Skeleton, opening: &LimbOpening) -> Self {
        let mut joints = skeleton.bones[opening.bone as usize];
        if opening.leaf == 0 {
            joints.reverse();
        }
        let [start, end] = joints.map(|joint| skeleton.joints[joint as usize]);
        let length = start.distance(end).max(f64::MIN_POSITIVE);
        Self { joint: joints[0], leaf: joints[1], start, span: end - start, length }
    }

    fn parameter(&self, p: DVec3) -> f64 {
        (p - self.start).dot(self.span) / (self.length * self.length)
    }

    /// What lies farther back than this hangs from the end of the limb, as long hair does: beyond the joints around the bone's inner
    /// one, as the shoulders are around the neck.
    fn floor(&self, skeleton: &Skeleton, graph: &BoneGraph) -> f64 {
        if graph.degree(self.joint) < 3 {
            return 0.0;
        }
        let others = graph.bones_at(self.joint).iter().flat_map(|&bone| skeleton.bones[bone as usize]);
        let back = others.map(|joint| self.parameter(skeleton.joints[joint as usize])).filter(|&w| w < 0.0);
        back.fold(f64::NEG_INFINITY, f64::max).min(0.0)
    }

    /// How much of the flesh of the source body at the limb's end lies before the opening, and where it begins.
    fn design(&self, opening: &LimbOpening, ends: Ends<'_>) -> Option<[f64; 2]> {
        let areas = ends.body.vertex_areas();
        let own = (0..areas.len()).filter(|&v| ends.joints[v] == Some(self.leaf));
        let flesh: Vec<(f64, f64)> = own.map(|v| (self.parameter(ends.body.positions[v]), areas[v])).collect();
        let total: f64 = flesh.iter().map(|(_, area)| area).sum();
        let before: f64 = flesh.iter().filter(|(w, _)| *w < opening.at[0]).map(|(_, area)| area).sum();
        let begins = quantile(flesh, BEGINS)?;
        (total > 0.0).then(|| [before / total, begins])
    }
}
