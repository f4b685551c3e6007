//! How thick the limbs of one body are beside those of another that shares its bones.
//!
//! From stations along each bone rays go out across it, to where they leave the body; the size of the limb there is the mean of
//! the shorter ones, for of the others some run on into the next limb. At a point p the ratio of the sizes on the two bodies is
//!
//! ```text
//! sum_b l_b g_b(w_b) / sum_b l_b,   l_b = (d_b^2 + e^2)^-6,
//! ```
//!
//! g_b interpolated between the stations of bone b, w_b the parameter of the point of b nearest to p, d_b its distance: smooth, so
//! that nothing jumps where one bone ends and the next begins.

use glam::DVec3;
use rayon::prelude::*;

use crate::geometry::closest_point::{ClosestPoint, segment_parameter};
use crate::geometry::median::median;
use crate::input::skeleton::Skeleton;
use crate::maths;

/// e: bones nearer than this are equally near.
const EQUALLY_NEAR: f64 = 0.02;
/// Places on a bone, in the middle of as many equal parts.
const STATIONS: usize = 5;
/// Rays from a station, and how many of the shortest count. Where fewer meet the body, its size there is not known.
const RAYS: usize = 16;
const SHORTEST: usize = 12;
/// The thickness of one body as a multiple of another's, at most.
const MAX_RATIO: f64 = 4.0;

/// The ratio at the stations of a bone.
type Ratios = [f64; STATIONS];

/// The sizes of limbs on one body as multiples of those on another.
#[derive(Clone)]
pub struct LimbSizes {
    /// From and to, on the first.
    bones: Vec<[DVec3; 2]>,
    ratios: Vec<Ratios>,
}

impl LimbSizes {
    /// The ratio of the body in `to` to that in `from`, each in the space in which its skeleton is 2 long.
    pub fn new(from: (&Skeleton, &ClosestPoint), to: (&Skeleton, &ClosestPoint)) -> Self {
        let known: Vec<[Option<f64>; STATIONS]> = (0..from.0.bones.len())
            .into_par_iter()
            .map(|bone| {
                let [before, after] = [from, to].map(|(skeleton, body)| sizes(ends(skeleton, bone), body));
                std::array::from_fn(|k| {
                    let (Some(before), Some(after)) = (before[k], after[k]) else { return None };
                    let ratio = after / before;
                    ratio.is_finite().then(|| ratio.clamp(1.0 / MAX_RATIO, MAX_RATIO))
                })
            })
            .collect();
        // Where a size is not known, as beside a bone that is not inside of the body, the rest of the bone decides, or the others.
        let others = median(known.iter().flatten().flatten().copied().collect()).unwrap_or(1.0);
        let ratios = known.iter().map(|ratios| {
            let own = median(ratios.iter().flatten().copied().collect()).unwrap_or(others);
            ratios.map(|ratio| ratio.unwrap_or(own))
        });
        Self { ratios: ratios.collect(), bones: (0..from.0.bones.len()).map(|bone| ends(from.0, bone)).collect() }
    }

    /// The ratio at `p`, which is beside the first body.
    pub fn ratio(&self, p: DVec3) -> f64 {
        let near = |&[a, b]: &[DVec3; 2]| {
            let w = segment_parameter(p - a, b - a);
            (w, p.distance_squared(a.lerp(b, w)) + EQUALLY_NEAR * EQUALLY_NEAR)
        };
        // As multiples of the nearest, whose powers are numbers of order 1.
        let nearest = self.bones.iter().map(|bone| near(bone).1).fold(f64::INFINITY, f64::min);
        let (mut sum, mut total) = (0.0, 0.0);
        for (bone, ratios) in self.bones.iter().zip(&self.ratios) {
            let (w, squared) = near(bone);
            let weight = (nearest / squared).powi(6);
            sum += weight * interpolated(ratios, w);
            total += weight;
        }
        if total > 0.0 { sum / total } else { 1.0 }
    }

    /// Bytes that it holds.
    pub fn memory(&self) -> u64 {
        crate::memory::bytes(&self.bones) + crate::memory::bytes(&self.ratios)
    }
}

fn ends(skeleton: &Skeleton, bone: usize) -> [DVec3; 2] {
    skeleton.bones[bone].map(|j| skeleton.joints[j as usize])
}

/// Between the middles of the stations linearly, and beyond the first and the last as there.
fn interpolated(ratios: &Ratios, w: f64) -> f64 {
    let at = (w * STATIONS as f64 - 0.5).clamp(0.0, (STATIONS - 1) as f64);
    let k = (at as usize).min(STATIONS - 2);
    ratios[k] + (at - k as f64) * (ratios[k + 1] - ratios[k])
}

/// The size of the limb around the bone from a to b at each station.
fn sizes([a, b]: [DVec3; 2], body: &ClosestPoint) -> [Option<f64>; STATIONS] {
    let Some(axis) = (b - a).try_normalize() else { return [None; STATIONS] };
    let (u, v) = axis.any_orthonormal_pair();
    std::array::from_fn(|station| {
        let start = a.lerp(b, (station as f64 + 0.5) / STATIONS as f64);
        let ray = |k: usize| {
            let (sin, cos) = maths::sin_cos(std::f64::consts::TAU * (k as f64 + 0.5) / RAYS as f64);
            body.first_hit(start, cos * u + sin * v)
        };
        let mut lengths: Vec<f64> = (0..RAYS).filter_map(ray).collect();
        lengths.sort_by(f64::total_cmp);
        let size = lengths.get(..SHORTEST)?.iter().sum::<f64>() / SHORTEST as f64;
        (size > 0.0).then_some(size)
    })
}
