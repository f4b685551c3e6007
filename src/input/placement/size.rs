//! Unit and axes of a mesh against its skeleton.
//!
//! A mesh lies around its bones. So it is tried in other units and axes, about the origin of coordinates as a file would be
//! read, and where it then lies much nearer to the bones, in proportion to its own extent, its numbers are meant so.

use glam::DVec3;
use rayon::prelude::*;

use super::bones::Bones;
use crate::geometry::mesh::TriangleMesh;
use crate::geometry::spread::spread;
use crate::input::coordinate_system::AxisTurn;
use crate::input::skeleton::Skeleton;
use crate::input::skin::SkinWeights;
use crate::maths;

/// Ratios of units: of foot, inch, decimetre, centimetre and millimetre among themselves and to the metre.
pub const RATIOS: [f64; 9] = [2.54, 3.280_84, 10.0, 12.0, 25.4, 30.48, 39.370_1, 100.0, 1000.0];
/// A measured factor within this of a ratio, in the logarithm, is that ratio.
const SAME_RATIO: f64 = 0.2;
/// By how much less another factor has to cost to be the cause in place of a ratio: what is small or in one place suits many,
/// and where the ratio mends much, a unit it is.
const OTHER_FACTOR: [f64; 2] = [0.1, 0.45];
/// What a ratio has to mend, in the logarithm, for the latter.
const MUCH: f64 = 3.5;
/// Points of the mesh that are looked at, and how many times a bone where there are many.
const MOST_POINTS: usize = 256;
const MOST_PAIRS: usize = 8000;
const MOST_BONES: usize = 200;
/// A body and its skeleton have about one extent: the least and the most of one in the other.
const BODY_EXTENTS: [f64; 2] = [0.5, 8.0];
/// How many times farther from the bones than the body's own surface, or nearer, a garment lies as a rule, and at most.
const LOOSENESS: [f64; 2] = [2.0, 6.0];
/// What a factor costs that leaves the first of these ranges for the second, for each e-fold.
const LOOSE: f64 = 0.3;
/// Ratios that cost no more than this above the best suit as well: of what is small or around few bones, the right one is
/// not always the best.
const ALMOST: f64 = 0.45;
/// The same for ratios farther from the best than this, in the logarithm.
const FAR: f64 = 0.45;
const ALMOST_FAR: f64 = 0.2;
/// What is merely elsewhere costs no more than this above the best, once it is moved.
const ELSEWHERE: f64 = 0.15;
/// Ratios that are told beside the best, at most.
const BESIDE: usize = 2;
/// A body of which this share is no farther from the bones than that, in sizes of the skeleton, is not so many times too large:
/// what lies far away is something else, such as a second body.
const AROUND: (f64, f64, f64) = (0.25, 0.3, 10.0);
/// What another reading has to be better by, as a factor, to be told, and to be refused.
const TOLD: f64 = 1.9;
const REFUSED: f64 = 2.5;

/// How a mesh has to be read to lie around its bones.
#[derive(Clone, Debug, PartialEq)]
pub struct Mend {
    /// What its coordinates are to be multiplied by.
    pub factor: f64,
    /// Other ratios of units that suit as well, the best first.
    pub or: Vec<f64>,
    /// What it is to be turned by.
    pub turn: AxisTurn,
    /// How many times nearer it then lies.
    pub gain: f64,
    /// More than the distance says so.
    pub is_proven: bool,
}

impl Mend {
    /// None where the mesh lies around its bones as it is; else whether it is refused.
    pub fn is_gross(&self) -> Option<bool> {
        let is_other = self.factor != 1.0 || self.turn != AxisTurn::IDENTITY;
        (is_other && (self.is_proven || self.gain > TOLD)).then_some(self.is_proven || self.gain > REFUSED)
    }

    /// Whether it may be the same for another mesh.
    pub fn is_like(&self, other: &Self) -> bool {
        let suits = |factor: &f64| other.factor == *factor || other.or.contains(factor);
        other.is_gross().is_some() && self.turn == other.turn && (suits(&self.factor) || self.or.iter().any(suits))
    }

