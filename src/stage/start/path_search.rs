//! The way of least cost for the source skeleton through the garment's inside.
//!
//! Each bone is cut into layers, each joint and layer has a lattice of offsets, and a wire is one offset for each layer. It
//! may go from an offset to one that is near in the next layer where the straight way between them keeps clear of the
//! garment. Offsets, bends, places that the garment is not around and nearness to it cost; so does pulling all that lies
//! beyond a place back to that place, and the more, the more that is. The skeleton is a tree, its cycles being cut, so that
//! dynamic programming from its leaves to its root finds the least sum.

use glam::DVec3;
use rayon::prelude::*;

use super::bent_skeleton::{Knot, Wire};
use super::offset_grid::{Cells, ball, disc};
use super::section::Section;
use crate::control::{Cancel, Cancelled};
use crate::geometry::closest_point::ClosestPoint;
use crate::geometry::mesh::TriangleMesh;
use crate::input::skeleton::Skeleton;

/// How widely and finely to look. Lengths are in the normalised space.
#[derive(Clone, Copy)]
pub struct Search {
    /// The largest offset.
    pub radius: f64,
    /// Between neighbouring offsets.
    pub spacing: f64,
    /// The wire keeps half of this from the garment.
    pub clearance: f64,
}

/// What the search goes through.
pub struct Scene<'a> {
    /// The garment.
    pub garment: &'a TriangleMesh,
    /// Distances to it.
    pub tree: ClosestPoint,
    /// The source skeleton.
    pub source: &'a Skeleton,
    /// For each bone, the least and the largest parameter of anything on it, 0 and 1 included.
    pub extents: Vec<[f64; 2]>,
    /// Bones that the wire should lead through places that the garment is around, where there are any.
    pub sought: Vec<bool>,
}

/// A wire, and what it costs the skeleton.
pub struct Route {
    /// The wire.
    pub wire: Wire,
    /// The largest offset on each bone.
    pub offsets: Vec<f64>,
    /// How much of each bone is pulled back to a point, in the normalised space: between its joints, and beyond a leaf.
    pub pulled: Vec<[f64; 2]>,
}

/// At most as many offsets are looked at in all: many bones leave fewer to each.
const BUDGET: usize = 600_000;
/// Layers of a bone, at most.
const LAYERS: usize = 64;
/// Layers are as many spacings apart, a joint's offsets too.
const STRIDE: f64 = 1.5;
/// From layer to layer an offset changes by at most as many spacings.
const CHANGE: f64 = 2.5;
/// Steps along a straight way, at most, to see whether it is clear.
const STEPS: u32 = 256;

/// An offset that costs as much as its length of wire.
const WIDE: f64 = 0.1;
/// Cost of a bend.
const BEND: f64 = 0.2;
/// Cost of a length of wire that touches the garment; none at [`NEAR`], where the barrier begins while the avatar grows.
const TOUCH: f64 = 1.0;
const NEAR: f64 = 0.01;
/// Cost of a length of wire that the garment is not around.
const BESIDE: f64 = 100.0;
/// Cost of a root that the garment is not around, for each of three planes.
const ROOT_BESIDE: f64 = 1e4;
/// Cost of pulling back: at all, and a length of it; between joints, and beyond a leaf.
const PULL_BONE: [f64; 2] = [1.0, 300.0];
const PULL_LEAF: [f64; 2] = [0.02, 2.0];

/// The candidate that stands for "all that lies beyond is pulled back to here".
const PULLED: u32 = u32::MAX;

/// Candidates for the wire at one place.
struct Layer {
    base: DVec3,
    offsets: Vec<DVec3>,
    /// Distance of each candidate to the garment.
    room: Vec<f64>,
    cost: Vec<f64>,
}

/// A bone from the joint nearer to the root to the other, or what lies beyond a leaf.
struct Chain {
    bone: u32,
    /// The joint at its end, none beyond a leaf.
    end: Option<u32>,
    /// Of the places after the joint where it begins; the last is its end.
    parameters: Vec<f64>,
    /// At those places, but for a joint at its end.
    layers: Vec<Layer>,
    /// For each place and candidate but those of the last, the candidate that follows.
    next: Vec<Vec<u32>>,
}

