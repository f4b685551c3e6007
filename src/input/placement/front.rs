//! Front and back of two bodies: whether they are on the same side of their joints.
//!
//! A skeleton in an open pose is flat: seen from behind, left and right are exchanged and nothing else is. But feet reach
//! forward of their ankles, a face and a belly of their bones, knees bend forward and elbows back. So the displacement of
//! the surface from each bone, and of each middle joint from the line between its neighbours, is compared along the third
//! direction, that across the flat skeleton. Where rigs tell which way the feet point, that decides: a hunched back or a cape
//! says otherwise more often than feet do.

use glam::DVec3;

use super::alignment::{normalisation, normalised};
use super::mirror::MirrorPairs;
use super::scene::Scene;
use crate::geometry::mesh::{TriangleMesh, neighbours, triangle_area};
use crate::input::coordinate_system::AxisTurn;
use crate::input::skeleton::{BoneGraph, Skeleton};
use crate::input::skin::SkinWeights;
use crate::maths;

/// From here on in size the comparison says something.
pub const LIKELY: f64 = 0.2;
/// From here on it is sure.
pub const SURE: f64 = 0.4;

/// Feet that point forward or back by less than this, as a cosine, as those of a dancer on her toes, say nothing.
const LEAST_FORWARD: f64 = 0.5;
/// Bends of the limbs below this, as a share of the limb's length, say nothing.
const LEAST_BEND: f64 = 0.02;
/// Triangles of a body that are looked at, at most, and how many times a bone for skeletons of many bones.
const MOST_TRIANGLES: usize = 4000;
const MOST_PAIRS: usize = 200_000;

/// The comparison of two bodies.
pub struct Front;

impl Front {
    /// How much front and back of the two bodies agree once the target has been turned by `turn`: above 0 where they do,
    /// below where they are exchanged, 0 where nothing can be said. The sum of two correlations.
    pub fn compare(scene: &Scene<'_>, pairs: &MirrorPairs, turn: AxisTurn) -> f64 {
        let bones = &scene.source_skeleton.bones;
        let source = Skeleton { joints: normalised(&scene.source_skeleton.joints), bones: bones.clone() };
        let joints = scene.target_skeleton.joints.iter().map(|&p| turn.apply(p)).collect::<Vec<_>>();
        let target = Skeleton { joints: normalised(&joints), bones: bones.clone() };
        let across = third_direction(&source.joints, pairs.normal);
        if let Some([own, others]) = scene.feet {
            let forward = [own, turn.apply(others)].map(|foot| foot.normalize_or_zero().dot(across));
            if forward.iter().all(|forward| forward.abs() >= LEAST_FORWARD) {
                return 2.0 * forward[0] * forward[1];
            }
        }
        let bends = correlation(&bends(&source, across), &bends(&target, across));
        let Some(body) = scene.source_avatar else { return bends };
        let of_source = displacements(&placed(body, scene.source_skeleton, AxisTurn::IDENTITY), &source, None, across);
        let of_target = displacements(&placed(scene.avatar, scene.target_skeleton, turn), &target, scene.skin, across);
        bends + weighted_correlation(&of_source, &of_target)
    }
}

/// Whether the target avatar's triangles face inwards where the source avatar's face outwards, or the other way round, as
/// those of a mirrored mesh do.
pub fn is_turned_inside_out(scene: &Scene<'_>) -> bool {
    let is_inward = |mesh: &TriangleMesh| mesh.signed_volume() < 0.0;
    is_inward(scene.avatar) != scene.source_avatar.is_some_and(is_inward)
}

/// Across a body: perpendicular to the line from left to right, and to the longest extent of what is left.
fn third_direction(joints: &[DVec3], sideways: DVec3) -> DVec3 {
    let e = sideways.any_orthonormal_vector();
    let f = sideways.cross(e);
    let mean = joints.iter().sum::<DVec3>() / joints.len().max(1) as f64;
    let (mut ee, mut ef, mut ff) = (0.0, 0.0, 0.0);
    for &p in joints {
        let (x, y) = ((p - mean).dot(e), (p - mean).dot(f));
        (ee, ef, ff) = (ee + x * x, ef + x * y, ff + y * y);
    }
    // The direction of largest spread in the plane, turned by a right angle.
    let angle = 0.5 * maths::atan2(2.0 * ef, ee - ff);
    f * maths::cos(angle) - e * maths::sin(angle)
}