    /// The other way round: what the skeleton needs.
    pub fn inverse(self) -> Self {
        let back = AxisTurn::rotations().into_iter().find(|turn| turn.after(self.turn) == AxisTurn::IDENTITY);
        Self {
            factor: 1.0 / self.factor,
            or: self.or.into_iter().map(f64::recip).collect(),
            turn: back.unwrap_or(AxisTurn::IDENTITY),
            gain: self.gain,
            is_proven: self.is_proven,
        }
    }
}

/// Whether a body lies around its bones as it is, so that it is neither in another unit nor in other axes.
pub fn lies_around(body: &TriangleMesh, skeleton: &Skeleton) -> bool {
    let around = Surroundings::of_body(body, skeleton, None);
    around.is_around_bones() && around.mend().is_gross().is_none()
}

/// What is expected of a mesh beside lying around the bones.
#[derive(Clone, Copy)]
enum Expected {
    /// An extent like the skeleton's.
    Body,
    /// Distances from the bones like the body's, which are given in sizes of the skeleton.
    Garment(f64),
}

/// A point and the joint that it moves with.
type Point = (DVec3, Option<u32>);

/// Points of a mesh, and the bones that they lie around.
pub struct Surroundings {
    /// Spread evenly by area.
    points: Vec<Point>,
    /// Corners of every so many triangles.
    corners: Vec<Point>,
    bones: Bones,
    /// Root mean square of the distances of the points from their mean.
    radius: f64,
    /// The longest sides of the boxes around mesh and joints.
    extents: [f64; 2],
    expected: Expected,
}

impl Surroundings {
    /// A body around its skeleton. With a skin, each point is compared with the bones of its joint.
    pub fn of_body(mesh: &TriangleMesh, skeleton: &Skeleton, skin: Option<&SkinWeights>) -> Self {
        Self::new(mesh, skeleton, skin, Expected::Body)
    }

    /// A garment around the skeleton that it was designed on, for a body whose surface is `thickness` away from it.
    pub fn of_garment(mesh: &TriangleMesh, skeleton: &Skeleton, thickness: f64) -> Self {
        Self::new(mesh, skeleton, None, Expected::Garment(thickness))
    }

    fn new(mesh: &TriangleMesh, skeleton: &Skeleton, skin: Option<&SkinWeights>, expected: Expected) -> Self {
        let every = skeleton.bones.len().div_ceil(MOST_BONES).max(1);
        // All of them where a skin chooses among them.
        let every = if skin.is_some() { 1 } else { every };
        let ends = |bone: [u32; 2]| bone.map(|j| skeleton.joints[j as usize]);
        let bones: Vec<_> = skeleton.bones.iter().step_by(every).map(|&bone| (ends(bone), bone)).collect();
        let wanted = (MOST_PAIRS / bones.len().max(1)).clamp(40, MOST_POINTS);
        let with_joint = |(p, v): (DVec3, u32)| (p, skin.and_then(|s| s.dominant_joint(v as usize)));
        let points: Vec<Point> = spread(mesh, wanted).into_iter().map(with_joint).collect();
        let some = mesh.triangles.iter().step_by(mesh.triangles.len().div_ceil(wanted).max(1));
        let corners = some.map(|t| with_joint((mesh.positions[t[0] as usize], t[0]))).collect();
        let mean = points.iter().map(|p| p.0).sum::<DVec3>() / points.len().max(1) as f64;
        let square: f64 = points.iter().map(|p| p.0.distance_squared(mean)).sum();
        let radius = (square / points.len().max(1) as f64).sqrt();
        let used = mesh.triangles.iter().flatten().map(|&v| mesh.positions[v as usize]);
        let extents = [longest_side(used), longest_side(skeleton.joints.iter().copied())];
        Self { points, corners, bones: Bones::new(&bones, skin.is_some()), radius, extents, expected }
    }

    /// The mean distance from the bones, once the mesh has been mended.
    fn distance(&self, factor: f64, turn: AxisTurn) -> f64 {
        let sum: f64 = self.points.iter().map(|point| self.distance_of(point, factor, turn)).sum();
        sum / self.points.len().max(1) as f64
    }

