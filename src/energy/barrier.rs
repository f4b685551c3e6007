//! Contact (Eq. 1 of the paper): IPC's barrier on squared distances (Li et al. 2020), above a minimum separation.
//!
//! With `D = d^2 - min_separation^2` and `Dhat = dhat^2 - min_separation^2`, a pair at distance d costs
//! `b = -(D - Dhat)^2 ln(D / Dhat)` for `0 < D < Dhat`, nothing beyond, and infinity at the minimum
//! separation (the thickness offset of Codimensional IPC, Li et al. 2021). Edge-edge pairs are weighed by the mollifier
//! m. Along `a = grad d` (`a_i = w_i r / d`) the derivatives of a pair are `g = m db/dd` and `h = m max(0, d2b/dd2)`,
//! and the mollifier adds `b grad m` to the gradient.
//!
//! Two parts of the garment that are nearer to each other at rest than its d-hat are to stay so: a lining, or the two faces of a
//! cloth that has a thickness. The d-hat of such a pair is a share of its distance at rest, and its weight grows as that shrinks, so
//! that it pushes as hard at the same fraction of its own d-hat. Both are constants of the pair, so the barrier is as smooth.
//!
//! The Hessian is `h a a^T`: it leaves out how the distance curves (`contact/curvature.rs`). On request it has the half of
//! that which closes gaps, `-g q q^T / 2`. The other half would take its definiteness, and with one half alone the garment is
//! too stiff to slide: it converges more slowly where contact does not make the steps short.

use std::collections::HashSet;
use std::ops::Range;
use std::sync::Arc;

use glam::DVec3;
use rayon::prelude::*;

use super::{Configuration, Direction, Energy, Sink};
use crate::contact::distance::Separation;
use crate::contact::exempt_pairs::canonical;
use crate::contact::{Bodies, CandidateSet, CollisionGroup, PairType, curvature, mollifier};
use crate::maths;

/// Candidates in one task.
const CHUNK: usize = 2048;

/// d-hat of pairs in [`CollisionGroup::Intersecting`], as a share of the garment's. Where the surface passes through itself
/// distances are too small for more. These pairs weigh more, as those of the garment do beside the avatar's: see
/// [`BarrierSettings::self_weight`].
const INTERSECTING_SHARE: f64 = 1.0 / 16.0;

/// d-hat of a pair in minimum separations, at least: the barrier needs a range above it.
const LEAST_DHAT: f64 = 4.0;

/// The shape of the barrier. Lengths are in the normalised space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BarrierSettings {
    /// Distance below which the garment repels itself. Above `min_separation`.
    pub dhat_self: f64,
    /// Distance below which the avatar repels the garment. Above `min_separation`.
    pub dhat_avatar: f64,
    /// Distance that no pair may reach.
    pub min_separation: f64,
    /// The same for pairs in [`CollisionGroup::Intersecting`].
    pub min_separation_intersecting: f64,
    /// Factor on the pairs with the avatar.
    pub avatar_weight: f64,
    /// d-hat of a pair of the garment with itself as a share of its distance at rest, at most; infinite for none.
    pub rest_share: f64,
}

/// How the barrier changes along a continuation path in its parameter s: logarithmic rates per unit of s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BarrierPathRates {
    /// Rate of `dhat_avatar`.
    pub dhat_avatar: f64,
    /// Rate of the weight by which the whole term is multiplied.
    pub weight: f64,
}

impl Default for BarrierSettings {
    fn default() -> Self {
        Self {
            dhat_self: 0.002,
            dhat_avatar: 0.002,
            min_separation: 1e-5,
            min_separation_intersecting: 1e-5,
            avatar_weight: 1.0,
            rest_share: f64::INFINITY,
        }
    }
}

impl BarrierSettings {
    /// Distance below which a group repels, at most.
    #[inline]
    pub fn dhat(&self, group: CollisionGroup) -> f64 {
        match group {
            CollisionGroup::Garment => self.dhat_self,
            CollisionGroup::Avatar => self.dhat_avatar,
            CollisionGroup::Intersecting => INTERSECTING_SHARE * self.dhat_self,
        }
    }

