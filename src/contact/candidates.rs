//! Broad phase: all the pairs of primitives that may come within a margin of each other during a step.

use std::ops::Range;
use std::sync::atomic::{AtomicUsize, Ordering};

use rayon::prelude::*;

use super::bodies::{Bodies, Configuration, Step};
use super::bvh::{Aabb, Bvh, NodePair};
use super::distance::Kind;
use super::surface::Surface;
use super::tangle::Tangle;
use crate::memory::bytes;

/// Pieces of work for one traversal. Fixed, so that the order of the result does not depend on the threads.
const PIECES: usize = 128;

/// Primitives a thread takes at once when it bounds them.
const CHUNK: usize = 2048;

/// Whom the garment meets in a pair.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Class {
    /// Itself.
    Garment,
    /// The avatar.
    Avatar,
    /// Itself, at triangles that pass through each other from the start (see [`Tangle`]).
    Tangled,
}

/// What the runs of a [`CandidateSet`] hold, in order.
const RUNS: [(Kind, Class); 6] = [
    (Kind::PointTriangle, Class::Garment),
    (Kind::EdgeEdge, Class::Garment),
    (Kind::PointTriangle, Class::Avatar),
    (Kind::EdgeEdge, Class::Avatar),
    (Kind::PointTriangle, Class::Tangled),
    (Kind::EdgeEdge, Class::Tangled),
];

/// Pairs of primitives in the combined numbering of [`Bodies`], sorted into runs by kind and class.
///
/// The four vertices of a pair differ. Of an edge-edge pair with the avatar, the first edge is the garment's.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct CandidateSet {
    pairs: Vec<[u32; 4]>,
    /// Where each run ends in `pairs`.
    ends: [usize; RUNS.len()],
}

/// Pairs of one kind and class.
#[derive(Clone, Debug)]
pub struct Run<'a> {
    /// The kind of all of them.
    pub kind: Kind,
    /// The class of all of them.
    pub class: Class,
    /// Number of the first in the whole set.
    pub first: usize,
    /// The pairs.
    pub pairs: &'a [[u32; 4]],
}

impl CandidateSet {
    /// The set of the given pairs, nothing being tangled.
    pub fn new(
        garment_point_triangle: &[[u32; 4]],
        garment_edge_edge: &[[u32; 4]],
        avatar_point_triangle: &[[u32; 4]],
        avatar_edge_edge: &[[u32; 4]],
    ) -> Self {
        let mut set = Self::default();
        let runs = [garment_point_triangle, garment_edge_edge, avatar_point_triangle, avatar_edge_edge];
        for (run, pairs) in runs.into_iter().enumerate() {
            set.pairs.extend_from_slice(pairs);
            set.ends[run..].fill(set.pairs.len());
        }
        set
    }

    /// Number of pairs.
    #[inline]
    pub fn len(&self) -> usize {
        self.pairs.len()
    }

    /// True without any pair.
    #[inline]
    pub fn is_empty(&self) -> bool {
        self.pairs.is_empty()
    }

    /// Bytes that it holds.
    pub fn memory(&self) -> u64 {
        bytes(&self.pairs)
    }

    /// All pairs, run by run.
    #[inline]
    pub fn pairs(&self) -> &[[u32; 4]] {
        &self.pairs
    }

    /// The pairs of one kind and class.
    pub fn of(&self, kind: Kind, class: Class) -> &[[u32; 4]] {
        self.runs(0..self.len()).find(|r| r.kind == kind && r.class == class).map_or(&[], |r| r.pairs)
    }

    /// The part of each run that lies in `range`, without empty ones.
    pub fn runs(&self, range: Range<usize>) -> impl Iterator<Item = Run<'_>> {
        (0..RUNS.len()).filter_map(move |run| {
            let start = if run == 0 { 0 } else { self.ends[run - 1] };
            let (first, end) = (start.max(range.start), self.ends[run].min(range.end));
            let (kind, class) = RUNS[run];
            (first < end).then(|| Run { kind, class, first, pairs: &self.pairs[first..end] })
        })
    }
}

/// Boxes of the vertices, edges and triangles of one surface during a step, and the tree over the triangles.
#[derive(Default)]
struct SweptSurface {
    vertices: Vec<Aabb>,
    edges: Vec<Aabb>,
    triangles: Vec<Aabb>,
    tree: Bvh,
}

impl SweptSurface {
    fn memory(&self) -> u64 {
        bytes(&self.vertices) + bytes(&self.edges) + bytes(&self.triangles) + self.tree.memory()
    }

    /// Bounds everything, with vertices inside the given boxes.
    fn bound(&mut self, surface: &Surface, vertex: impl Fn(usize) -> Aabb + Sync) {
        fill(&mut self.vertices, surface.vertex_count, vertex);
        let vertices = &self.vertices;
        fill(&mut self.edges, surface.edges.len(), |e| {
            let [a, b] = surface.edges[e].map(|v| vertices[v as usize]);
            a.union(b)
        });
        fill(&mut self.triangles, surface.triangles.len(), |f| {
            let [a, b, c] = surface.triangles[f].map(|v| vertices[v as usize]);
            a.union(b).union(c)
        });
    }
}

