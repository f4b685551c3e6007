//! Where a point beside the source skeleton is beside the target's: it goes along with the bones around it.
//!
//! With a, b the ends of a bone on the source skeleton, c, d on the target's, and R the least rotation between their
//! directions, a bone takes p to
//!
//! ```text
//! m(p) = c + w (d - c) + g R (p - a - w (b - a)),   w = (p - a) . (b - a) / |b - a|^2 clamped to [0, 1]
//! ```
//!
//! So the coordinate along the bone stays, and g, the thickness of the target body there as a multiple of the source body's,
//! scales what is across it and beyond its ends.
//! The bones are blended,
//!
//! ```text
//! p -> sum_b l_b m_b(p) / sum_b l_b,   l_b = (d_b^2 + e^2)^-6,
//! ```
//!
//! d_b the distance from p to bone b on the source skeleton: smooth, so that a sheet is not torn between two legs.

use glam::{DQuat, DVec3};

use crate::geometry::closest_point::segment_parameter;
use crate::geometry::median::median;
use crate::geometry::mesh::TriangleMesh;
use crate::geometry::quantile::quantile;
use crate::geometry::turn;
use crate::input::skeleton::Skeleton;

/// e: bones nearer than this are equally near.
const EQUALLY_NEAR: f64 = 0.02;
/// A body has a thickness at a bone with so many vertices there, at least.
const ENOUGH: usize = 6;
/// The thickness of one body as a multiple of another's, at most.
const MAX_THICKNESS: f64 = 4.0;

/// One bone in both skeletons.
#[derive(Clone, Copy)]
struct BonePair {
    start: DVec3,
    span: DVec3,
    target_start: DVec3,
    target_span: DVec3,
    turn: DQuat,
    thickness: f64,
}

/// The map from beside one skeleton to beside another.
pub struct BoneMap {
    pairs: Vec<BonePair>,
}

impl BoneMap {
    /// The map between two skeletons that share their bones. `bodies` are those on them, normalised like these; without them
    /// bodies count as equally thick.
    pub fn new(source: &Skeleton, target: &Skeleton, bodies: Option<[&TriangleMesh; 2]>) -> Self {
        let thickness = bodies.map(|[on_source, on_target]| ratios(source, target, on_source, on_target));
        let pair = |(bone, &ends): (usize, &[u32; 2])| {
            let [[start, end], [target_start, target_end]] =
                [source, target].map(|s| ends.map(|j| s.joints[j as usize]));
            let (span, target_span) = (end - start, target_end - target_start);
            let turn = match (span.try_normalize(), target_span.try_normalize()) {
                (Some(from), Some(to)) => turn::arc(from, to),
                // A bone without a direction only moves.
                _ => DQuat::IDENTITY,
            };
            let thickness = thickness.as_ref().map_or(1.0, |ratios| ratios[bone]);
            BonePair { start, span, target_start, target_span, turn, thickness }
        };
        Self { pairs: source.bones.iter().enumerate().map(pair).collect() }
    }

    /// The place of `p` beside the target skeleton.
    pub fn apply(&self, p: DVec3) -> DVec3 {
        let (mut sum, mut total) = (DVec3::ZERO, 0.0);
        // Of two points at one bone, the nearer one is not to be torn away by a power of tiny numbers: ratios to the nearest.
        let nearest = self.pairs.iter().map(|pair| pair.softened(p)).fold(f64::INFINITY, f64::min);
        for pair in &self.pairs {
            let weight = (nearest / pair.softened(p)).powi(6);
            sum += weight * pair.apply(p);
            total += weight;
        }
        if total > 0.0 { sum / total } else { p }
    }

    /// The map by those bones alone that are the nearest ones of `share` of the `points` at least, by their `weights`; by
    /// all where no bone is. The bones on which a stiff piece sits, and none that a corner of it is near to.
    pub fn around(&self, points: &[DVec3], weights: &[f64], share: f64) -> Self {
        let mut sums = vec![0.0; self.pairs.len()];
        for (&p, weight) in points.iter().zip(weights) {
            let squares = self.pairs.iter().map(|pair| pair.distance_squared(p)).enumerate();
            if let Some((nearest, _)) = squares.min_by(|a, b| a.1.total_cmp(&b.1)) {
                sums[nearest] += weight;
            }
        }
        let enough = share * weights.iter().sum::<f64>();
        let pairs: Vec<BonePair> =
            self.pairs.iter().zip(&sums).filter(|(_, sum)| **sum >= enough).map(|(pair, _)| *pair).collect();
        Self { pairs: if pairs.is_empty() { self.pairs.clone() } else { pairs } }
    }
}

impl BonePair {
    fn distance_squared(&self, p: DVec3) -> f64 {
        distance_squared(p, self.start, self.span)
    }

    fn softened(&self, p: DVec3) -> f64 {
        self.distance_squared(p) + EQUALLY_NEAR * EQUALLY_NEAR
    }

    fn apply(&self, p: DVec3) -> DVec3 {
        let inside = segment_parameter(p - self.start, self.span);
        let rest = p - self.start - inside * self.span;
        self.target_start + inside * self.target_span + self.thickness * (self.turn * rest)
    }
}

fn distance_squared(p: DVec3, start: DVec3, span: DVec3) -> f64 {
    (p - start - segment_parameter(p - start, span) * span).length_squared()
}

/// The thickness of the target body as a multiple of the source body's, at each bone: the ratio of the median distances from it
/// of the surface nearest to it. Where there is too little, the median of the other bones.
fn ratios(source: &Skeleton, target: &Skeleton, on_source: &TriangleMesh, on_target: &TriangleMesh) -> Vec<f64> {
    let [before, after] = [medians(source, on_source), medians(target, on_target)];
    let ratio = |(a, b): (&Option<f64>, &Option<f64>)| match (a, b) {
        (&Some(a), &Some(b)) if a > 0.0 && b > 0.0 => Some((b / a).clamp(1.0 / MAX_THICKNESS, MAX_THICKNESS)),
        _ => None,
    };
    let known: Vec<Option<f64>> = before.iter().zip(&after).map(ratio).collect();
    let others = median(known.iter().flatten().copied().collect()).unwrap_or(1.0);
    known.into_iter().map(|ratio| ratio.unwrap_or(others)).collect()
}

/// The median distance from each bone of the vertices nearest to it, where there are enough, each for the area around it: most
/// vertices of a head are in its face.
fn medians(skeleton: &Skeleton, body: &TriangleMesh) -> Vec<Option<f64>> {
    let segments: Vec<[DVec3; 2]> = skeleton
        .bones
        .iter()
        .map(|ends| {
            let [a, b] = ends.map(|j| skeleton.joints[j as usize]);
            [a, b - a]
        })
        .collect();
    let mut distances: Vec<Vec<(f64, f64)>> = vec![Vec::new(); segments.len()];
    for (&p, area) in body.positions.iter().zip(body.vertex_areas()).filter(|(_, area)| *area > 0.0) {
        let squares = segments.iter().map(|&[a, span]| distance_squared(p, a, span)).enumerate();
        if let Some((bone, squared)) = squares.min_by(|a, b| a.1.total_cmp(&b.1)) {
            distances[bone].push((squared.sqrt(), area));
        }
    }
    distances.into_iter().map(|d| if d.len() < ENOUGH { None } else { quantile(d, 0.5) }).collect()
}
