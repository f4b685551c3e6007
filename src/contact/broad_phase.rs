//! Broad phase: all the pairs of primitives that may come within a margin of each other during a step.

use std::sync::atomic::{AtomicUsize, Ordering};

use glam::DVec3;
use rayon::prelude::*;

use super::bodies::{Bodies, Motion};
use super::candidate_set::{CandidateSet, CollisionGroup, ROUNDING};
use super::distance::PairType;
use super::exempt_pairs::ExemptPairs;
use super::one_ring::OneRingPairs;
use super::surface::Surface;
use super::swept::{Plane, SweptSurface, interval};
use crate::geometry::bvh::{Aabb, NodePair};
use crate::memory::bytes;

/// Tasks that one traversal is split into. Fixed, so that the order of the result does not depend on the threads.
const TASKS: usize = 128;

/// One-ring pairs that a task tests.
const CHUNK: usize = 2048;

/// A list of more pairs than this is given back once it was merged: those of a long step are many times those of the next.
const KEPT: usize = 1 << 12;

/// What one task of a traversal finds, with its scratch.
#[derive(Default)]
struct Task {
    point_triangle: Vec<[u32; 4]>,
    edge_edge: Vec<[u32; 4]>,
    stack: Vec<NodePair>,
}

/// Finds candidate pairs. Trees and buffers are kept between calls.
pub struct BroadPhase {
    garment: SweptSurface,
    avatar: SweptSurface,
    one_ring: OneRingPairs,
    /// The motion that the avatar's boxes bound: t, its change, and the margin.
    avatar_at: Option<[f64; 3]>,
    garment_work: Vec<NodePair>,
    avatar_work: Vec<NodePair>,
    tasks: Vec<Task>,
    exempt: ExemptPairs,
    max_pairs: usize,
    /// The last search ended before it was complete.
    is_incomplete: bool,
}

impl BroadPhase {
    /// Builds the trees, over the rest shapes: the source garment and the fully inflated avatar. No pair is
    /// exempt.
    pub fn new(bodies: &Bodies) -> Self {
        let n = bodies.garment_count();
        let surface =
            |surface: &Surface, offset: usize| SweptSurface::new(surface, |i| bodies.rest((i + offset) as u32));
        Self {
            garment: surface(&bodies.garment.surface, 0),
            avatar: surface(&bodies.avatar.surface, n),
            one_ring: OneRingPairs::new(&bodies.garment.surface),
            avatar_at: None,
            garment_work: Vec::new(),
            avatar_work: Vec::new(),
            tasks: Vec::new(),
            exempt: ExemptPairs::default(),
            max_pairs: usize::MAX,
            is_incomplete: false,
        }
    }

    /// The initial self-intersections whose exempt pairs are left out.
    pub fn exempt_pairs(&self) -> &ExemptPairs {
        &self.exempt
    }

    /// Replaces the exempt pairs.
    pub fn set_exempt_pairs(&mut self, exempt: ExemptPairs) {
        self.exempt = exempt;
    }

    /// Limits a search to about `most` pairs: it ends there, incomplete.
    pub fn set_most(&mut self, most: usize) {
        self.max_pairs = most;
    }

    /// Whether the last search ended before it was complete.
    pub fn is_incomplete(&self) -> bool {
        self.is_incomplete
    }

    /// Bytes that it holds.
    pub fn memory(&self) -> u64 {
        let tasks = self.tasks.iter().map(|p| bytes(&p.point_triangle) + bytes(&p.edge_edge) + bytes(&p.stack));
        self.garment.memory() + self.avatar.memory() + self.one_ring.memory() + tasks.sum::<u64>()
    }