    /// Distance that no pair of a group may reach.
    #[inline]
    pub fn min_separation(&self, group: CollisionGroup) -> f64 {
        match group {
            CollisionGroup::Garment | CollisionGroup::Avatar => self.min_separation,
            CollisionGroup::Intersecting => self.min_separation_intersecting,
        }
    }

    /// Factor on the pairs of the garment with itself. While the avatar grows, d-hat is wider towards it; the force at a given
    /// fraction of d-hat grows with the cube of d-hat, and layers that repel each other so much less than the avatar pushes
    /// them would be pressed together to the minimum separation, where every step is short.
    #[inline]
    fn self_weight(&self) -> f64 {
        (self.dhat_avatar / self.dhat_self).max(1.0).powi(3)
    }

    #[inline]
    fn weight(&self, group: CollisionGroup) -> f64 {
        match group {
            CollisionGroup::Garment => self.self_weight(),
            CollisionGroup::Avatar => self.avatar_weight,
            CollisionGroup::Intersecting => self.self_weight() * INTERSECTING_SHARE.powi(-3),
        }
    }
}

/// Number of close pairs and the smallest distances at a configuration. Close are pairs below the d-hat of their group.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Activity {
    /// Number of pairs closer than their d-hat.
    pub count: usize,
    /// Smallest distance of the garment from itself without [`CollisionGroup::Intersecting`], infinite if none is below
    /// d-hat.
    pub min_distance_self: f64,
    /// Smallest distance of the garment from the avatar, infinite if none is below d-hat.
    pub min_distance_avatar: f64,
    /// Smallest distance of a pair in [`CollisionGroup::Intersecting`], infinite if none is below its d-hat.
    pub min_distance_intersecting: f64,
}

/// The contact term: the barrier summed over a set of candidates.
///
/// Its elements are the candidates.
#[derive(Clone, Debug)]
pub struct Barrier {
    bodies: Arc<Bodies>,
    candidates: CandidateSet,
    settings: BarrierSettings,
    path: Option<BarrierPathRates>,
    is_curved: bool,
    /// Vertices whose distances at rest say nothing; empty for none.
    intersects_at_rest: Vec<bool>,
    /// Pairs that touch at rest, as [`canonical`] has them: their distances there say nothing either.
    touching_at_rest: HashSet<[u32; 4]>,
}

impl Barrier {
    /// A barrier without candidates.
    pub fn new(bodies: Arc<Bodies>, settings: BarrierSettings) -> Self {
        Self {
            bodies,
            candidates: CandidateSet::default(),
            settings,
            path: None,
            is_curved: false,
            intersects_at_rest: Vec::new(),
            touching_at_rest: HashSet::new(),
        }
    }

    /// The bodies in contact.
    pub fn bodies(&self) -> &Arc<Bodies> {
        &self.bodies
    }

    /// The pairs that are summed over.
    pub fn candidates(&self) -> &CandidateSet {
        &self.candidates
    }

    /// The pairs, for the broad phase to replace.
    pub fn candidates_mut(&mut self) -> &mut CandidateSet {
        &mut self.candidates
    }

    /// The shape of the barrier.
    pub fn settings(&self) -> &BarrierSettings {
        &self.settings
    }

    /// Changes the shape of the barrier. The candidates must hold all pairs that are within the new d-hat.
    pub fn set_settings(&mut self, settings: BarrierSettings) {
        self.settings = settings;
    }

    /// Chooses the parameter of the bordered Hessian: with rates it is s, and the border holds the mixed derivatives by the
    /// vertices and s, while t must be constant; with `None` it is t.
    pub fn set_barrier_path(&mut self, path: Option<BarrierPathRates>) {
        self.path = path;
    }