    fn distance_of(&self, &(p, joint): &Point, factor: f64, turn: AxisTurn) -> f64 {
        self.bones.distance(factor * turn.apply(p), joint)
    }

    /// How far the surface is from the bones, in sizes of the skeleton: a median, for a ground plane in the body's file can
    /// be most of its area.
    pub fn thickness(&self, mend: &Mend) -> f64 {
        let median = |points: &[Point]| {
            let mut all: Vec<f64> = points.iter().map(|p| self.distance_of(p, mend.factor, mend.turn)).collect();
            // Of two in the middle the lower: what lies far away, such as a second body, makes none thicker.
            let middle = all.len().saturating_sub(1) / 2;
            if all.is_empty() { f64::INFINITY } else { *all.select_nth_unstable_by(middle, f64::total_cmp).1 }
        };
        median(&self.points).min(median(&self.corners)) / self.extents[1].max(f64::MIN_POSITIVE)
    }

    /// Whether much of a body lies around its bones as it is.
    fn is_around_bones(&self) -> bool {
        let (share, distance, _) = AROUND;
        let is_near = |point: &&Point| self.distance_of(point, 1.0, AxisTurn::IDENTITY) <= distance * self.extents[1];
        let near = self.corners.iter().filter(is_near).count();
        matches!(self.expected, Expected::Body) && near as f64 >= share * self.corners.len() as f64
    }

    /// The logarithm of what is bad about a reading.
    fn cost(&self, factor: f64, turn: AxisTurn) -> f64 {
        self.cost_at(factor, self.distance(factor, turn))
    }

    /// The same of the mesh as it is, once each of its points has been moved.
    pub(super) fn cost_of_moved(&self, map: impl Fn(DVec3) -> DVec3) -> f64 {
        let sum: f64 = self.points.iter().map(|&(p, joint)| self.bones.distance(map(p), joint)).sum();
        self.cost_at(1.0, sum / self.points.len().max(1) as f64)
    }

    /// The same for a mean distance from the bones.
    fn cost_at(&self, factor: f64, distance: f64) -> f64 {
        let beyond = |ratio: f64, [low, high]: [f64; 2]| maths::ln(ratio / high).max(maths::ln(low / ratio)).max(0.0);
        let unlikely = match self.expected {
            Expected::Body => beyond(factor * self.extents[0] / self.extents[1], BODY_EXTENTS),
            Expected::Garment(thickness) => {
                let looseness = distance / self.extents[1] / thickness;
                let [rule, most] = LOOSENESS.map(|x| beyond(looseness, [1.0 / x, x]));
                LOOSE * rule + most
            }
        };
        maths::ln(distance / (factor * self.radius)) + unlikely
    }

    /// Whether it lies much nearer to the bones as another mesh has to be read.
    pub fn suits(&self, other: &Mend) -> bool {
        self.cost(1.0, AxisTurn::IDENTITY) - self.cost(other.factor, other.turn) >= maths::ln(TOLD)
    }

    /// The reading that suits the bones best: as it is where no other is better.
    pub fn mend(&self) -> Mend {
        let as_it_is = Mend { factor: 1.0, or: Vec::new(), turn: AxisTurn::IDENTITY, gain: 1.0, is_proven: false };
        let Some(Mend { factor: ratio, turn, gain, .. }) = self.nearest() else { return as_it_is };
        let now = self.cost(1.0, AxisTurn::IDENTITY);
        let cost = now - maths::ln(gain);
        if gain < TOLD {
            return as_it_is;
        }
        if ratio <= 1.0 / AROUND.2 && self.is_around_bones() {
            return as_it_is;
        }
        let much = now - cost >= MUCH;
        let (cost, factor) = self.measured(ratio, turn, cost, OTHER_FACTOR[usize::from(much)]);
        // No unit is the cause of another factor, and what is small, such as an earring, suits many.
        if factor != ratio {
            return as_it_is;
        }
        // What merely lies elsewhere needs a move: then neither unit nor axes are to blame.
        let worse = self.moved_to_bones().cost(1.0, AxisTurn::IDENTITY) - cost;
        if worse < if factor == 1.0 { 0.0 } else { ELSEWHERE } {
            return as_it_is;
        }
        let or = if factor == 1.0 { Vec::new() } else { self.others(factor, turn, cost) };
        Mend { factor, or, turn, gain: maths::exp(now - cost), is_proven: false }
    }