/// Replaces the boxes by `count` new ones.
fn fill(boxes: &mut Vec<Aabb>, count: usize, of: impl Fn(usize) -> Aabb + Sync) {
    boxes.resize(count, Aabb::EMPTY);
    boxes.par_chunks_mut(CHUNK).enumerate().for_each(|(chunk, part)| {
        for (k, b) in part.iter_mut().enumerate() {
            *b = of(chunk * CHUNK + k);
        }
    });
}

/// What one piece of a traversal finds, with its scratch.
#[derive(Default)]
struct Piece {
    point_triangle: Vec<[u32; 4]>,
    edge_edge: Vec<[u32; 4]>,
    stack: Vec<NodePair>,
}

/// Finds candidates, again and again: trees and buffers are kept between calls.
pub struct BroadPhase {
    garment: SweptSurface,
    avatar: SweptSurface,
    garment_work: Vec<NodePair>,
    avatar_work: Vec<NodePair>,
    pieces: Vec<Piece>,
    tangle: Tangle,
    most: usize,
}

impl BroadPhase {
    /// Builds the trees, over the rest shapes: the source garment and the fully inflated avatar. Nothing is tangled.
    pub fn new(bodies: &Bodies) -> Self {
        let (mut garment, mut avatar) = (SweptSurface::default(), SweptSurface::default());
        let n = bodies.garment_count();
        let at_rest = |i: usize| Aabb::around(bodies.rest(i as u32), bodies.rest(i as u32));
        garment.bound(&bodies.garment.surface, at_rest);
        garment.tree = Bvh::new(&garment.triangles);
        avatar.bound(&bodies.avatar.surface, |i| at_rest(n + i));
        avatar.tree = Bvh::new(&avatar.triangles);
        Self {
            garment,
            avatar,
            garment_work: Vec::new(),
            avatar_work: Vec::new(),
            pieces: Vec::new(),
            tangle: Tangle::default(),
            most: usize::MAX,
        }
    }

    /// The tangle whose free pairs are left out.
    pub fn tangle(&self) -> &Tangle {
        &self.tangle
    }

    /// Replaces the tangle.
    pub fn set_tangle(&mut self, tangle: Tangle) {
        self.tangle = tangle;
    }

    /// From now on a search ends, incomplete, where it has found about `most` pairs.
    pub fn set_most(&mut self, most: usize) {
        self.most = most;
    }

    /// Whether a search that found these ended before it was complete.
    pub fn is_incomplete(&self, found: &CandidateSet) -> bool {
        found.len() >= self.most
    }

    /// Bytes that it holds.
    pub fn memory(&self) -> u64 {
        let pieces = self.pieces.iter().map(|p| bytes(&p.point_triangle) + bytes(&p.edge_edge) + bytes(&p.stack));
        self.garment.memory() + self.avatar.memory() + pieces.sum::<u64>()
    }

    /// Replaces `out` by all the pairs whose swept boxes, from `at` along the whole of `step`, come within a margin of
    /// each other along every axis: `margin_self` for the garment with itself, `margin_avatar` with the avatar. Pairs
    /// that share a vertex or are free in the tangle are left out. `bodies` is what the broad phase was made for.
    ///
    /// The result, its order included, is the same for any number of threads.
    pub fn candidates(
        &mut self,
        bodies: &Bodies,
        at: Configuration<'_>,
        step: Option<&Step<'_>>,
        margin_self: f64,
        margin_avatar: f64,
        out: &mut CandidateSet,
    ) {
        let n = bodies.garment_count();
        let swept = |i: usize| {
            let x = bodies.position(i as u32, at);
            Aabb::around(x, step.map_or(x, |s| x + bodies.velocity(i as u32, s)))
        };
        self.garment.bound(&bodies.garment.surface, swept);
        self.garment.tree.refit(&self.garment.triangles);
        self.avatar.bound(&bodies.avatar.surface, |i| swept(n + i));
        self.avatar.tree.refit(&self.avatar.triangles);

        let (garment, avatar) = (&self.garment, &self.avatar);
        self.garment_work.clear();
        self.garment_work.extend(garment.tree.roots(&garment.tree));
        garment.tree.spread(None, margin_self, PIECES, &mut self.garment_work);
        self.avatar_work.clear();
        self.avatar_work.extend(garment.tree.roots(&avatar.tree));
        garment.tree.spread(Some(&avatar.tree), margin_avatar, PIECES, &mut self.avatar_work);

        let self_count = self.garment_work.len();
        self.pieces.resize_with(self_count + self.avatar_work.len(), Piece::default);
        let (self_pieces, avatar_pieces) = self.pieces.split_at_mut(self_count);
        let (self_work, avatar_work) = (&self.garment_work, &self.avatar_work);
        let surface = &bodies.garment.surface;
        let room = &Room { found: AtomicUsize::new(0), most: self.most };
        rayon::join(
            || {
                self_pieces.par_iter_mut().zip(self_work).for_each(|(piece, &start)| {
                    let collector =
                        Collector { a: surface, b: surface, a_boxes: garment, b_boxes: garment, offset: 0, room };
                    collector.run::<true>(margin_self, start, piece);
                });
            },
            || {
                avatar_pieces.par_iter_mut().zip(avatar_work).for_each(|(piece, &start)| {
                    let b = &bodies.avatar.surface;
                    let collector =
                        Collector { a: surface, b, a_boxes: garment, b_boxes: avatar, offset: n as u32, room };
                    collector.run::<false>(margin_avatar, start, piece);
                });
            },
        );

        out.pairs.clear();
        let tangle = &self.tangle;
        for (run, (kind, class)) in RUNS.into_iter().enumerate() {
            let pieces = if class == Class::Avatar { &*avatar_pieces } else { &*self_pieces };
            for piece in pieces {
                let found = match kind {
                    Kind::PointTriangle => &piece.point_triangle,
                    Kind::EdgeEdge => &piece.edge_edge,
                };
                if class == Class::Avatar || (class == Class::Garment && tangle.is_empty()) {
                    out.pairs.extend_from_slice(found);
                } else if !tangle.is_empty() {
                    out.pairs.extend(found.iter().filter(|&&pair| tangle.class(kind, pair) == Some(class)));
                }
            }
            out.ends[run] = out.pairs.len();
        }
    }
}

