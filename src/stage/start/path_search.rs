//! Path search: the bent skeleton of least cost inside the garment.
//!
//! Each bone has stations along it, each joint and station an offset grid of candidates, and a bent skeleton is one candidate
//! for each station. From a candidate it may go on to a near one of the next station where the segment between them keeps
//! clear of the garment. Offsets, bends, points that the garment does not enclose and nearness to it cost; so does retracting
//! all that lies beyond a station to it, and the more, the more that is. The skeleton is a tree, its cycles being cut, so that
//! dynamic programming from its leaves to its root finds the least sum.

use glam::DVec3;
use rayon::prelude::*;

use super::bent_skeleton::BentSkeleton;
use super::inside::Inside;
use super::offset_grid::{UniformGrid, ball, disc};
use crate::control::{Cancel, Cancelled};
use crate::geometry::closest_point::ClosestPoint;
use crate::geometry::mesh::TriangleMesh;
use crate::geometry::section::Section;
use crate::input::skeleton::Skeleton;

/// How widely and finely to search. Lengths are in the normalised space.
#[derive(Clone, Copy)]
pub struct SearchSettings {
    /// The largest offset.
    pub radius: f64,
    /// Between neighbouring offsets.
    pub spacing: f64,
    /// The bent skeleton keeps half of this from the garment.
    pub clearance: f64,
}

/// What the path is searched in.
pub struct PathSearch<'a> {
    /// The garment.
    pub garment: &'a TriangleMesh,
    /// Distances to it.
    pub tree: ClosestPoint,
    /// The source skeleton.
    pub source: &'a Skeleton,
    /// For each bone, the least and the largest parameter of anything on it, 0 and 1 included.
    pub extents: Vec<[f64; 2]>,
    /// Bones that should go through points that the garment encloses, where there are any.
    pub prefer_enclosed: Vec<bool>,
    /// What each bone must stay inside of, where it must.
    pub keep_inside: Vec<Option<Inside<'a>>>,
    /// In how many of three planes the garment should enclose the root.
    pub root_planes: u32,
}

/// A bent skeleton, and how it differs from the source.
pub struct SkeletonPath {
    /// The bent skeleton.
    pub bent: BentSkeleton,
    /// The largest offset on each bone.
    pub displacements: Vec<f64>,
    /// How much of each bone is retracted to a point, in the normalised space: between its joints, and beyond a leaf.
    pub retracted: Vec<[f64; 2]>,
}

/// Candidates in all, at most: many bones leave fewer to each.
const MAX_CANDIDATES: usize = 600_000;
/// Stations of a bone, at most.
const MAX_STATIONS: usize = 64;
/// Stations are as many spacings apart, a joint's offsets too.
const STRIDE: f64 = 1.5;
/// From station to station an offset changes by at most as many spacings.
const MAX_CHANGE: f64 = 2.5;
/// Sphere-tracing steps along a segment, at most, to see whether it is clear.
const MAX_TRACING_STEPS: u32 = 256;

/// An offset that costs as much as the length at which it is held.
const UNIT_OFFSET: f64 = 0.1;
/// Cost of a bend.
const BEND: f64 = 0.2;
/// Cost of a length that touches the garment; none at [`NEAR`], where the barrier begins while the avatar grows.
const TOUCH: f64 = 1.0;
const NEAR: f64 = 0.01;
/// Cost of a length that the garment does not enclose.
const NOT_ENCLOSED: f64 = 100.0;
/// Cost of a root that the garment does not enclose, for each of the planes in which it should.
const ROOT_NOT_ENCLOSED: f64 = 1e4;
/// Cost of retracting: at all, and a length of it; between joints, and beyond a leaf.
const RETRACT_BONE: [f64; 2] = [1.0, 300.0];
const RETRACT_LEAF: [f64; 2] = [0.02, 2.0];

/// The successor that stands for "all that lies beyond is retracted to here".
pub(super) const RETRACTED: u32 = u32::MAX;

/// Candidates for the bent skeleton at one joint or station: a stage of the dynamic programme.
pub(super) struct Candidates {
    pub(super) base: DVec3,
    pub(super) offsets: Vec<DVec3>,
    /// Distance of each candidate to the garment.
    distance: Vec<f64>,
    cost: Vec<f64>,
}