impl Scene<'_> {
    /// The wire of least cost from `root`, without the bones that are `cut`. None where there is no place for the root.
    ///
    /// # Errors
    /// [`Cancelled`]; `cancel` is looked at before each bone and in the end.
    pub fn route(&self, root: u32, cut: &[bool], search: &Search, cancel: &Cancel) -> Result<Option<Route>, Cancelled> {
        let mut chains = self.chains(root, cut, search);
        let places: usize = chains.iter().flatten().map(|c| c.parameters.len()).sum();
        let count = BUDGET / places.max(1);
        let joint_offsets = ball(search.radius, STRIDE * search.spacing, 4 * count);
        let order = self.outwards(root, &chains);
        let mut joints: Vec<Layer> = (0..chains.len()).map(|_| Layer::empty()).collect();
        let mut values: Vec<Vec<f64>> = vec![Vec::new(); chains.len()];
        // Length of what would be pulled back with each joint, in terms of its cost.
        let mut behind = vec![0.0; chains.len()];
        for &joint in order.iter().rev() {
            let j = joint as usize;
            let base = self.source.joints[j];
            joints[j] = self.layer(base, joint_offsets.clone(), STRIDE * search.spacing, search);
            let mut value = joints[j].cost.clone();
            for chain in &mut chains[j] {
                cancel.check()?;
                self.fill(chain, count, search);
                let value_of_chain = self.solve(chain, &joints, &values, &behind, j, search);
                value.iter_mut().zip(value_of_chain).for_each(|(v, c)| *v += c);
            }
            behind[j] = chains[j].iter().map(|c| self.price(c, 0, &behind)).sum();
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
            let missing = 3 - around(self.garment, joints[r].base + joints[r].offsets[k]);
            let value = values[r][k] + ROOT_BESIDE * f64::from(missing);
            if best.is_none_or(|(least, _)| value < least) {
                best = Some((value, k));
            }
        }
        let route = best.map(|(_, first)| self.trace(root, first, &chains, &joints, cut, search));
        cancel.check()?;
        Ok(route)
    }

    /// The chains that begin at each joint.
    fn chains(&self, root: u32, cut: &[bool], search: &Search) -> Vec<Vec<Chain>> {
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
                    chains[joint as usize].push(self.chain(bone, [here, 1.0 - here], Some(other), search));
                    stack.push((other, bone));
                }
                let beyond = self.extents[bone][here as usize];
                if beyond != here {
                    chains[joint as usize].push(self.chain(bone, [here, beyond], None, search));
                }
            }
        }
        chains
    }

    fn chain(&self, bone: usize, [from, to]: [f64; 2], end: Option<u32>, search: &Search) -> Chain {
        let parts = (self.length(bone) * (to - from).abs() / (STRIDE * search.spacing)).ceil();
        let parts = parts.clamp(1.0, LAYERS as f64) as usize;
        let at = |k: usize| if k == parts { to } else { from + (to - from) * k as f64 / parts as f64 };
        let parameters = (1..=parts).map(at).collect();
        Chain { bone: bone as u32, end, parameters, layers: Vec::new(), next: Vec::new() }
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

    fn length(&self, bone: usize) -> f64 {
        let [a, b] = self.source.bones[bone].map(|j| self.source.joints[j as usize]);
        a.distance(b)
    }

    /// The cost of pulling back what lies beyond place `from` of a chain; 0 is the joint where it begins.
    fn price(&self, chain: &Chain, from: usize, behind: &[f64]) -> f64 {
        let last = chain.parameters.len();
        let [here, end] = [self.parameter(chain, from), chain.parameters[last - 1]];
        let length = self.length(chain.bone as usize) * (end - here).abs();
        let [once, each] = if chain.end.is_some() { PULL_BONE } else { PULL_LEAF };
        once + each * length + chain.end.map_or(0.0, |j| behind[j as usize])
    }

    /// The parameter of place `k`; 0 is the joint where the chain begins.
    fn parameter(&self, chain: &Chain, k: usize) -> f64 {
        if k > 0 {
            return chain.parameters[k - 1];
        }
        match chain.end {
            Some(end) => f64::from(u8::from(self.source.bones[chain.bone as usize][0] == end)),
            None => chain.parameters[chain.parameters.len() - 1].clamp(0.0, 1.0),
        }
    }

    /// The candidates at the places of a chain.
    fn fill(&self, chain: &mut Chain, count: usize, search: &Search) {
        let [a, b] = self.source.bones[chain.bone as usize].map(|j| self.source.joints[j as usize]);
        let inner = chain.parameters.len() - usize::from(chain.end.is_some());
        let sought = self.sought[chain.bone as usize] && chain.end.is_some();
        let step = self.length(chain.bone as usize) * (chain.parameters[0] - self.parameter(chain, 0)).abs();
        let fill_layer = |&parameter: &f64| {
            let base = self.source.point_at(chain.bone, parameter);
            let (u, v) = (b - a).try_normalize().unwrap_or(DVec3::Z).any_orthonormal_pair();
            let mut layer = self.layer(base, disc(search.radius, search.spacing, count, [u, v]), step, search);
            if sought {
                let section = Section::cut(self.garment, base, b - a);
                let beside: Vec<bool> = layer.offsets.iter().map(|&o| !section.is_around(base + o)).collect();
                if beside.iter().any(|b| !b) {
                    layer.cost.iter_mut().zip(beside).filter(|(_, b)| *b).for_each(|(c, _)| *c += BESIDE * step);
                }
            }
            layer
        };
        chain.layers = chain.parameters[..inner].par_iter().map(fill_layer).collect();
    }

    /// Those of `offsets` that keep clear of the garment.
    fn layer(&self, base: DVec3, offsets: Vec<DVec3>, length: f64, search: &Search) -> Layer {
        let room: Vec<f64> = offsets.par_iter().map(|&o| self.tree.distance(base + o)).collect();
        let mut layer = Layer { base, ..Layer::empty() };
        for (offset, room) in offsets.into_iter().zip(room).filter(|(_, room)| *room >= search.clearance) {
            let wide = offset.length_squared() / (WIDE * WIDE);
            let near = (1.0 - room / NEAR).max(0.0).powi(2);
            layer.offsets.push(offset);
            layer.room.push(room);
            layer.cost.push(length * (wide + TOUCH * near));
        }
        layer
    }

    /// Fills in what follows each candidate of a chain that begins at joint `start`; the least cost from each of that joint.
    fn solve(
        &self,
        chain: &mut Chain,
        joints: &[Layer],
        values: &[Vec<f64>],
        behind: &[f64],
        start: usize,
        search: &Search,
    ) -> Vec<f64> {
        let places = chain.parameters.len();
        let at = |k: usize| match chain.end {
            _ if k == 0 => &joints[start],
            Some(joint) if k == places => &joints[joint as usize],
            _ => &chain.layers[k - 1],
        };
        let mut value = match chain.end {
            Some(joint) => values[joint as usize].clone(),
            None => at(places).cost.clone(),
        };
        let reach = CHANGE * search.spacing;
        let mut next = vec![Vec::new(); places];
        for k in (0..places).rev() {
            let (here, there) = (at(k), at(k + 1));
            let cells = Cells::new(&there.offsets, reach);
            let stride = here.base.distance(there.base).max(search.spacing);
            let pulled = self.price(chain, k, behind);
            let best = |i: usize| {
                let offset = here.offsets[i];
                let mut best = (pulled, PULLED);
                cells.near(offset, |j| {
                    let change = there.offsets[j].distance_squared(offset);
                    let cost = BEND * change / stride + value[j];
                    if change <= reach * reach
                        && cost < best.0
                        && self.is_clear(
                            [here.base + offset, there.base + there.offsets[j]],
                            [here.room[i], there.room[j]],
                            search.clearance,
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

    /// Whether a straight way between two points keeps half the clearance, given the distances of its ends.
    fn is_clear(&self, [a, b]: [DVec3; 2], [room_a, room_b]: [f64; 2], clearance: f64) -> bool {
        let length = a.distance(b);
        if room_a + room_b - length >= clearance {
            return true;
        }
        let kept = 0.5 * clearance;
        let mut way = room_a - kept;
        for _ in 0..STEPS {
            if way >= length - (room_b - kept) {
                return true;
            }
            let room = self.tree.distance(a.lerp(b, way / length));
            if room < clearance {
                return false;
            }
            way += room - kept;
        }
        false
    }

    /// Follows the least cost from the root's candidate `first`.
    fn trace(
        &self,
        root: u32,
        first: usize,
        chains: &[Vec<Chain>],
        joints: &[Layer],
        cut: &[bool],
        search: &Search,
    ) -> Route {
        let bones = self.source.bones.len();
        let mut positions = self.source.joints.clone();
        let mut moved = vec![0.0; positions.len()];
        let mut offsets = vec![0.0_f64; bones];
        let mut pulled = vec![[0.0; 2]; bones];
        let mut ways: Vec<Vec<(f64, DVec3)>> = Vec::new();
        let mut way_bones = Vec::new();
        // A joint with its candidate, or with the point that it is pulled back to.
        let mut stack = vec![(root, Ok(first))];
        while let Some((joint, state)) = stack.pop() {
            let layer = &joints[joint as usize];
            positions[joint as usize] = match state {
                Ok(k) => layer.base + layer.offsets[k],
                Err(point) => point,
            };
            if let Ok(k) = state {
                moved[joint as usize] = layer.offsets[k].length();
            }
            for chain in &chains[joint as usize] {
                let bone = chain.bone as usize;
                let mut way = vec![(self.parameter(chain, 0), positions[joint as usize])];
                let mut at = state;
                for (k, &parameter) in chain.parameters.iter().enumerate() {
                    let last = chain.end.filter(|_| k + 1 == chain.parameters.len());
                    at = match at {
                        Ok(candidate) => match chain.next[k][candidate] {
                            PULLED => Err(way[k].1),
                            following => Ok(following as usize),
                        },
                        pulled => pulled,
                    };
                    let (point, offset) = match at {
                        Ok(c) => {
                            let layer = last.map_or_else(|| &chain.layers[k], |j| &joints[j as usize]);
                            (layer.base + layer.offsets[c], layer.offsets[c].length())
                        }
                        Err(point) => {
                            let part = self.length(bone) * (parameter - way[k].0).abs();
                            pulled[bone][usize::from(chain.end.is_none())] += part;
                            (point, 0.0)
                        }
                    };
                    offsets[bone] = offsets[bone].max(offset);
                    way.push((parameter, point));
                }
                if let Some(end) = chain.end {
                    stack.push((end, at));
                }
                ways.push(way);
                way_bones.push((bone, chain.end.is_some()));
            }
        }
        for (bone, ends) in self.source.bones.iter().enumerate() {
            offsets[bone] = ends.iter().map(|&j| moved[j as usize]).fold(offsets[bone], f64::max);
        }
        let mut knots = vec![Vec::new(); bones];
        for (way, (bone, inner)) in ways.iter().zip(way_bones) {
            if offsets[bone] > 0.0 || pulled[bone] != [0.0; 2] {
                knots[bone].extend(self.knots(way, inner, search));
            }
        }
        Route { wire: Wire::new(self.source, &positions, &knots, cut), offsets, pulled }
    }

    /// As few knots as keep a way clear of the garment and near to what it was; `inner` where it ends at a joint.
    fn knots(&self, way: &[(f64, DVec3)], inner: bool, search: &Search) -> Vec<Knot> {
        let mut knots = Vec::new();
        let last = way.len() - 1;
        let mut from = 0;
        while from < last {
            let straight = |to: usize| {
                let ((s, a), (t, b)) = (way[from], way[to]);
                let near = way[from..to]
                    .iter()
                    .all(|&(r, p)| p.distance(a.lerp(b, (r - s) / (t - s))) <= 0.5 * search.spacing);
                near && self.is_clear([a, b], [a, b].map(|p| self.tree.distance(p)), search.clearance)
            };
            let to = (from + 2..=last).rev().find(|&to| straight(to)).unwrap_or(from + 1);
            if to < last || !inner {
                knots.push(Knot { parameter: way[to].0, position: way[to].1 });
            }
            from = to;
        }
        knots
    }
}

impl Layer {
    fn empty() -> Self {
        Self { base: DVec3::ZERO, offsets: Vec::new(), room: Vec::new(), cost: Vec::new() }
    }
}

/// In how many of three planes the garment is around `p`.
pub fn around(garment: &TriangleMesh, p: DVec3) -> u32 {
    [DVec3::X, DVec3::Y, DVec3::Z].iter().map(|&n| u32::from(Section::cut(garment, p, n).is_around(p))).sum()
}