    /// Replaces `out` by all the pairs that come within a margin of each other during the first `part` of `motion`, and
    /// some that do not: `margin_self` for the garment with itself, `margin_avatar` with the avatar. Pairs that share a
    /// vertex and exempt pairs are left out. `bodies` is what the broad phase was made for.
    ///
    /// The result, its order included, is the same for any number of threads.
    pub fn candidates(
        &mut self,
        bodies: &Bodies,
        motion: &Motion,
        part: f64,
        margin_self: f64,
        margin_avatar: f64,
        out: &mut CandidateSet,
    ) {
        self.refit(bodies, motion, part, margin_self, margin_avatar);
        self.divide();
        let found = self.search(bodies, margin_self, margin_avatar);
        self.merge(found, out);
        self.is_incomplete = out.len() >= self.max_pairs;
    }

    /// Refits the boxes to the motion. They include the margins, half of each on either side.
    fn refit(&mut self, bodies: &Bodies, motion: &Motion, part: f64, margin_self: f64, margin_avatar: f64) {
        let own = 0.5 * margin_self;
        self.garment.refit(&bodies.garment.surface, motion, 0, part, own);
        let [t, dt] = motion.inflation();
        let avatar_at = Some([t, part * dt, margin_avatar - own]);
        if self.avatar_at != avatar_at {
            let first = bodies.garment_count() as u32;
            self.avatar.refit(&bodies.avatar.surface, motion, first, part, margin_avatar - own);
            self.avatar_at = avatar_at;
        }
    }

    /// Divides both traversals into subtrees.
    fn divide(&mut self) {
        let (garment, avatar) = (&self.garment, &self.avatar);
        self.garment_work.clear();
        self.garment_work.extend(garment.tree.roots(&garment.tree));
        garment.tree.subdivide(None, TASKS, &mut self.garment_work);
        self.avatar_work.clear();
        self.avatar_work.extend(garment.tree.roots(&avatar.tree));
        garment.tree.subdivide(Some(&avatar.tree), TASKS, &mut self.avatar_work);
    }

    /// Runs the tasks. Returns how many of them, from the first on, are of the garment with itself.
    fn search(&mut self, bodies: &Bodies, margin_self: f64, margin_avatar: f64) -> usize {
        let near = &self.one_ring;
        let near_count = near.point_triangle.len().max(near.edge_edge.len()).div_ceil(CHUNK);
        let self_count = near_count + self.garment_work.len();
        self.tasks.resize_with(self_count + self.avatar_work.len(), Task::default);
        let (self_tasks, avatar_tasks) = self.tasks.split_at_mut(self_count);
        let (near_tasks, tree_tasks) = self_tasks.split_at_mut(near_count);
        let (self_work, avatar_work) = (&self.garment_work, &self.avatar_work);
        let budget = &PairBudget { found: AtomicUsize::new(0), max_pairs: self.max_pairs };
        let own = Operand { surface: &bodies.garment.surface, swept: &self.garment, offset: 0 };
        let offset = bodies.garment_count() as u32;
        let theirs = Operand { surface: &bodies.avatar.surface, swept: &self.avatar, offset };
        let search = Collector { a: own, b: own, one_ring: near, margin: margin_self, budget };
        let avatar_search = Collector { b: theirs, margin: margin_avatar, ..search };
        rayon::join(
            || {
                near_tasks.par_iter_mut().enumerate().for_each(|(chunk, task)| search.test_one_ring(chunk, task));
                let work = tree_tasks.par_iter_mut().zip(self_work);
                work.for_each(|(task, &start)| search.run::<true>(start, task));
            },
            || {
                let work = avatar_tasks.par_iter_mut().zip(avatar_work);
                work.for_each(|(task, &start)| avatar_search.run::<false>(start, task));
            },
        );
        self_count
    }

    /// Concatenates what the tasks found, in their order; the first `self_count` are of the garment with itself.
    fn merge(&mut self, self_count: usize, out: &mut CandidateSet) {
        let count = self.tasks.iter().map(|task| task.point_triangle.len() + task.edge_edge.len()).sum();
        let (self_tasks, avatar_tasks) = self.tasks.split_at_mut(self_count);
        let exempt = &self.exempt;
        out.refill(count, |pair_type, group, pairs| {
            for task in if group == CollisionGroup::Avatar { &mut *avatar_tasks } else { &mut *self_tasks } {
                let found = match pair_type {
                    PairType::PointTriangle => &mut task.point_triangle,
                    PairType::EdgeEdge => &mut task.edge_edge,
                };
                if group == CollisionGroup::Avatar || (group == CollisionGroup::Garment && exempt.is_empty()) {
                    pairs.extend_from_slice(found);
                    if found.len() > KEPT {
                        *found = Vec::new();
                    }
                } else if !exempt.is_empty() {
                    pairs.extend(found.iter().filter(|&&pair| exempt.group(pair_type, pair) == Some(group)));
                }
            }
        });
    }
}