    /// Marks garment vertices where the rest shape passes through itself. Pairs of such vertices alone have the d-hat of their
    /// group, whatever their distance at rest.
    pub fn set_intersecting_at_rest(&mut self, intersects_at_rest: Vec<bool>) {
        self.intersects_at_rest = intersects_at_rest;
    }

    /// Marks pairs of the garment with itself that touch at rest, as [`canonical`] has them. They have the d-hat of their group:
    /// a share of no distance would leave them where any step that slides or turns them is cut to nothing.
    pub fn set_touching_at_rest(&mut self, touching_at_rest: HashSet<[u32; 4]>) {
        self.touching_at_rest = touching_at_rest;
    }

    /// d-hat of a pair.
    #[inline]
    fn dhat(&self, close: &ClosePair) -> f64 {
        let dhat = self.settings.dhat(close.group);
        let intersects_at_rest = |&v: &u32| self.intersects_at_rest.get(v as usize).is_some_and(|&is| is);
        if close.group != CollisionGroup::Garment
            || self.settings.rest_share.is_infinite()
            || close.pair.iter().all(intersects_at_rest)
        {
            return dhat;
        }
        if !self.touching_at_rest.is_empty() && self.touching_at_rest.contains(&canonical(close.pair_type, close.pair))
        {
            return dhat;
        }
        let at_rest = close.pair_type.separation(&close.pair.map(|i| self.bodies.rest(i))).squared.sqrt();
        (self.settings.rest_share * at_rest).max(LEAST_DHAT * self.settings.min_separation).min(dhat)
    }

    /// The weight of a pair with this d-hat: see [`BarrierSettings::self_weight`].
    #[inline]
    fn weight(&self, group: CollisionGroup, dhat: f64) -> f64 {
        self.settings.weight(group) * (self.settings.dhat(group) / dhat).powi(3)
    }

    /// Whether the Hessian is to have how the distances curve, where that closes gaps.
    pub fn set_curved(&mut self, is_curved: bool) {
        self.is_curved = is_curved;
    }

    /// The tangent of the path at a pair, its component of the border over its stiffness h: the negated rate of its distance
    /// along s at constant force. With f = db/dd,
    /// `-dd/ds = (df/ds + f dln w/ds) / (df/dd)`.
    #[inline]
    fn path_tangent(
        &self,
        group: CollisionGroup,
        big_d: f64,
        dhat: f64,
        min_separation: f64,
        [d, g, h]: [f64; 3],
    ) -> f64 {
        let Some(rates) = self.path else { return 0.0 };
        if h <= 0.0 {
            return 0.0;
        }
        let (by_dhat, own) = match group {
            CollisionGroup::Avatar => (rates.dhat_avatar, 0.0),
            // As `self_weight` follows.
            _ if self.settings.dhat_avatar > self.settings.dhat_self => (0.0, 3.0 * rates.dhat_avatar),
            _ => (0.0, 0.0),
        };
        let big_dhat = dhat * dhat - min_separation;
        let (q, ln) = ((big_d - big_dhat) / big_d, maths::ln(big_d / big_dhat));
        let slope = 2.0 * (ln + q + (big_d - big_dhat) / big_dhat);
        let by_s = 2.0 * d * self.settings.weight(group) * slope * 2.0 * dhat * dhat * by_dhat;
        (by_s + g * (rates.weight + own)) / h
    }

    /// Number of close pairs and the smallest distances at `at`.
    pub fn activity(&self, at: Configuration<'_>) -> Activity {
        let parts: Vec<Activity> = self.map_chunks(|range| self.activity_in(at, range));
        parts.iter().fold(Activity::NONE, Activity::merged)
    }

    /// The candidates that are closer than `distance` (at most d-hat) at `at`, in order.
    pub fn nearer_than(&self, distance: f64, at: Configuration<'_>) -> Vec<(PairType, CollisionGroup, [u32; 4])> {
        let parts: Vec<Vec<_>> = self.map_chunks(|range| {
            let mut found = Vec::new();
            self.each_near(at, range, |close| {
                if close.separation.squared < distance * distance {
                    found.push((close.pair_type, close.group, close.pair));
                }
            });
            found
        });
        parts.concat()
    }