/// A bone from the joint nearer to the root to the other, or what lies beyond a leaf.
pub(super) struct Chain {
    pub(super) bone: u32,
    /// The joint at its end, none beyond a leaf.
    pub(super) end: Option<u32>,
    /// Of the stations after the joint where it begins; the last is its end.
    pub(super) parameters: Vec<f64>,
    /// At those stations, but for a joint at its end.
    pub(super) candidates: Vec<Candidates>,
    /// For each station and candidate but those of the last, the candidate that follows.
    pub(super) next: Vec<Vec<u32>>,
}

impl PathSearch<'_> {
    /// The path of least cost from `root`, without the bones that are `cut`. None where there is no candidate for the root.
    ///
    /// # Errors
    /// [`Cancelled`]; the token is checked before each chain and in the end.
    pub fn find(
        &self,
        root: u32,
        cut: &[bool],
        settings: &SearchSettings,
        cancel: &Cancel,
    ) -> Result<Option<SkeletonPath>, Cancelled> {
        let mut chains = self.chains(root, cut, settings);
        let stations: usize = chains.iter().flatten().map(|c| c.parameters.len()).sum();
        let count = MAX_CANDIDATES / stations.max(1);
        let joint_offsets = ball(settings.radius, STRIDE * settings.spacing, 4 * count);
        let order = self.outwards(root, &chains);
        let mut joints: Vec<Candidates> = (0..chains.len()).map(|_| Candidates::empty()).collect();
        let mut values: Vec<Vec<f64>> = vec![Vec::new(); chains.len()];
        // What it costs to retract all that lies beyond each joint.
        let mut beyond_costs = vec![0.0; chains.len()];
        for &joint in order.iter().rev() {
            let j = joint as usize;
            let base = self.source.joints[j];
            joints[j] = self.candidates(base, joint_offsets.clone(), STRIDE * settings.spacing, settings);
            let mut value = joints[j].cost.clone();
            for chain in &mut chains[j] {
                cancel.check()?;
                self.set_candidates(chain, count, settings);
                let value_of_chain = self.solve_chain(chain, &joints, &values, &beyond_costs, j, settings);
                value.iter_mut().zip(value_of_chain).for_each(|(v, c)| *v += c);
            }
            beyond_costs[j] = chains[j].iter().map(|c| self.retraction_cost(c, 0, &beyond_costs)).sum();
            values[j] = value;
        }
        let r = root as usize;
        let mut by_value: Vec<usize> = (0..values[r].len()).collect();
        by_value.sort_by(|&a, &b| values[r][a].total_cmp(&values[r][b]));
        let mut best = None;
        for k in by_value {
            if best.is_some_and(|(least, _)| values[r][k] >= least) {
                break;
            }
            let missing = match self.root_planes {
                0 => 0,
                planes => planes.saturating_sub(enclosing_planes(self.garment, joints[r].point(k))),
            };
            let value = values[r][k] + ROOT_NOT_ENCLOSED * f64::from(missing);
            if best.is_none_or(|(least, _)| value < least) {
                best = Some((value, k));
            }
        }
        let path = best.map(|(_, first)| self.trace(root, first, &chains, &joints, cut, settings));
        cancel.check()?;
        Ok(path)
    }

    /// The chains that begin at each joint.
    fn chains(&self, root: u32, cut: &[bool], settings: &SearchSettings) -> Vec<Vec<Chain>> {
        let mut at = vec![Vec::new(); self.source.joints.len()];
        for (bone, &[a, b]) in self.source.bones.iter().enumerate() {
            if !cut[bone] {
                at[a as usize].push((bone, b));
                at[b as usize].push((bone, a));
            }
        }
        let mut chains: Vec<Vec<Chain>> = (0..at.len()).map(|_| Vec::new()).collect();
        let mut stack = vec![(root, usize::MAX)];
        while let Some((joint, from)) = stack.pop() {
            for &(bone, other) in &at[joint as usize] {
                let here = if self.source.bones[bone][0] == joint { 0.0 } else { 1.0 };
                if bone != from {
                    chains[joint as usize].push(self.chain(bone, [here, 1.0 - here], Some(other), settings));
                    stack.push((other, bone));
                }
                let beyond = self.extents[bone][here as usize];
                if beyond != here {
                    chains[joint as usize].push(self.chain(bone, [here, beyond], None, settings));
                }
            }
        }
        chains
    }

    fn chain(&self, bone: usize, [from, to]: [f64; 2], end: Option<u32>, settings: &SearchSettings) -> Chain {
        let parts = (self.length(bone) * (to - from).abs() / (STRIDE * settings.spacing)).ceil();
        let parts = parts.clamp(1.0, MAX_STATIONS as f64) as usize;
        let at = |k: usize| if k == parts { to } else { from + (to - from) * k as f64 / parts as f64 };
        let parameters = (1..=parts).map(at).collect();
        Chain { bone: bone as u32, end, parameters, candidates: Vec::new(), next: Vec::new() }
    }

    /// The joints in an order in which each comes after the one nearer to the root.
    fn outwards(&self, root: u32, chains: &[Vec<Chain>]) -> Vec<u32> {
        let mut order = vec![root];
        let mut done = 0;
        while let Some(&joint) = order.get(done) {
            order.extend(chains[joint as usize].iter().filter_map(|c| c.end));
            done += 1;
        }
        order
    }

    pub(super) fn length(&self, bone: usize) -> f64 {
        let [a, b] = self.source.bones[bone].map(|j| self.source.joints[j as usize]);
        a.distance(b)
    }

    /// The cost of retracting what lies beyond station `from` of a chain; 0 is the joint where it begins.
    fn retraction_cost(&self, chain: &Chain, from: usize, beyond_costs: &[f64]) -> f64 {
        let last = chain.parameters.len();
        let [here, end] = [self.parameter(chain, from), chain.parameters[last - 1]];
        let length = self.length(chain.bone as usize) * (end - here).abs();
        let [once, each] = if chain.end.is_some() { RETRACT_BONE } else { RETRACT_LEAF };
        once + each * length + chain.end.map_or(0.0, |j| beyond_costs[j as usize])
    }

    /// The parameter of station `k`; 0 is the joint where the chain begins.
    pub(super) fn parameter(&self, chain: &Chain, k: usize) -> f64 {
        if k > 0 {
            return chain.parameters[k - 1];
        }
        match chain.end {
            Some(end) => f64::from(u8::from(self.source.bones[chain.bone as usize][0] == end)),
            None => chain.parameters[chain.parameters.len() - 1].clamp(0.0, 1.0),
        }
    }

    /// Sets the candidates at the stations of a chain.
    fn set_candidates(&self, chain: &mut Chain, count: usize, settings: &SearchSettings) {
        let [a, b] = self.source.bones[chain.bone as usize].map(|j| self.source.joints[j as usize]);
        let inner = chain.parameters.len() - usize::from(chain.end.is_some());
        let prefer_enclosed = self.prefer_enclosed[chain.bone as usize] && chain.end.is_some();
        let step = self.length(chain.bone as usize) * (chain.parameters[0] - self.parameter(chain, 0)).abs();
        let candidates_at = |&parameter: &f64| {
            let base = self.source.point_at(chain.bone, parameter);
            let (u, v) = (b - a).try_normalize().unwrap_or(DVec3::Z).any_orthonormal_pair();
            let mut candidates =
                self.candidates(base, disc(settings.radius, settings.spacing, count, [u, v]), step, settings);
            if let Some(inside) = &self.keep_inside[chain.bone as usize] {
                candidates.keep(&inside.at(base, b - a, &candidates.offsets));
            } else if prefer_enclosed {
                let section = Section::cut(self.garment, base, b - a);
                let enclosed: Vec<bool> = candidates.offsets.iter().map(|&o| section.encloses(base + o)).collect();
                if enclosed.iter().any(|&e| e) {
                    let costs = candidates.cost.iter_mut().zip(enclosed);
                    costs.filter(|(_, e)| !e).for_each(|(c, _)| *c += NOT_ENCLOSED * step);
                }
            }
            candidates
        };
        chain.candidates = chain.parameters[..inner].par_iter().map(candidates_at).collect();
    }

    /// Candidates of those `offsets` that keep clear of the garment; each stands for a `length`.
    fn candidates(&self, base: DVec3, offsets: Vec<DVec3>, length: f64, settings: &SearchSettings) -> Candidates {
        let distances: Vec<f64> = offsets.par_iter().map(|&o| self.tree.distance(base + o)).collect();
        let mut candidates = Candidates { base, ..Candidates::empty() };
        for (offset, distance) in offsets.into_iter().zip(distances).filter(|(_, d)| *d >= settings.clearance) {
            let wide = offset.length_squared() / (UNIT_OFFSET * UNIT_OFFSET);
            let near = (1.0 - distance / NEAR).max(0.0).powi(2);
            candidates.offsets.push(offset);
            candidates.distance.push(distance);
            candidates.cost.push(length * (wide + TOUCH * near));
        }
        candidates
    }

    /// Dynamic programming along a chain that begins at joint `start`, from its end: sets the successor of each candidate, and
    /// returns the least cost from each candidate of that joint.
    fn solve_chain(
        &self,
        chain: &mut Chain,
        joints: &[Candidates],
        values: &[Vec<f64>],
        beyond_costs: &[f64],
        start: usize,
        settings: &SearchSettings,
    ) -> Vec<f64> {
        let stations = chain.parameters.len();
        let at = |k: usize| match chain.end {
            _ if k == 0 => &joints[start],
            Some(joint) if k == stations => &joints[joint as usize],
            _ => &chain.candidates[k - 1],
        };
        let mut value = match chain.end {
            Some(joint) => values[joint as usize].clone(),
            None => at(stations).cost.clone(),
        };
        let reach = MAX_CHANGE * settings.spacing;
        let mut next = vec![Vec::new(); stations];
        for k in (0..stations).rev() {
            let (here, there) = (at(k), at(k + 1));
            let grid = UniformGrid::new(&there.offsets, reach);
            let stride = here.base.distance(there.base).max(settings.spacing);
            let retracted = self.retraction_cost(chain, k, beyond_costs);
            let best = |i: usize| {
                let offset = here.offsets[i];
                let mut best = (retracted, RETRACTED);
                grid.for_each_near(offset, |j| {
                    let change = there.offsets[j].distance_squared(offset);
                    let cost = BEND * change / stride + value[j];
                    if change <= reach * reach
                        && cost < best.0
                        && self.is_clear(
                            [here.base + offset, there.base + there.offsets[j]],
                            [here.distance[i], there.distance[j]],
                            settings.clearance,
                        )
                    {
                        best = (cost, j as u32);
                    }
                });
                // The joint's own cost is counted with the joint.
                (best.0 + if k == 0 { 0.0 } else { here.cost[i] }, best.1)
            };
            (value, next[k]) = (0..here.offsets.len()).into_par_iter().map(best).unzip();
        }
        chain.next = next;
        value
    }

    /// Whether the segment between two points keeps half the clearance, given the distances of its ends: by sphere tracing.
    pub(super) fn is_clear(&self, [a, b]: [DVec3; 2], [distance_a, distance_b]: [f64; 2], clearance: f64) -> bool {
        let length = a.distance(b);
        if distance_a + distance_b - length >= clearance {
            return true;
        }
        let kept = 0.5 * clearance;
        let mut along = distance_a - kept;
        for _ in 0..MAX_TRACING_STEPS {
            if along >= length - (distance_b - kept) {
                return true;
            }
            let distance = self.tree.distance(a.lerp(b, along / length));
            if distance < clearance {
                return false;
            }
            along += distance - kept;
        }
        false
    }
}

impl Candidates {
    fn empty() -> Self {
        Self { base: DVec3::ZERO, offsets: Vec::new(), distance: Vec::new(), cost: Vec::new() }
    }

    /// Keeps those that are marked.
    fn keep(&mut self, kept: &[bool]) {
        let mut each = kept.iter();
        self.offsets.retain(|_| each.next() == Some(&true));
        for values in [&mut self.distance, &mut self.cost] {
            let mut each = kept.iter();
            values.retain(|_| each.next() == Some(&true));
        }
    }

    pub(super) fn point(&self, k: usize) -> DVec3 {
        self.base + self.offsets[k]
    }
}

/// In how many of three planes the garment encloses `p`.
pub fn enclosing_planes(garment: &TriangleMesh, p: DVec3) -> u32 {
    [DVec3::X, DVec3::Y, DVec3::Z].iter().map(|&n| u32::from(Section::cut(garment, p, n).encloses(p))).sum()
}