/// One of the two surfaces of a search. Its vertices are numbered from `offset`.
#[derive(Clone, Copy)]
struct Operand<'a> {
    surface: &'a Surface,
    swept: &'a SweptSurface,
    offset: u32,
}

/// Collects the close primitives of close triangles.
#[derive(Clone, Copy)]
struct Collector<'a> {
    a: Operand<'a>,
    b: Operand<'a>,
    one_ring: &'a OneRingPairs,
    margin: f64,
    budget: &'a PairBudget,
}

/// How many pairs all the tasks of a search may find together.
struct PairBudget {
    found: AtomicUsize,
    max_pairs: usize,
}

impl PairBudget {
    /// Pairs after which a task updates the common count.
    const STRIDE: usize = 1024;

    /// Counts the pairs of a task that had `before` and has `after`.
    #[inline]
    fn count(&self, before: usize, after: usize) {
        let strides = after / Self::STRIDE - before / Self::STRIDE;
        if strides > 0 {
            self.found.fetch_add(strides * Self::STRIDE, Ordering::Relaxed);
        }
    }

    #[inline]
    fn is_full(&self) -> bool {
        self.found.load(Ordering::Relaxed) >= self.max_pairs
    }
}

impl Collector<'_> {
    /// Fills `task` with the pairs below `start`. `SAME` if both surfaces are one.
    fn run<const SAME: bool>(&self, start: NodePair, task: &mut Task) {
        let Task { point_triangle, edge_edge, stack } = task;
        point_triangle.clear();
        edge_edge.clear();
        let (a, b) = (self.a, self.b);
        let other = if SAME { None } else { Some(&b.swept.tree) };
        a.swept.tree.traverse(other, start, stack, |s, t| {
            let (s_corners, t_corners) = (a.surface.triangles[s as usize], b.surface.triangles[t as usize]);
            if SAME && self.one_ring.has(s_corners, t_corners) {
                return;
            }
            if self.has_separating_plane(s, s_corners, t, t_corners) || self.budget.is_full() {
                return;
            }
            let before = point_triangle.len() + edge_edge.len();
            let (s_owns, t_owns) = (a.surface.ownership(s), b.surface.ownership(t));
            let (s_boxes, t_boxes) = (a.boxes(s_corners), b.boxes(t_corners));
            let (s_box, t_box) = (around(s_boxes), around(t_boxes));
            let [i, j, k] = s_corners.map(|v| v + a.offset);
            let [l, m, n] = t_corners.map(|v| v + b.offset);
            for c in 0..3 {
                let v = [i, j, k][c];
                if s_owns.corner(c) && t_owns.face() && s_boxes[c].overlaps(&t_box) && ![l, m, n].contains(&v) {
                    point_triangle.push([v, l, m, n]);
                }
                let v = [l, m, n][c];
                if t_owns.corner(c) && s_owns.face() && t_boxes[c].overlaps(&s_box) && ![i, j, k].contains(&v) {
                    point_triangle.push([v, i, j, k]);
                }
            }
            let (s_edges, t_edges) = (edges([i, j, k]), edges([l, m, n]));
            let (s_edge_boxes, t_edge_boxes) = (edge_boxes(s_boxes), edge_boxes(t_boxes));
            for (c, e_box) in s_edge_boxes.iter().enumerate() {
                if !s_owns.side(c) || !e_box.overlaps(&t_box) {
                    continue;
                }
                let [p, q] = s_edges[c];
                for (d, f_box) in t_edge_boxes.iter().enumerate() {
                    let [r, s] = t_edges[d];
                    let incident = SAME && (p == r || p == s || q == r || q == s);
                    if t_owns.side(d) && !incident && e_box.overlaps(f_box) {
                        edge_edge.push([p, q, r, s]);
                    }
                }
            }
            self.budget.count(before, point_triangle.len() + edge_edge.len());
        });
    }

    /// Fills `task` with the close ones of a chunk of the one-ring pairs.
    fn test_one_ring(&self, chunk: usize, task: &mut Task) {
        let Task { point_triangle, edge_edge, .. } = task;
        point_triangle.clear();
        edge_edge.clear();
        if self.budget.is_full() {
            return;
        }
        let boxes = &self.a.swept.vertices;
        let edge = |a: u32, b: u32| boxes[a as usize].union(boxes[b as usize]);
        point_triangle.extend(
            part_of(&self.one_ring.point_triangle, chunk)
                .iter()
                .filter(|&&[v, i, j, k]| boxes[v as usize].overlaps(&edge(i, j).union(boxes[k as usize]))),
        );
        edge_edge.extend(
            part_of(&self.one_ring.edge_edge, chunk).iter().filter(|&&[i, j, k, l]| edge(i, j).overlaps(&edge(k, l))),
        );
        self.budget.count(0, point_triangle.len() + edge_edge.len());
    }

    /// Separating-plane test: true only where the triangles `s` and `t` stay further apart than the margin, on either side
    /// of the plane of one of them.
    #[inline]
    fn has_separating_plane(&self, s: u32, s_corners: [u32; 3], t: u32, t_corners: [u32; 3]) -> bool {
        let (s_plane, t_plane) = (&self.a.swept.planes[s as usize], &self.b.swept.planes[t as usize]);
        self.stays_beside(s_plane, &self.b.swept.positions, t_corners)
            || self.stays_beside(t_plane, &self.a.swept.positions, s_corners)
    }

    /// Whether three points stay on one side of a triangle's plane, by more than the margin.
    #[inline]
    fn stays_beside(&self, plane: &Plane, positions: &[[DVec3; 2]], [a, b, c]: [u32; 3]) -> bool {
        let margin = self.margin + ROUNDING;
        let [low, high] = plane.interval;
        let points = [a, b, c].map(|v| &positions[v as usize]);
        let at = |end: usize| interval(plane.normal, points[0][end], points[1][end], points[2][end]);
        let start = at(0);
        let above = start[0] - high[0] > margin;
        if !above && low[0] - start[1] <= margin {
            return false;
        }
        // The gap is the smallest of several differences, each linear in time: where it is above the margin at both
        // ends, it is in between.
        let end = at(1);
        if above { end[0] - high[1] > margin } else { low[1] - end[1] > margin }
    }
}

impl Operand<'_> {
    /// The boxes of a triangle's corners.
    #[inline]
    fn boxes(&self, [a, b, c]: [u32; 3]) -> [Aabb; 3] {
        let boxes = &self.swept.vertices;
        [boxes[a as usize], boxes[b as usize], boxes[c as usize]]
    }
}

/// A chunk of a list, empty beyond its end.
fn part_of<T>(list: &[T], chunk: usize) -> &[T] {
    &list[(chunk * CHUNK).min(list.len())..((chunk + 1) * CHUNK).min(list.len())]
}

/// The box around three boxes.
#[inline]
fn around([a, b, c]: [Aabb; 3]) -> Aabb {
    a.union(b).union(c)
}

/// The boxes of a triangle's sides from those of its corners.
#[inline]
fn edge_boxes([a, b, c]: [Aabb; 3]) -> [Aabb; 3] {
    [a.union(b), b.union(c), c.union(a)]
}

/// The sides of a triangle, smaller index first.
#[inline]
fn edges([a, b, c]: [u32; 3]) -> [[u32; 2]; 3] {
    let side = |a: u32, b: u32| [a.min(b), a.max(b)];
    [side(a, b), side(b, c), side(c, a)]
}