    fn map_chunks<T: Send>(&self, of: impl Fn(Range<usize>) -> T + Sync) -> Vec<T> {
        let count = self.candidates.len();
        (0..count.div_ceil(CHUNK)).into_par_iter().map(|c| of(c * CHUNK..count.min((c + 1) * CHUNK))).collect()
    }

    fn activity_in(&self, at: Configuration<'_>, range: Range<usize>) -> Activity {
        let mut nearest = [f64::INFINITY; 3];
        let mut count = 0;
        self.each_near(at, range, |close| {
            count += 1;
            let nearest = &mut nearest[close.group as usize];
            *nearest = nearest.min(close.separation.squared);
        });
        let [min_distance_self, min_distance_avatar, min_distance_intersecting] = nearest.map(f64::sqrt);
        Activity { count, min_distance_self, min_distance_avatar, min_distance_intersecting }
    }

    /// Calls `visit` with each candidate in `range` that is closer than its own d-hat, in order, and with that.
    #[inline]
    fn each_close(&self, at: Configuration<'_>, range: Range<usize>, mut visit: impl FnMut(ClosePair, f64)) {
        self.each_near(at, range, |close| {
            let dhat = self.dhat(&close);
            if close.separation.squared < dhat * dhat {
                visit(close, dhat);
            }
        });
    }

    /// Calls `visit` with each candidate in `range` that is closer than the d-hat of its group, in order.
    #[inline]
    fn each_near(&self, at: Configuration<'_>, range: Range<usize>, mut visit: impl FnMut(ClosePair)) {
        for run in self.candidates.ranges(range) {
            let dhat = self.settings.dhat(run.group);
            for &pair in run.pairs {
                let x = self.bodies.positions(pair, at);
                if run.pair_type.is_beyond(&x, dhat) {
                    continue;
                }
                let separation = run.pair_type.separation(&x);
                if separation.squared < dhat * dhat {
                    visit(ClosePair { pair_type: run.pair_type, group: run.group, pair, x, separation });
                }
            }
        }
    }

    #[inline]
    fn mollifier_threshold(&self, pair: [u32; 4]) -> f64 {
        mollifier::threshold(&pair.map(|i| self.bodies.rest(i)))
    }

    /// Hands `g a` and `h a a^T` to the sink, where `a` has the given component at each vertex of the pair: zero
    /// components are left out, and those of the avatar are turned into one along t, to which `path_tangent` is added.
    #[inline]
    fn emit(&self, pair: [u32; 4], components: [DVec3; 4], path_tangent: f64, [g, h]: [f64; 2], sink: &mut dyn Sink) {
        let n = self.bodies.garment_count();
        let (mut vertices, mut kept, mut count, mut t) = ([0; 4], [DVec3::ZERO; 4], 0, path_tangent);
        for (i, c) in pair.into_iter().zip(components) {
            if i as usize >= n {
                t += c.dot(self.bodies.avatar.motion[i as usize - n]);
            } else if c != DVec3::ZERO {
                vertices[count] = i;
                kept[count] = c;
                count += 1;
            }
        }
        sink.rank_one(Direction { vertices: &vertices[..count], components: &kept[..count], t }, g, h);
    }
}

/// A candidate closer than the d-hat of its group.
struct ClosePair {
    pair_type: PairType,
    group: CollisionGroup,
    pair: [u32; 4],
    x: [DVec3; 4],
    separation: Separation,
}

impl Activity {
    const NONE: Self = Self {
        count: 0,
        min_distance_self: f64::INFINITY,
        min_distance_avatar: f64::INFINITY,
        min_distance_intersecting: f64::INFINITY,
    };

    fn merged(self, other: &Self) -> Self {
        Self {
            count: self.count + other.count,
            min_distance_self: self.min_distance_self.min(other.min_distance_self),
            min_distance_avatar: self.min_distance_avatar.min(other.min_distance_avatar),
            min_distance_intersecting: self.min_distance_intersecting.min(other.min_distance_intersecting),
        }
    }
}

