//! What keeps garment and avatar apart: the barrier and the pairs that it sees, continuous collision detection for every
//! step, the pairs that are exempt since they intersected at the start, and the minimum separation.

use std::collections::HashSet;
use std::sync::Arc;
use std::time::Instant;

use glam::DVec3;

use super::setup::contact_distances::{ContactDistances, TOUCHING};
use crate::contact::exempt_pairs::{canonical, triangle_pairs_of};
use crate::contact::{
    Bodies, BroadPhase, CandidateSet, CollisionGroup, Configuration, ExemptPairs, Motion, PairType, Step, ccd,
};
use crate::control::{Cancel, Cancelled};
use crate::energy::barrier::{Activity, Barrier, BarrierPathRates, BarrierSettings};
use crate::error::Result;
use crate::geometry::mesh::TriangleMesh;
use crate::memory::MemoryLimit;
use crate::solver::newton::SHORT_STEP;
use crate::solver::profile::Profile;
use crate::verify::intersecting;

/// Where something is nearer than the minimum separation, that becomes this fraction of its distance.
const SEPARATION_SHARE: f64 = 0.25;

/// Parts of the garment that are near to each other at rest repel each other below this share of their distance there.
const REST_SHARE: f64 = 0.95;
/// Parts that are nearer than this at rest touch there, but for the rounding of coordinates that came in 32 bits; unless so few
/// edges lead from one to the other, as in slivers.
const TOUCHING_AT_REST: f64 = 1e-6;
const HANGS_TOGETHER: usize = 3;

/// The part of a step that is searched first, in multiples of the feasible fraction of the step before, and at least.
const SEARCH_AHEAD: f64 = 2.5;
const MIN_SEARCH: f64 = 0.05;

/// From this feasible fraction on, contact hardly makes a step shorter.
const WHOLE_STEP: f64 = 0.95;

/// The barrier term and all that keeps it valid: the pairs, the step length, the separation.
pub struct ContactGuard {
    barrier: Barrier,
    bodies: Arc<Bodies>,
    broad_phase: BroadPhase,
    /// The motion of the last search for pairs.
    motion: Motion,
    /// The part of the next step that is searched at first.
    first_search: f64,
    distances: ContactDistances,
    cancel: Cancel,
    /// Time in contact since it was last taken.
    profile: Profile,
}

impl ContactGuard {
    /// The contact of `bodies`, with the barrier of the inflation. The pairs are found by
    /// [`Self::rebuild_candidates`], within `limit`.
    pub fn new(bodies: Arc<Bodies>, distances: ContactDistances, limit: MemoryLimit, cancel: Cancel) -> Self {
        let settings = BarrierSettings {
            dhat_self: distances.dhat_self,
            dhat_avatar: distances.inflation_dhat,
            min_separation: distances.min_separation,
            rest_share: REST_SHARE,
            ..BarrierSettings::default()
        };
        let mut guard = Self {
            barrier: Barrier::new(bodies.clone(), settings),
            broad_phase: BroadPhase::new(&bodies),
            motion: Motion::default(),
            first_search: 1.0,
            bodies,
            distances,
            cancel,
            profile: Profile::default(),
        };
        guard.limit_pairs(limit);
        guard
    }

    /// The barrier term.
    pub fn barrier(&self) -> &Barrier {
        &self.barrier
    }

    /// Bounds the bytes of the pairs by what is left of `budget`.
    pub fn limit_pairs(&mut self, budget: MemoryLimit) {
        // A pair is in the piece that found it and in the whole set; vectors grow by doubling.
        self.broad_phase.set_most(budget.room_for(4 * size_of::<[u32; 4]>()));
    }

    /// Whether the last search for pairs ended because the memory limit was reached. What was computed since is void.
    pub fn exceeds_pair_budget(&self) -> bool {
        self.broad_phase.is_incomplete()
    }

    /// Bytes that it holds, without the barrier term.
    pub fn memory(&self) -> u64 {
        self.bodies.memory() + self.broad_phase.memory() + self.motion.memory()
    }

    /// The time that broad phase and continuous collision detection took since this was last called.
    pub fn take_profile(&mut self) -> Profile {
        std::mem::take(&mut self.profile)
    }

    /// Finds the pairs that are near at `at`, where nothing moves.
    pub fn rebuild_candidates(&mut self, at: Configuration<'_>) {
        self.motion.set(&self.bodies, at, None);
        self.find_candidates(1.0);
        self.keep_near_candidates(1.0);
    }

