//! The axis of each boundary loop: which bones it follows.
//!
//! A cuff follows the closest bone that passes through it. A hem around both legs has no bone of its own:
//! where several bones cross the loop's plane inside the loop's hull, it follows their mean. A small hole in the cloth, as
//! in a net or where faces are missing, follows none.
//!
//! An armhole lies around the joint at which two bones meet. Where the target's arms are raised, it would turn with the upper arm,
//! and pull the sides of a vest out to wings: it belongs to the trunk, so it follows the one of the two that turns less.

use glam::DVec3;

use crate::energy::position::MovingAxis;
use crate::geometry::closest_point::closest_on_segment;
use crate::geometry::mesh::BoundaryLoop;
use crate::geometry::turn;
use crate::input::skeleton::Skeleton;
use crate::maths;

/// A bone passes through a loop where the cosine of its angle to the loop's normal is above this: 60 degrees.
const THROUGH: f64 = 0.5;

/// How far a bone reaches beyond a leaf joint, as a share of its length: the foot under the last joint of a leg.
const LEAF_REACH: f64 = 0.25;

/// A bone shorter than this share of the loop's mean radius, in either skeleton, has no direction worth following: along it
/// the loop would be many bone lengths away, and be dragged as far.
const STUB: f64 = 0.1;

/// A loop that no bone crosses is a hole in the cloth where it is narrower than this, and than its distance from all bones;
/// on a person seven centimetres. Holes go with the cloth around them: hundreds of them, each held along its bone, would
/// hold the cloth as a whole.
pub(super) const HOLE: f64 = 0.1;

/// A loop around a joint follows the other bone there where that turns less by so many degrees.
const STEADIER: f64 = 20.0;

/// A loop whose area is below this share of its squared length is a slit, without a normal.
const SLIT: f64 = 1e-6;

/// The bones that a loop follows, and their mean.
#[derive(Clone, Debug, PartialEq)]
pub struct LoopAxis {
    /// Indices of the bones in the source skeleton, ascending; at least one.
    pub bones: Vec<u32>,
    /// The axis: the bone, or the mean of the bones, all taken from the same side of the loop's plane.
    pub axis: MovingAxis,
}

/// Chooses what each of `loops` follows; none for a hole in the cloth, a loop without vertices or a skeleton without length.
///
/// `rest` are the garment's vertices; both skeletons are in its space and share one order of joints (the bones
/// of `target` are not read). For each loop: all the bones through it that cross its plane inside its hull,
/// if there are several; else the closest bone among those through it, or the one that it meets within the loop and that turns
/// much less from source to target; else, and where that one is farther away than the closest at all by more than the loop is wide, as
/// a hip is from the hole beside the toes of a sandal, that. A bone
/// is *through* the loop within 60 degrees of its normal, and *closest* as a segment, to the mean of the
/// loop's vertices. The normal is that of the loop's area vector, along which the opening looks largest.
pub fn choose_loop_axes(
    rest: &[DVec3],
    loops: &[BoundaryLoop],
    source: &Skeleton,
    target: &Skeleton,
) -> Vec<Option<LoopAxis>> {
    let mut degree = vec![0_u32; source.joints.len()];
    for &joint in source.bones.iter().flatten() {
        degree[joint as usize] += 1;
    }
    loops
        .iter()
        .map(|boundary| {
            let opening = Opening::new(rest, &boundary.vertices)?;
            let crossing: Vec<u32> = (0..source.bones.len() as u32)
                .filter(|&bone| !opening.is_stub(source.bones[bone as usize], source, target))
                .filter(|&bone| opening.is_crossed_by(source, source.bones[bone as usize], &degree))
                .collect();
            if crossing.is_empty() && opening.is_hole(source) {
                return None;
            }
            let bones = if crossing.len() > 1 {
                crossing
            } else {
                let closest = opening.closest_bone(source, target)?;
                vec![opening.steadier_bone(closest, source, target).unwrap_or(closest)]
            };
            let axis = opening.mean_of(&bones, source, target);
            Some(LoopAxis { bones, axis })
        })
        .collect()
}