    /// The reading after which the mesh lies nearest to its bones, without a doubt about it; none where it has no points.
    pub(super) fn nearest(&self) -> Option<Mend> {
        let now = self.cost(1.0, AxisTurn::IDENTITY);
        if !now.is_finite() {
            return None;
        }
        let turns = AxisTurn::rotations();
        let factors = [1.0].into_iter().chain(RATIOS.into_iter().flat_map(|r| [1.0 / r, r]));
        let readings: Vec<(f64, AxisTurn)> =
            factors.flat_map(|factor| turns.iter().map(move |&turn| (factor, turn))).collect();
        let costs: Vec<f64> = readings.par_iter().map(|&(factor, turn)| self.cost(factor, turn)).collect();
        let mut best = (now, 1.0, AxisTurn::IDENTITY);
        for (&cost, &(factor, turn)) in costs.iter().zip(&readings) {
            // Of readings that are as good, as of a round garment, the first: the smaller turn, and no other unit.
            if cost < best.0 - 0.05 {
                best = (cost, factor, turn);
            }
        }
        let (cost, factor, turn) = best;
        let or = if factor == 1.0 { Vec::new() } else { self.others(factor, turn, cost) };
        Some(Mend { factor, or, turn, gain: maths::exp(now - cost), is_proven: false })
    }

    /// The mesh with its mean in the middle of the bones, its size and axes as they are.
    fn moved_to_bones(&self) -> Self {
        let mean = self.points.iter().map(|p| p.0).sum::<DVec3>() / self.points.len().max(1) as f64;
        let bones = self.bones.segments();
        let whole: f64 = bones.iter().map(|[a, b]| a.distance(*b)).sum();
        let middle: DVec3 = bones.iter().map(|&[a, b]| 0.5 * a.distance(b) * (a + b)).sum();
        let away = middle / whole.max(f64::MIN_POSITIVE) - mean;
        let moved = |points: &[Point]| points.iter().map(|&(p, joint)| (p + away, joint)).collect();
        Self { points: moved(&self.points), corners: moved(&self.corners), bones: self.bones.clone(), ..*self }
    }

    /// The ratios that suit almost as well as `factor`.
    fn others(&self, factor: f64, turn: AxisTurn, cost: f64) -> Vec<f64> {
        let others = RATIOS.into_iter().flat_map(|r| [1.0 / r, r]).filter(|other| *other != factor);
        let mut costs: Vec<(f64, f64)> = others.map(|other| (self.cost(other, turn), other)).collect();
        costs.retain(|&(its, other)| {
            its < cost + if maths::ln(other / factor).abs() > FAR { ALMOST_FAR } else { ALMOST }
        });
        costs.sort_by(|a, b| a.0.total_cmp(&b.0));
        costs.into_iter().take(BESIDE).map(|(_, other)| other).collect()
    }

    /// The factor near `ratio` that suits best where it is none of the ratios and costs by `less` less.
    fn measured(&self, ratio: f64, turn: AxisTurn, cost: f64, less: f64) -> (f64, f64) {
        if ratio == 1.0 {
            return (cost, ratio);
        }
        let steps = (-40..=40).map(|k| ratio * maths::exp(0.02 * f64::from(k)));
        let (least, factor) = steps
            .map(|factor| (self.cost(factor, turn), factor))
            .min_by(|a, b| a.0.total_cmp(&b.0))
            .unwrap_or((cost, ratio));
        if maths::ln(factor / ratio).abs() < SAME_RATIO || cost - least < less {
            (cost, ratio)
        } else {
            (least, factor)
        }
    }
}

fn longest_side(points: impl Iterator<Item = DVec3>) -> f64 {
    let (low, high) = points.fold((DVec3::MAX, DVec3::MIN), |(l, h), p| (l.min(p), h.max(p)));
    (high - low).max_element()
}