    /// Takes back the pairs that were valid before others were found at the same state.
    pub fn restore_candidates(&mut self, candidates: CandidateSet) {
        *self.barrier.candidates_mut() = candidates;
    }

    /// Begins at `at`, where the pairs of garment triangles in `initial_intersections` intersect: they are exempted until they
    /// separate, together with what touches within rounding; what is joined is so for good. Lowers the minimum separation below
    /// the distances of all active pairs.
    pub fn initialise(&mut self, at: Configuration<'_>, initial_intersections: &[[u32; 2]]) {
        let joined = self.bodies.garment.surface.joined();
        self.exempt_intersecting(at, [initial_intersections, joined].concat(), |_, _| true);
        self.update_min_separation(at, [0.0; 2]);
    }

    /// Says where the garment passes through itself as designed: there its distances at rest say nothing.
    pub fn set_intersecting_at_rest(&mut self, designed_intersections: &[[u32; 2]]) {
        let surface = &self.bodies.garment.surface;
        let mut intersects_at_rest = Vec::new();
        if !designed_intersections.is_empty() {
            intersects_at_rest.resize(surface.vertex_count, false);
            let triangles = designed_intersections.iter().flatten();
            triangles.flat_map(|&t| surface.triangles[t as usize]).for_each(|v| intersects_at_rest[v as usize] = true);
        }
        self.barrier.set_intersecting_at_rest(intersects_at_rest);
        let touching = self.touching_at_rest();
        self.barrier.set_touching_at_rest(touching);
    }

    /// The pairs of garment primitives that touch at rest though the surface does not lead from one to the other there, as where a
    /// patch stands on the cloth with a corner.
    fn touching_at_rest(&mut self) -> HashSet<[u32; 4]> {
        let rest = Configuration { x: &self.bodies.garment.rest, t: 0.0 };
        self.motion.set(&self.bodies, rest, None);
        let mut near = CandidateSet::default();
        self.broad_phase.candidates(&self.bodies, &self.motion, 1.0, TOUCHING_AT_REST, TOUCHING_AT_REST, &mut near);
        let pairs = [PairType::PointTriangle, PairType::EdgeEdge].map(|pair_type| {
            let touches = |pair: &&[u32; 4]| {
                pair_type.separation(&self.bodies.positions(**pair, rest)).squared <= TOUCHING_AT_REST.powi(2)
            };
            let near = near.of(pair_type, CollisionGroup::Garment).iter().filter(touches).copied();
            (pair_type, near.collect::<Vec<_>>())
        });
        let mut touching = HashSet::new();
        if pairs.iter().all(|(_, pairs)| pairs.is_empty()) {
            return touching;
        }
        let neighbours = self.bodies.garment.surface.neighbours();
        for (pair_type, pairs) in pairs {
            for pair in pairs {
                let (one, other) = pair.split_at(pair_type.first_count());
                let mut around = one.to_vec();
                for _ in 0..HANGS_TOGETHER {
                    around.extend(around.clone().iter().flat_map(|&v| &neighbours[v as usize]));
                    around.sort_unstable();
                    around.dedup();
                }
                if !other.iter().any(|v| around.binary_search(v).is_ok()) {
                    touching.insert(canonical(pair_type, pair));
                }
            }
        }
        touching
    }

    /// Goes on from `previous`, the contact of the same garment: with its exempt pairs and its minimum separation.
    pub fn inherit_state(&mut self, previous: &Self) {
        self.broad_phase.set_exempt_pairs(previous.broad_phase.exempt_pairs().clone());
        self.set_min_separations(previous.min_separations());
    }

    /// Pairs of garment triangles with an active pair of primitives that touches within rounding.
    fn touching(&self, at: Configuration<'_>) -> Vec<[u32; 2]> {
        let near = self.barrier.nearer_than(TOUCHING, at).into_iter();
        let own =
            near.filter(|&(_, group, _)| group != CollisionGroup::Avatar).map(|(pair_type, _, pair)| (pair_type, pair));
        triangle_pairs_of(&self.bodies.garment.surface, &own.collect::<Vec<_>>())
    }

    /// Exempt pairs that have separated become active, and the minimum separation follows the smallest distance, up to that
    /// which the distances ask for. To be called after each accepted step. True where the barrier has changed.
    ///
    /// # Errors
    /// `InvalidMesh` where a vertex is not finite.
    pub fn update_exemptions(&mut self, at: Configuration<'_>) -> Result<bool> {
        let before = self.min_separations();
        let reinstated = self.reinstate_separated(at)?;
        if reinstated || before[0] < self.distances.min_separation || !self.exempt_pairs().is_empty() {
            self.update_min_separation(at, before);
        }
        Ok(reinstated || self.min_separations() != before)
    }

