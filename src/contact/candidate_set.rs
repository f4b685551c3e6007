//! Candidate pairs: primitives that may come close, sorted by pair type and collision group.

use std::ops::Range;

use rayon::prelude::*;

use super::bodies::Motion;
use super::distance::PairType;
use crate::memory::bytes;

/// Pairs that a thread filters at once.
const FILTER_CHUNK: usize = 1024;

/// A list with room for more pairs (some 16 MB) is given back where few of them are kept.
const MUCH: usize = 1 << 20;

/// More than rounding can add to the gap between two projections.
pub(super) const ROUNDING: f64 = 1e-12;

/// Which collision group a pair belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CollisionGroup {
    /// The garment with itself.
    Garment,
    /// The garment with the avatar.
    Avatar,
    /// The garment with itself, at triangles that intersect from the start (see [`ExemptPairs`](super::ExemptPairs)).
    /// The exempt pairs themselves are no candidates.
    Intersecting,
}

/// What the ranges of a [`CandidateSet`] hold, in order.
const RANGES: [(PairType, CollisionGroup); 6] = [
    (PairType::PointTriangle, CollisionGroup::Garment),
    (PairType::EdgeEdge, CollisionGroup::Garment),
    (PairType::PointTriangle, CollisionGroup::Avatar),
    (PairType::EdgeEdge, CollisionGroup::Avatar),
    (PairType::PointTriangle, CollisionGroup::Intersecting),
    (PairType::EdgeEdge, CollisionGroup::Intersecting),
];

/// Pairs of primitives in the combined numbering of [`Bodies`](super::Bodies), sorted into ranges by type
/// and group.
///
/// The four vertices of a pair differ. Of an edge-edge pair with the avatar, the first edge is the garment's.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct CandidateSet {
    pairs: Vec<[u32; 4]>,
    /// Where each range ends in `pairs`.
    ends: [usize; RANGES.len()],
}

/// A contiguous range of pairs of one type and group.
#[derive(Clone, Debug)]
pub struct PairRange<'a> {
    /// The type of all of them.
    pub pair_type: PairType,
    /// The group of all of them.
    pub group: CollisionGroup,
    /// Number of the first in the whole set.
    pub first: usize,
    /// The pairs.
    pub pairs: &'a [[u32; 4]],
}

impl CandidateSet {
    /// The set of the given pairs, without any in [`CollisionGroup::Intersecting`].
    pub fn new(
        garment_point_triangle: &[[u32; 4]],
        garment_edge_edge: &[[u32; 4]],
        avatar_point_triangle: &[[u32; 4]],
        avatar_edge_edge: &[[u32; 4]],
    ) -> Self {
        let mut set = Self::default();
        let ranges = [garment_point_triangle, garment_edge_edge, avatar_point_triangle, avatar_edge_edge];
        for (k, pairs) in ranges.into_iter().enumerate() {
            set.pairs.extend_from_slice(pairs);
            set.ends[k..].fill(set.pairs.len());
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

    /// All pairs, range by range.
    #[inline]
    pub fn pairs(&self) -> &[[u32; 4]] {
        &self.pairs
    }

    /// The pairs of one type and group.
    pub fn of(&self, pair_type: PairType, group: CollisionGroup) -> &[[u32; 4]] {
        self.ranges(0..self.len()).find(|r| r.pair_type == pair_type && r.group == group).map_or(&[], |r| r.pairs)
    }

    /// Keeps, in order, the pairs that may come within the `margin` of their group during the first `part` of `motion`.
    pub fn retain_near(&mut self, motion: &Motion, part: f64, margin: impl Fn(CollisionGroup) -> f64 + Sync) {
        let mut kept = Vec::new();
        let mut ends = [0; RANGES.len()];
        for (k, (pair_type, group)) in RANGES.into_iter().enumerate() {
            let margin = margin(group) + ROUNDING;
            let near = |pair: &&[u32; 4]| !stays_apart(pair_type, **pair, motion, part, margin);
            let chunks = self.of(pair_type, group).par_chunks(FILTER_CHUNK);
            let parts: Vec<Vec<[u32; 4]>> = chunks.map(|c| c.iter().filter(near).copied().collect()).collect();
            parts.iter().for_each(|part| kept.extend_from_slice(part));
            ends[k] = kept.len();
        }
        self.ends = ends;
        if self.pairs.capacity() > MUCH && self.pairs.capacity() / 4 > kept.len() {
            self.pairs = kept;
            return;
        }
        // Copied, so that the buffer keeps its capacity for the next search.
        self.pairs.clear();
        self.pairs.extend_from_slice(&kept);
    }

    /// Replaces all pairs, by `most` at most: `add` is called for each range in order, with the list that its pairs are to be
    /// appended to.
    pub(super) fn refill(&mut self, most: usize, mut add: impl FnMut(PairType, CollisionGroup, &mut Vec<[u32; 4]>)) {
        self.pairs.clear();
        self.pairs.reserve_exact(most);
        for (k, (pair_type, group)) in RANGES.into_iter().enumerate() {
            add(pair_type, group, &mut self.pairs);
            self.ends[k] = self.pairs.len();
        }
    }

    /// The part of each of them that lies in `range`, without empty ones.
    pub fn ranges(&self, range: Range<usize>) -> impl Iterator<Item = PairRange<'_>> {
        (0..RANGES.len()).filter_map(move |k| {
            let start = if k == 0 { 0 } else { self.ends[k - 1] };
            let (first, end) = (start.max(range.start), self.ends[k].min(range.end));
            let (pair_type, group) = RANGES[k];
            (first < end).then(|| PairRange { pair_type, group, first, pairs: &self.pairs[first..end] })
        })
    }
}

/// Separating-plane test: true only where a pair stays further apart than `gap`, on either side of planes across its first
/// separation.
#[inline]
fn stays_apart(pair_type: PairType, pair: [u32; 4], motion: &Motion, part: f64, gap: f64) -> bool {
    let (x, v) = (motion.positions(pair), motion.displacements(pair));
    let separation = pair_type.separation(&x);
    if separation.squared <= gap * gap {
        return false;
    }
    // Between the planes at the beginning there is all of the distance. The gap between the intervals on n is the smallest
    // of several differences, each linear in time: where it is wide enough at the end, too, it always is.
    let n = separation.vector / separation.squared.sqrt();
    let interval = |i: usize| n.dot(x[i] - x[1] + part * v[i]);
    let intervals = [interval(0), interval(1), interval(2), interval(3)];
    let (first, second) = intervals.split_at(pair_type.first_count());
    let lowest = first.iter().copied().fold(f64::INFINITY, f64::min);
    let highest = second.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    lowest - highest > gap
}