/// Turns close triangles into close primitives. Vertices of `b` are numbered from `offset`.
struct Collector<'a> {
    a: &'a Surface,
    b: &'a Surface,
    a_boxes: &'a SweptSurface,
    b_boxes: &'a SweptSurface,
    offset: u32,
    room: &'a Room,
}

/// Pairs that a search may find, all its pieces together.
struct Room {
    found: AtomicUsize,
    most: usize,
}

impl Room {
    /// Pairs after which a piece says how many it has.
    const STRIDE: usize = 1024;

    /// Counts what a piece has found that had `before` pairs and has `after`.
    #[inline]
    fn count(&self, before: usize, after: usize) {
        let strides = after / Self::STRIDE - before / Self::STRIDE;
        if strides > 0 {
            self.found.fetch_add(strides * Self::STRIDE, Ordering::Relaxed);
        }
    }

    #[inline]
    fn is_full(&self) -> bool {
        self.found.load(Ordering::Relaxed) >= self.most
    }
}

impl Collector<'_> {
    /// Fills `piece` with the pairs below `start`. `SAME` if both surfaces are one.
    fn run<const SAME: bool>(&self, margin: f64, start: NodePair, piece: &mut Piece) {
        let Piece { point_triangle, edge_edge, stack } = piece;
        point_triangle.clear();
        edge_edge.clear();
        let (a, b, offset) = (self.a, self.b, self.offset);
        let (a_boxes, b_boxes) = (self.a_boxes, self.b_boxes);
        let other = if SAME { None } else { Some(&b_boxes.tree) };
        a_boxes.tree.traverse(other, margin, start, stack, |s, t| {
            let s_box = a_boxes.triangles[s as usize].inflated(margin);
            let t_box = b_boxes.triangles[t as usize].inflated(margin);
            if !s_box.overlaps(&b_boxes.triangles[t as usize]) || self.room.is_full() {
                return;
            }
            let before = point_triangle.len() + edge_edge.len();
            let (s_corners, t_corners) = (a.triangles[s as usize], b.triangles[t as usize]);
            if b.has_face(t) {
                for v in a.owned_vertices(s) {
                    if t_box.overlaps(&a_boxes.vertices[v as usize]) && !(SAME && t_corners.contains(&v)) {
                        let [i, j, k] = t_corners.map(|c| c + offset);
                        point_triangle.push([v, i, j, k]);
                    }
                }
            }
            if a.has_face(s) {
                for v in b.owned_vertices(t) {
                    if s_box.overlaps(&b_boxes.vertices[v as usize]) && !(SAME && s_corners.contains(&v)) {
                        let [i, j, k] = s_corners;
                        point_triangle.push([v + offset, i, j, k]);
                    }
                }
            }
            for e in a.owned_edges(s) {
                let e_box = a_boxes.edges[e as usize].inflated(margin);
                if !e_box.overlaps(&b_boxes.triangles[t as usize]) {
                    continue;
                }
                let [i, j] = a.edges[e as usize];
                for f in b.owned_edges(t) {
                    let [k, l] = b.edges[f as usize];
                    let incident = SAME && (i == k || i == l || j == k || j == l);
                    if !incident && e_box.overlaps(&b_boxes.edges[f as usize]) {
                        edge_edge.push([i, j, k + offset, l + offset]);
                    }
                }
            }
            self.room.count(before, point_triangle.len() + edge_edge.len());
        });
    }
}