    fn reinstate_separated(&mut self, at: Configuration<'_>) -> Result<bool> {
        let before = self.broad_phase.exempt_pairs();
        let joined = self.bodies.garment.surface.joined();
        if before.triangle_pairs().len() <= joined.len() {
            return Ok(false);
        }
        let triangles = self.bodies.garment.surface.triangles.clone();
        let mesh = TriangleMesh { positions: at.x.to_vec(), triangles };
        let may_separate = before.triangle_pairs().iter().filter(|pair| joined.binary_search(pair).is_err());
        let may_separate: Vec<[u32; 2]> = may_separate.copied().collect();
        let mut pairs = intersecting(&mesh, &may_separate)?;
        pairs.extend(joined);
        if pairs.len() == before.triangle_pairs().len() {
            return Ok(false);
        }
        let before = before.clone();
        // What is apart by no more than rounding stays exempt, and nothing becomes exempt anew.
        self.exempt_intersecting(at, pairs, |s, t| before.contains(s, t));
        Ok(self.exempt_pairs().triangle_pairs().len() < before.triangle_pairs().len())
    }

    /// Exempts `pairs`, and those pairs of triangles that touch within rounding at `at` and `may` join them.
    fn exempt_intersecting(&mut self, at: Configuration<'_>, mut pairs: Vec<[u32; 2]>, may: impl Fn(u32, u32) -> bool) {
        loop {
            self.broad_phase.set_exempt_pairs(ExemptPairs::new(&self.bodies.garment.surface, &pairs));
            self.rebuild_candidates(at);
            let exempt = self.exempt_pairs();
            let joins = |&[s, t]: &[u32; 2]| may(s, t) && !exempt.contains(s, t);
            let joining: Vec<[u32; 2]> = self.touching(at).into_iter().filter(joins).collect();
            if joining.is_empty() {
                return;
            }
            pairs.extend(joining);
        }
    }

    /// Sets the minimum separations as high as the distances ask for and the active pairs at `at` allow; but not below `before`,
    /// which was below all distances, unless a pair that became active is nearer than that.
    fn update_min_separation(&mut self, at: Configuration<'_>, before: [f64; 2]) {
        let near = self.barrier.activity(at);
        let nearest = [near.min_distance_self.min(near.min_distance_avatar), near.min_distance_intersecting];
        let wanted = [
            self.distances.min_separation,
            self.distances
                .min_separation
                .min(SEPARATION_SHARE * self.barrier.settings().dhat(CollisionGroup::Intersecting)),
        ];
        let [min_separation, min_separation_intersecting] = std::array::from_fn(|k| {
            let fitting = (SEPARATION_SHARE * nearest[k]).min(wanted[k]);
            if nearest[k] > before[k] { fitting.max(before[k].min(wanted[k])) } else { fitting }
        });
        self.set_min_separations([min_separation, min_separation_intersecting]);
    }

    /// Sets d-hat towards the avatar while it grows. The pairs must be found again by [`Self::rebuild_candidates`].
    pub fn set_inflation_dhat(&mut self, dhat: f64) {
        self.distances.inflation_dhat = dhat;
        self.set_dhat_avatar(dhat);
    }

    /// Doubles the distances. The pairs must be found again by [`Self::rebuild_candidates`].
    pub fn double_distances(&mut self) {
        self.distances = self.distances.doubled();
        self.barrier.set_settings(BarrierSettings { dhat_self: self.distances.dhat_self, ..*self.barrier.settings() });
    }

    /// Keeps the distances of `previous`, which may have been widened.
    pub fn inherit_distances(&mut self, previous: &Self) {
        self.distances = previous.distances;
        self.barrier.set_settings(BarrierSettings { dhat_self: self.distances.dhat_self, ..*self.barrier.settings() });
    }

    /// The distances that contact keeps.
    pub fn distances(&self) -> ContactDistances {
        self.distances
    }

    /// The distance that no pair falls below, but for pairs of primitives of triangles that intersected at the start.
    pub fn min_separation(&self) -> f64 {
        self.barrier.settings().min_separation
    }

    /// That, and the same for the pairs which it leaves out.
    fn min_separations(&self) -> [f64; 2] {
        let settings = self.barrier.settings();
        [settings.min_separation, settings.min_separation_intersecting]
    }

    fn set_min_separations(&mut self, [min_separation, min_separation_intersecting]: [f64; 2]) {
        let settings = BarrierSettings { min_separation, min_separation_intersecting, ..*self.barrier.settings() };
        if settings != *self.barrier.settings() {
            self.barrier.set_settings(settings);
        }
    }