/// b, db/dD and d2b/dD2 for `0 < big_d < dhat`, both squared and less the squared minimum separation.
#[inline]
fn barrier(big_d: f64, dhat: f64) -> [f64; 3] {
    let (e, ln) = (big_d - dhat, maths::ln(big_d / dhat));
    let q = e / big_d;
    [-e * e * ln, -e * (2.0 * ln + q), q * q - 4.0 * q - 2.0 * ln]
}

impl Energy for Barrier {
    fn name(&self) -> &'static str {
        "barrier"
    }

    /// Number of candidates.
    fn len(&self) -> usize {
        self.candidates.len()
    }

    fn memory(&self) -> u64 {
        self.candidates.memory()
    }

    /// Infinite if a candidate is at or below the minimum separation.
    fn value(&self, at: Configuration<'_>, range: Range<usize>) -> f64 {
        let mut sum = 0.0;
        self.each_close(at, range, |ClosePair { pair_type, group, pair, x, separation }, dhat| {
            let min_separation = self.settings.min_separation(group).powi(2);
            let big_d = separation.squared - min_separation;
            if big_d <= 0.0 {
                // Not through the mollifier, which may be zero.
                sum = f64::INFINITY;
                return;
            }
            let [b, ..] = barrier(big_d, dhat * dhat - min_separation);
            let m = match pair_type {
                PairType::PointTriangle => 1.0,
                PairType::EdgeEdge => mollifier::value(&x, self.mollifier_threshold(pair)),
            };
            sum += self.weight(group, dhat) * m * b;
        });
        sum
    }

    /// Pairs at or below the minimum separation, where the value is infinite, have none.
    fn derivatives(&self, at: Configuration<'_>, range: Range<usize>, sink: &mut dyn Sink) {
        self.each_close(at, range, |ClosePair { pair_type, group, pair, x, separation }, dhat| {
            let min_separation = self.settings.min_separation(group).powi(2);
            let big_d = separation.squared - min_separation;
            if big_d <= 0.0 {
                return;
            }
            let [b, db, ddb] = barrier(big_d, dhat * dhat - min_separation).map(|v| self.weight(group, dhat) * v);
            let (m, slope) = match pair_type {
                PairType::PointTriangle => (1.0, None),
                PairType::EdgeEdge => mollifier::value_and_gradient(&x, self.mollifier_threshold(pair)),
            };
            let d = separation.squared.sqrt();
            let normal = separation.vector / d;
            let (g, h) = (2.0 * d * db, 2.0 * db + 4.0 * separation.squared * ddb);
            let path_tangent = self.path_tangent(group, big_d, dhat, min_separation, [d, g, h]);
            self.emit(pair, separation.weights.map(|w| w * normal), path_tangent, [m * g, m * h.max(0.0)], sink);
            if let Some(slope) = slope {
                self.emit(pair, slope, 0.0, [b, 0.0], sink);
            } else if self.is_curved {
                for bend in curvature::bends(pair_type, &x, &separation).into_iter().flatten() {
                    self.emit(pair, bend.closing, 0.0, [0.0, -0.5 * g], sink);
                }
            }
        });
    }

    /// None: contacts change with every step. Assembly reports pairs of vertices missing from the pattern, which is then
    /// extended by them.
    fn stencils(&self, _: &mut dyn FnMut(&[u32])) {}

    /// The candidates of the garment with itself. Those with the avatar have one vertex of the garment, or vertices of one edge or
    /// triangle, which the garment's other terms have in the pattern.
    fn passing_stencils(&self, visit: &mut dyn FnMut(&[u32])) {
        let ranges = self.candidates.ranges(0..self.candidates.len());
        for range in ranges.filter(|range| range.group != CollisionGroup::Avatar) {
            range.pairs.iter().for_each(|pair| visit(pair));
        }
    }
}