/// The mesh in the space in which its skeleton is normalised.
fn placed(mesh: &TriangleMesh, skeleton: &Skeleton, turn: AxisTurn) -> TriangleMesh {
    let (mean, scale) = normalisation(&skeleton.joints);
    TriangleMesh {
        positions: mesh.positions.iter().map(|&p| turn.apply(p - mean) * scale).collect(),
        triangles: mesh.triangles.clone(),
    }
}

/// For each joint between two bones, how far it is off the line between their other ends, along `across`, as a share of
/// the length of that line.
fn bends(skeleton: &Skeleton, across: DVec3) -> Vec<f64> {
    let neighbours = neighbours(skeleton.joints.len(), &skeleton.bones);
    let middle = neighbours.iter().zip(&skeleton.joints).filter(|(n, _)| n.len() == 2);
    middle
        .map(|(ends, &p)| {
            let [a, b] = [ends[0], ends[1]].map(|j| skeleton.joints[j as usize]);
            let along = b - a;
            let square = along.length_squared();
            if square == 0.0 {
                return 0.0;
            }
            let aside = p - a - along * ((p - a).dot(along) / square);
            aside.dot(across) / square.sqrt()
        })
        .collect()
}

/// The cosine between two lists; 0 where one of them is as good as nothing.
fn correlation(a: &[f64], b: &[f64]) -> f64 {
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(x, y)| x * y).sum::<f64>();
    let (aa, bb) = (dot(a, a), dot(b, b));
    let least = LEAST_BEND * LEAST_BEND * a.len().max(1) as f64;
    if aa < least || bb < least { 0.0 } else { dot(a, b) / (aa * bb).sqrt() }
}

/// For each bone the mean displacement of the surface around it along `across`, and its share of the surface.
fn displacements(mesh: &TriangleMesh, skeleton: &Skeleton, skin: Option<&SkinWeights>, across: DVec3) -> Vec<[f64; 2]> {
    let graph = BoneGraph::new(skeleton);
    let most = (MOST_PAIRS / skeleton.bones.len().max(1)).clamp(1, MOST_TRIANGLES);
    let mut sums = vec![[0.0, 0.0]; skeleton.bones.len()];
    for triangle in mesh.triangles.iter().step_by(mesh.triangles.len().div_ceil(most).max(1)) {
        let corners = triangle.map(|v| mesh.positions[v as usize]);
        let p = corners.iter().sum::<DVec3>() / 3.0;
        let joint = skin.and_then(|skin| skin.dominant_joint(triangle[0] as usize));
        let on_bones = skeleton.bones.iter().zip(0_u32..).filter(|(b, _)| joint.is_none_or(|j| b.contains(&j)));
        let nearest = on_bones
            .map(|(_, bone)| (bone, skeleton.point_at(bone, graph.project(skeleton, bone, p))))
            .min_by(|a, b| a.1.distance_squared(p).total_cmp(&b.1.distance_squared(p)));
        if let Some((bone, on_bone)) = nearest {
            let area = triangle_area(corners);
            sums[bone as usize][0] += area * (p - on_bone).dot(across);
            sums[bone as usize][1] += area;
        }
    }
    let whole: f64 = sums.iter().map(|s| s[1]).sum();
    sums.iter().map(|s| [s[0] / s[1].max(f64::MIN_POSITIVE), s[1] / whole.max(f64::MIN_POSITIVE)]).collect()
}

/// The cosine between two lists of displacements; a bone counts by its smaller share of the two surfaces.
fn weighted_correlation(a: &[[f64; 2]], b: &[[f64; 2]]) -> f64 {
    let (mut aa, mut ab, mut bb) = (0.0, 0.0, 0.0);
    for (a, b) in a.iter().zip(b) {
        let weight = a[1].min(b[1]);
        (aa, ab, bb) = (aa + weight * a[0] * a[0], ab + weight * a[0] * b[0], bb + weight * b[0] * b[0]);
    }
    if aa * bb > 0.0 { ab / (aa * bb).sqrt() } else { 0.0 }
}