    /// The pairs of garment triangles that are still exempt.
    pub fn exempt_pairs(&self) -> &ExemptPairs {
        self.broad_phase.exempt_pairs()
    }

    /// Sets where the barrier towards the avatar begins. The pairs must be found again by [`Self::rebuild_candidates`].
    pub fn set_dhat_avatar(&mut self, dhat_avatar: f64) {
        self.barrier.set_settings(BarrierSettings { dhat_avatar, ..*self.barrier.settings() });
    }

    /// Makes the border of the linear system that of the barrier's parameter (see [`Barrier::set_barrier_path`]), or that of t.
    pub fn set_barrier_path(&mut self, rates: Option<BarrierPathRates>) {
        self.barrier.set_barrier_path(rates);
    }

    /// Makes the pairs valid along the whole step (`dx`, `dt`) from `at`, and returns the largest fraction of it, at most
    /// `longest`, along which nothing intersects and no distance falls below the minimum separation. `None` where the
    /// pairs exceed their budget: see [`Self::exceeds_pair_budget`].
    ///
    /// # Errors
    /// [`Cancelled`]; the token is checked after each search for pairs and in the end.
    pub fn max_feasible_step(
        &mut self,
        at: Configuration<'_>,
        dx: &[DVec3],
        dt: f64,
        longest: f64,
    ) -> Result<Option<f64>, Cancelled> {
        self.motion.set(&self.bodies, at, Some(&Step { dx, dt }));
        // The pairs that only the far part of a long step meets are many, and mostly the step ends before it.
        let mut part = longest.min(self.first_search);
        loop {
            self.find_candidates(part);
            self.cancel.check()?;
            if self.exceeds_pair_budget() {
                return Ok(None);
            }
            let settings = self.barrier.settings();
            let clock = Instant::now();
            let feasible =
                ccd::max_step(&self.motion, self.barrier.candidates(), |group| settings.min_separation(group), part);
            self.profile.ccd += clock.elapsed();
            if feasible < part || part >= longest {
                self.follow_steps(feasible / longest);
                self.first_search = (SEARCH_AHEAD * feasible).clamp(MIN_SEARCH, 1.0);
                self.keep_near_candidates(feasible);
                self.cancel.check()?;
                return Ok(Some(feasible));
            }
            part = longest;
        }
    }

    /// Sees to it that the barrier's Hessian has the curvature of the distances after a step that contact made short, until one
    /// is not shortened: a gap far smaller than its balance is closed by every step along it, however little of it is taken.
    fn follow_steps(&mut self, fraction: f64) {
        if fraction < SHORT_STEP {
            self.barrier.set_curved(true);
        } else if fraction >= WHOLE_STEP {
            self.barrier.set_curved(false);
        }
    }

    /// What is in contact at `at`, which must lie within the feasible part of the last step.
    pub fn activity(&self, at: Configuration<'_>) -> Activity {
        self.barrier.activity(at)
    }

    /// The nearest pair of primitives at `at` among those below d-hat.
    pub fn nearest(&self, at: Configuration<'_>) -> Option<[u32; 4]> {
        let near = self.activity(at);
        let distance = near.min_distance_self.min(near.min_distance_avatar);
        // What is found is below the bound, not at it.
        self.barrier.nearer_than(distance * (1.0 + 1e-9), at).first().map(|&(_, _, pair)| pair)
    }

    /// The garment's vertices among those of a pair.
    pub fn garment_vertices(&self, pair: [u32; 4]) -> impl Iterator<Item = u32> {
        let count = self.bodies.garment_count() as u32;
        pair.into_iter().filter(move |&v| v < count)
    }

    /// Finds the pairs that come within their d-hat during the first `part` of the motion.
    fn find_candidates(&mut self, part: f64) {
        let BarrierSettings { dhat_self, dhat_avatar, .. } = *self.barrier.settings();
        let clock = Instant::now();
        let pairs = self.barrier.candidates_mut();
        self.broad_phase.candidates(&self.bodies, &self.motion, part, dhat_self, dhat_avatar, pairs);
        self.profile.broad_phase += clock.elapsed();
    }

    /// Keeps of the pairs those that come within their d-hat during the first `part` of the motion.
    fn keep_near_candidates(&mut self, part: f64) {
        let settings = *self.barrier.settings();
        self.barrier.candidates_mut().retain_near(&self.motion, part, |group| settings.dhat(group));
    }
}