/// The bone nearest to `p` in the source skeleton, and its axis; none where there is only what is too short to follow from there.
pub fn nearest_bone_axis(p: DVec3, source: &Skeleton, target: &Skeleton) -> Option<(u32, MovingAxis)> {
    let nearest = source.bones.iter().zip(0u32..).filter_map(|(bone, index)| {
        let ends = |skeleton: &Skeleton| bone.map(|joint| skeleton.joints[joint as usize]);
        let axis = MovingAxis { start: ends(source), end: ends(target) };
        let [a, b] = axis.start;
        let distance = closest_on_segment(p, a, b - a).distance(p);
        let length = a.distance(b).min(axis.end[0].distance(axis.end[1]));
        (length > 0.0 && length > STUB * distance).then_some((distance, index, axis))
    });
    nearest.min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, index, axis)| (index, axis))
}

/// A loop as a hole to look through.
struct Opening {
    centre: DVec3,
    /// Unit normal, or zero for a slit.
    normal: DVec3,
    points: Vec<DVec3>,
}

impl Opening {
    fn new(rest: &[DVec3], vertices: &[u32]) -> Option<Self> {
        let points: Vec<DVec3> = vertices.iter().map(|&v| rest[v as usize]).collect();
        let last = points.last()?;
        let centre = points.iter().sum::<DVec3>() / points.len() as f64;
        let (mut area, mut length, mut previous) = (DVec3::ZERO, 0.0, *last);
        for &point in &points {
            area += 0.5 * (previous - centre).cross(point - centre);
            length += previous.distance(point);
            previous = point;
        }
        let normal = if area.length() > SLIT * length * length { area.normalize_or_zero() } else { DVec3::ZERO };
        Some(Self { centre, normal, points })
    }

    /// The diameter of a circle around it.
    fn width(&self) -> f64 {
        2.0 * self.points.iter().map(|p| p.distance(self.centre)).fold(0.0, f64::max)
    }

    /// True for a small one far from all bones.
    fn is_hole(&self, source: &Skeleton) -> bool {
        let width = self.width();
        let is_farther = |bone: &[u32; 2]| {
            let [a, b] = bone.map(|joint| source.joints[joint as usize]);
            closest_on_segment(self.centre, a, b - a).distance(self.centre) > width
        };
        width < HOLE && source.bones.iter().all(is_farther)
    }

    /// True for a bone without length, or hardly any.
    fn is_stub(&self, bone: [u32; 2], source: &Skeleton, target: &Skeleton) -> bool {
        let radius = self.points.iter().map(|p| p.distance(self.centre)).sum::<f64>() / self.points.len() as f64;
        [source, target].iter().any(|s| {
            let [a, b] = bone.map(|joint| s.joints[joint as usize]);
            a.distance(b) <= STUB * radius
        })
    }

    fn is_through(&self, span: DVec3) -> bool {
        span.dot(self.normal).abs() > THROUGH * span.length()
    }

    /// True where the bone, lengthened at leaf joints, is through the loop and crosses its plane inside its hull.
    fn is_crossed_by(&self, skeleton: &Skeleton, bone: [u32; 2], degree: &[u32]) -> bool {
        let [a, b] = bone.map(|joint| skeleton.joints[joint as usize]);
        let span = b - a;
        if !self.is_through(span) {
            return false;
        }
        let [before, after] = bone.map(|joint| if degree[joint as usize] == 1 { LEAF_REACH } else { 0.0 });
        let (a, b) = (a - span * before, b + span * after);
        let [ha, hb] = [a, b].map(|p| (p - self.centre).dot(self.normal));
        // Half-open, so that two bones joined on the plane cross it once.
        (ha < 0.0) != (hb < 0.0) && self.hull_contains(a.lerp(b, ha / (ha - hb)))
    }

