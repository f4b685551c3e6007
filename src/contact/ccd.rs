//! Continuous collision detection by conservative advancement with a minimum separation, after the additive CCD of
//! Li et al. 2021 ("Codimensional Incremental Potential Contact", section 5.2).
//!
//! Additive CCD advances by `(d - target) / l`, where l bounds the relative speed of the pair by the norms of its
//! vertices' motions. Here the speed is bounded along the current separation `n = r / d` only. The distance is
//! never smaller than the gap between the projections onto n, so the pair may advance by
//!
//! `tau = min over i, j of (n . (a_i - b_j) - target) / max(0, -n . (p_i - q_j))`
//!
//! with vertices a, b of the two primitives and their motions p, q. That is never less than the additive step, and
//! sliding past each other costs nothing.

use std::sync::atomic::{AtomicU64, Ordering};

use glam::DVec3;
use rayon::prelude::*;

use super::bodies::Motion;
use super::candidate_set::{CandidateSet, CollisionGroup};
use super::distance::PairType;

/// The fraction of its gap above the minimum separation that a pair keeps in one step.
const KEPT_GAP: f64 = 0.1;

/// Advancing ends where less than this fraction of the way from the first distance to the target is left.
const TOLERANCE: f64 = 0.02;

/// Below the minimum separation, a pair that does not approach may still lose this fraction of its distance.
const SLACK_BELOW_SEPARATION: f64 = 0.1;

/// Most evaluations of the distance of one pair. What was found safe by then is the answer.
const MAX_ADVANCES: usize = 256;

/// Pairs a thread takes at once.
const CHUNK: usize = 1024;

/// The largest part of `motion`, at most `limit`, during which every candidate keeps more than the `min_separation` of its
/// group plus a tenth of its initial gap above it. 0 if a pair at or below the minimum separation approaches.
///
/// The same bits for any number of threads.
pub fn max_step(
    motion: &Motion,
    candidates: &CandidateSet,
    min_separation: impl Fn(CollisionGroup) -> f64,
    limit: f64,
) -> f64 {
    // The smallest answer so far, shared to cut other pairs off. A pair advances by a sequence of times that does not
    // depend on this bound and only grows towards its own answer, so it is cut off only if its own answer is not
    // below the bound. The pair with the smallest answer therefore always gets there, or finds that very number
    // already in place: the result is the minimum over all pairs, whatever the order. The bit patterns of
    // non-negative numbers are ordered as the numbers are.
    let shared = AtomicU64::new(limit.max(0.0).to_bits());
    for range in candidates.ranges(0..candidates.len()) {
        let min_separation = min_separation(range.group);
        range.pairs.par_chunks(CHUNK).for_each(|chunk| {
            for &pair in chunk {
                let bound = f64::from_bits(shared.load(Ordering::Relaxed));
                let (x, v) = (motion.positions(pair), motion.displacements(pair));
                let answer = pair_step(range.pair_type, &x, &v, min_separation, bound);
                if answer < bound {
                    shared.fetch_min(answer.to_bits(), Ordering::Relaxed);
                }
            }
        });
    }
    f64::from_bits(shared.into_inner())
}

/// The largest part of the motion `v`, at most `bound`, during which the pair at `x` keeps the distance
/// described at [`max_step`].
pub fn pair_step(pair_type: PairType, x: &[DVec3; 4], v: &[DVec3; 4], min_separation: f64, bound: f64) -> f64 {
    // Relative coordinates keep their digits where the pair is small or moves as one.
    let base = x[1];
    let x = [x[0] - base, x[1] - base, x[2] - base, x[3] - base];
    let mean = 0.25 * (v[0] + v[1] + v[2] + v[3]);
    let v = [v[0] - mean, v[1] - mean, v[2] - mean, v[3] - mean];
    let first_count = pair_type.first_count();

    let mut separation = pair_type.separation(&x);
    let mut distance = separation.squared.sqrt();
    let target = if distance > min_separation {
        min_separation + KEPT_GAP * (distance - min_separation)
    } else {
        let w = separation.weights;
        let closing: f64 = (0..4).map(|i| w[i] * separation.vector.dot(v[i])).sum();
        let still = v.iter().all(|p| *p == DVec3::ZERO);
        if closing < 0.0 || (distance == 0.0 && !still) {
            return 0.0;
        }
        (1.0 - SLACK_BELOW_SEPARATION) * distance
    };
    let close = TOLERANCE * (distance - target);

    let mut time = 0.0;
    for advance in 0..MAX_ADVANCES {
        if advance > 0 {
            let moved = std::array::from_fn(|i| x[i] + time * v[i]);
            separation = pair_type.separation(&moved);
            distance = separation.squared.sqrt();
            if distance - target <= close {
                return time;
            }
        }
        let n = if distance > 0.0 { separation.vector / distance } else { DVec3::ZERO };
        // Projections of position and motion; the first primitive is on the positive side.
        let mut tau = f64::INFINITY;
        for i in 0..first_count {
            for j in first_count..4 {
                let closing = n.dot(v[j] - v[i]);
                let gap = n.dot(x[i] - x[j]) - time * closing - target;
                if gap < 0.0 {
                    tau = 0.0;
                } else if closing > 0.0 {
                    tau = tau.min(gap / closing);
                }
            }
        }
        if tau <= 0.0 {
            // The gap is so small against the primitives that rounding has turned n. The distance itself is still
            // good, and so is the bound by norms.
            tau = (distance - target) / speed_bound(pair_type, &v);
        }
        time += tau;
        if time >= bound {
            return bound;
        }
    }
    time
}

/// A bound on the relative speed of any two points of the primitives.
#[cold]
fn speed_bound(pair_type: PairType, v: &[DVec3; 4]) -> f64 {
    let (first, second) = v.split_at(pair_type.first_count());
    let fastest = |v: &[DVec3]| v.iter().map(|p| p.length_squared()).fold(0.0, f64::max).sqrt();
    fastest(first) + fastest(second)
}