    /// True where `p`, on the loop's plane, is inside the convex hull of the loop projected to that plane: seen
    /// from there, the loop's points leave no angle of half a turn or more uncovered.
    fn hull_contains(&self, p: DVec3) -> bool {
        let (u, v) = self.normal.any_orthonormal_pair();
        let angle_of = |q: &DVec3| maths::atan2((*q - p).dot(v), (*q - p).dot(u));
        let mut angles: Vec<f64> = self.points.iter().map(angle_of).collect();
        angles.sort_by(f64::total_cmp);
        let wrapped = angles[0] + std::f64::consts::TAU;
        angles.iter().zip(angles.iter().skip(1).chain([&wrapped])).all(|(a, b)| b - a < std::f64::consts::PI)
    }

    /// The closest bone among those through the loop, or the closest of all, where that is closer by more than the loop is wide: bones
    /// without length do not count.
    fn closest_bone(&self, skeleton: &Skeleton, target: &Skeleton) -> Option<u32> {
        let (mut through, mut any) = ((f64::INFINITY, None), (f64::INFINITY, None));
        for (index, bone) in skeleton.bones.iter().enumerate() {
            let [a, b] = bone.map(|joint| skeleton.joints[joint as usize]);
            let span = b - a;
            if self.is_stub(*bone, skeleton, target) {
                continue;
            }
            let along = ((self.centre - a).dot(span) / span.length_squared()).clamp(0.0, 1.0);
            let distance = self.centre.distance(a + span * along);
            if distance < any.0 {
                any = (distance, Some(index as u32));
            }
            if distance < through.0 && self.is_through(span) {
                through = (distance, Some(index as u32));
            }
        }
        through.1.filter(|_| through.0 <= any.0 + self.width()).or(any.1)
    }

    /// The bone that meets `bone` at a joint around which the loop lies, goes through the loop as well, and turns less from
    /// source to target; if there is one.
    fn steadier_bone(&self, bone: u32, source: &Skeleton, target: &Skeleton) -> Option<u32> {
        let span = |skeleton: &Skeleton, [a, b]: [u32; 2]| skeleton.joints[b as usize] - skeleton.joints[a as usize];
        let turn = |bone: u32| {
            let [from, to] = [source, target].map(|skeleton| span(skeleton, source.bones[bone as usize]));
            turn::angle_between(from, to).to_degrees()
        };
        let own = source.bones[bone as usize];
        let meets_within = |other: [u32; 2]| {
            let joint = other.into_iter().find(|joint| own.contains(joint));
            joint.is_some_and(|joint| {
                let along = span(source, own);
                let beyond = |p: &DVec3| (*p - source.joints[joint as usize]).dot(along) > 0.0;
                self.points.iter().any(beyond) && !self.points.iter().all(beyond)
            })
        };
        let steadier = |&other: &u32| {
            let ends = source.bones[other as usize];
            other != bone
                && meets_within(ends)
                && self.is_through(span(source, ends))
                && !self.is_stub(ends, source, target)
                && turn(other) + STEADIER < turn(bone)
        };
        let found = (0..source.bones.len() as u32).filter(steadier);
        found.min_by(|&a, &b| turn(a).total_cmp(&turn(b)))
    }

    /// The mean of `bones` in both skeletons, each turned so that it points along the loop's normal.
    fn mean_of(&self, bones: &[u32], source: &Skeleton, target: &Skeleton) -> MovingAxis {
        let mut axis = MovingAxis { start: [DVec3::ZERO; 2], end: [DVec3::ZERO; 2] };
        for &bone in bones {
            let mut joints = source.bones[bone as usize].map(|joint| joint as usize);
            if (source.joints[joints[1]] - source.joints[joints[0]]).dot(self.normal) < 0.0 {
                joints.swap(0, 1);
            }
            for (end, joint) in joints.into_iter().enumerate() {
                axis.start[end] += source.joints[joint] / bones.len() as f64;
                axis.end[end] += target.joints[joint] / bones.len() as f64;
            }
        }
        axis
    }
}
