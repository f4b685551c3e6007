//! A sound garment about parts of a skeleton: a sleeve along one bone or over a bent joint, a skirt about several bones, a
//! tunic with openings for the bones that branch off; 60 to 600 vertices.

use bespoke::geometry::mesh::TriangleMesh;
use bespoke::input::skeleton::Skeleton;
use bespoke::verify::intersections;
use glam::DVec3;

use super::body::{Bodies, size};
use super::skeleton::distance_to_segment;
use super::{below, between, chance};
use crate::Random;

/// A limb outside of the garment keeps this many times its thickness between its bone and the garment.
const ROOM: f64 = 1.5;

/// The centre line along bones that a tube follows, with the bones that it encloses.
struct CentreLine {
    points: Vec<DVec3>,
    bones: Vec<usize>,
    /// Whether the line begins, or ends, at a joint with a single bone.
    leaf: [bool; 2],
    /// Grows along the line as a skirt does.
    flare: f64,
}

/// A garment that is clean and has room.
pub fn around(random: &mut Random, skeleton: &Skeleton, bodies: &Bodies) -> TriangleMesh {
    for attempt in 0..60 {
        let line = match below(random, 4) {
            _ if attempt >= 40 => one_bone(random, skeleton),
            0 => one_bone(random, skeleton),
            1 => skirt(random, skeleton).unwrap_or_else(|| chain(random, skeleton)),
            _ => chain(random, skeleton),
        };
        let mut mesh = tube(random, &line);
        cut_openings(&mut mesh, &line, skeleton, bodies);
        if (40..=600).contains(&mesh.positions.len()) && is_sound(&mesh, &line, skeleton, bodies) {
            return mesh;
        }
    }
    // A cuff in the middle of the longest bone: there always is room for it.
    let length = |b: &[u32; 2]| skeleton.joints[b[0] as usize].distance(skeleton.joints[b[1] as usize]);
    let bones = skeleton.bones.iter().enumerate();
    let (bone, ends) = bones.max_by(|a, b| length(a.1).total_cmp(&length(b.1))).expect("a skeleton has a bone");
    let [a, b] = ends.map(|j| skeleton.joints[j as usize]);
    let points = vec![a.lerp(b, 0.4), a.lerp(b, 0.6)];
    let line = CentreLine { points, bones: vec![bone], leaf: [false; 2], flare: 0.0 };
    rings(&line, 0.05, 12, 5, [false; 2])
}

fn degree(skeleton: &Skeleton, joint: u32) -> usize {
    skeleton.bones.iter().filter(|b| b.contains(&joint)).count()
}

fn one_bone(random: &mut Random, skeleton: &Skeleton) -> CentreLine {
    let bone = below(random, skeleton.bones.len());
    let ends = skeleton.bones[bone];
    let points = ends.map(|j| skeleton.joints[j as usize]).to_vec();
    CentreLine {
        points,
        bones: vec![bone],
        leaf: ends.map(|j| degree(skeleton, j) == 1),
        flare: between(random, -0.2, 0.4),
    }
}

/// From a joint along two to four bones, as they follow each other.
fn chain(random: &mut Random, skeleton: &Skeleton) -> CentreLine {
    let mut bone = below(random, skeleton.bones.len());
    let mut joint = skeleton.bones[bone][below(random, 2)];
    let first = joint;
    let mut line =
        CentreLine { points: vec![skeleton.joints[joint as usize]], bones: Vec::new(), leaf: [false; 2], flare: 0.0 };
    let longest = 2 + below(random, 3);
    loop {
        let [a, b] = skeleton.bones[bone];
        joint = if a == joint { b } else { a };
        line.points.push(skeleton.joints[joint as usize]);
        line.bones.push(bone);
        let onward: Vec<usize> = (0..skeleton.bones.len())
            .filter(|k| !line.bones.contains(k) && skeleton.bones[*k].contains(&joint))
            .collect();
        if onward.is_empty() || line.bones.len() == longest {
            break;
        }
        bone = onward[below(random, onward.len())];
    }
    line.leaf = [first, joint].map(|j| degree(skeleton, j) == 1);
    line.flare = between(random, -0.2, 0.4);
    line
}

/// From a joint along the mean of two or more bones that spread from it.
fn skirt(random: &mut Random, skeleton: &Skeleton) -> Option<CentreLine> {
    let joint = below(random, skeleton.joints.len()) as u32;
    let waist = skeleton.joints[joint as usize];
    let legs: Vec<(usize, DVec3)> = (skeleton.bones.iter().enumerate())
        .filter(|(_, b)| b.contains(&joint))
        .map(|(k, b)| (k, skeleton.joints[(if b[0] == joint { b[1] } else { b[0] }) as usize] - waist))
        .collect();
    let lead = legs.get(below(random, legs.len()))?.1;
    let together: Vec<_> = legs.iter().filter(|(_, leg)| leg.normalize().dot(lead.normalize()) > 0.0).collect();
    if together.len() < 2 {
        return None;
    }
    let axis = together.iter().map(|(_, leg)| leg.normalize()).sum::<DVec3>().normalize();
    let shortest = together.iter().map(|(_, leg)| leg.dot(axis)).fold(f64::INFINITY, f64::min);
    if shortest < 0.2 {
        return None;
    }
    let spread = |leg: &DVec3| (leg - axis * leg.dot(axis)).length() / leg.dot(axis);
    let widest = together.iter().map(|(_, leg)| spread(leg)).fold(0.0, f64::max);
    let points = vec![waist - 0.15 * axis, waist + axis * between(random, 0.5, 0.8) * shortest];
    Some(CentreLine {
        points,
        bones: together.iter().map(|(k, _)| *k).collect(),
        leaf: [false; 2],
        flare: 10.0 * widest,
    })
}

fn tube(random: &mut Random, line: &CentreLine) -> TriangleMesh {
    let length: f64 = line.points.windows(2).map(|w| w[0].distance(w[1])).sum();
    let skirt = line.flare > 1.0;
    let mut from = if skirt || line.leaf[0] { 0.0 } else { between(random, 0.05, 0.4) };
    let mut to = if skirt { 1.0 } else { between(random, 0.55, 0.95) };
    let radius = between(random, 0.06, 0.22).min(0.4 * length);
    let mut capped = [false; 2];
    for end in 0..2 {
        if line.leaf[end] && chance(random, 0.35) {
            capped[end] = true;
            // Beyond the end of the bone, and of the body around it.
            *[&mut from, &mut to][end] = if end == 0 { -0.3 / length } else { 1.0 + 0.3 / length };
        }
    }
    if line.leaf[0] && !capped[0] {
        from = between(random, 0.05, 0.4);
    }
    let sides = 8 + below(random, 17);
    let count = between(random, 60.0, 560.0) as usize / sides;
    let points = [from, to].map(|s| s * length);
    let trimmed = CentreLine { points: trim(&line.points, points), bones: line.bones.clone(), ..*line };
    rings(&trimmed, radius, sides, count.clamp(4, 30), capped)
}

/// The part of a polyline between two arc lengths, which may be beyond its ends.
fn trim(points: &[DVec3], [from, to]: [f64; 2]) -> Vec<DVec3> {
    let mut out = vec![at(points, from)];
    let mut length = 0.0;
    for w in points.windows(2) {
        length += w[0].distance(w[1]);
        if length > from + 1e-6 && length < to - 1e-6 {
            out.push(w[1]);
        }
    }
    out.push(at(points, to));
    out
}

/// The place at an arc length; its first and last pieces go on beyond its ends.
fn at(points: &[DVec3], mut arc: f64) -> DVec3 {
    let last = points.len() - 2;
    for (k, w) in points.windows(2).enumerate() {
        let length = w[0].distance(w[1]);
        if arc <= length || k == last {
            return w[0] + (w[1] - w[0]) * (arc / length);
        }
        arc -= length;
    }
    points[0]
}

/// Rings of vertices around the line, rounded at its corners; caps of two narrower rings and a tip.
fn rings(line: &CentreLine, radius: f64, sides: usize, count: usize, capped: [bool; 2]) -> TriangleMesh {
    let length: f64 = line.points.windows(2).map(|w| w[0].distance(w[1])).sum();
    let smooth = 1.2 * radius;
    let centre = |arc: f64| (-3..=3).map(|k| at(&line.points, arc + smooth * f64::from(k) / 3.0)).sum::<DVec3>() / 7.0;
    let flare = |share: f64| {
        if line.flare > 1.0 {
            radius + 1.2 * line.flare / 10.0 * share * length
        } else {
            radius * (1.0 + line.flare * share)
        }
    };
    // Arc, and radius as a share of the tube's there.
    let mut stations: Vec<(f64, f64)> = (0..count).map(|k| (k as f64 / (count - 1) as f64 * length, 1.0)).collect();
    if capped[0] {
        stations.splice(0..0, [(-0.8 * radius, 0.5), (-0.5 * radius, 0.85)]);
    }
    if capped[1] {
        stations.extend([(length + 0.5 * radius, 0.85), (length + 0.8 * radius, 0.5)]);
    }
    let mut mesh = TriangleMesh::default();
    let mut u = DVec3::ZERO;
    for &(arc, share) in &stations {
        let tangent = (centre(arc + 0.01 * length) - centre(arc - 0.01 * length)).normalize();
        let carried = u - tangent * u.dot(tangent);
        u = if carried.length() > 0.1 { carried.normalize() } else { tangent.any_orthonormal_vector() };
        let v = tangent.cross(u);
        for s in 0..sides {
            let angle = std::f64::consts::TAU * s as f64 / sides as f64;
            let out = angle.cos() * u + angle.sin() * v;
            mesh.positions.push(centre(arc) + out * share * flare((arc / length).clamp(0.0, 1.0)));
        }
    }
    let n = sides as u32;
    let rings = stations.len() as u32;
    for k in 0..rings - 1 {
        for s in 0..n {
            let [p, q] = [s, (s + 1) % n].map(|s| k * n + s);
            // The diagonals alternate, as those of a quad mesh that was cut without thought.
            if (k + s) % 2 == 0 {
                mesh.triangles.extend([[p, q, q + n], [p, q + n, p + n]]);
            } else {
                mesh.triangles.extend([[p, q, p + n], [q, q + n, p + n]]);
            }
        }
    }
    for (end, ring, beyond) in [(0, 0, -radius), (1, (rings - 1) * n, length + radius)] {
        if !capped[end] {
            continue;
        }
        let tip = mesh.positions.len() as u32;
        mesh.positions.push(centre(beyond));
        for s in 0..n {
            let [p, q] = [ring + s, ring + (s + 1) % n];
            mesh.triangles.push(if end == 0 { [q, p, tip] } else { [p, q, tip] });
        }
    }
    mesh
}

/// Removes the triangles about the bones that leave the tube, and all but the largest piece of the rest.
fn cut_openings(mesh: &mut TriangleMesh, line: &CentreLine, skeleton: &Skeleton, bodies: &Bodies) {
    let near = |p: DVec3| nearby_limb(p, line, skeleton, bodies).is_some();
    mesh.triangles.retain(|t| !t.iter().any(|&v| near(mesh.positions[v as usize])));
    keep_largest_piece(mesh);
}

/// A bone that the garment is not around, and that is too near to `p`.
fn nearby_limb(p: DVec3, line: &CentreLine, skeleton: &Skeleton, bodies: &Bodies) -> Option<usize> {
    (0..skeleton.bones.len()).filter(|k| !line.bones.contains(k)).find(|&k| {
        let [a, b] = skeleton.bones[k].map(|j| skeleton.joints[j as usize]);
        distance_to_segment(p, a, b) < ROOM * bodies.source_radii[k]
    })
}

fn keep_largest_piece(mesh: &mut TriangleMesh) {
    let mut piece: Vec<u32> = (0..mesh.positions.len() as u32).collect();
    let mut changed = true;
    while changed {
        changed = false;
        for t in &mesh.triangles {
            let lowest = t.iter().map(|&v| piece[v as usize]).min().unwrap_or(0);
            for &v in t {
                changed |= std::mem::replace(&mut piece[v as usize], lowest) != lowest;
            }
        }
    }
    let count = |name: u32| mesh.triangles.iter().filter(|t| piece[t[0] as usize] == name).count();
    let largest = (0..mesh.positions.len() as u32).filter(|&v| piece[v as usize] == v).max_by_key(|&v| count(v));
    mesh.triangles.retain(|t| Some(piece[t[0] as usize]) == largest);
    compact(mesh);
}

/// Drops the vertices that no triangle uses.
fn compact(mesh: &mut TriangleMesh) {
    let mut number = vec![u32::MAX; mesh.positions.len()];
    let mut kept = Vec::new();
    for t in &mut mesh.triangles {
        for v in t {
            let slot = &mut number[*v as usize];
            if *slot == u32::MAX {
                *slot = kept.len() as u32;
                kept.push(mesh.positions[*v as usize]);
            }
            *v = *slot;
        }
    }
    mesh.positions = kept;
}

/// Clean, clear of the skeleton's line and of what lies beyond its leaves, and with room for the limbs outside of it.
fn is_sound(mesh: &TriangleMesh, line: &CentreLine, skeleton: &Skeleton, bodies: &Bodies) -> bool {
    let mut lines = TriangleMesh::default();
    for (k, bone) in skeleton.bones.iter().enumerate() {
        let [a, b] = bone.map(|j| skeleton.joints[j as usize]);
        let beyond = (b - a).normalize() * 1.8 * bodies.source_radii[k];
        let [before, after] = bone.map(|j| if degree(skeleton, j) == 1 { 1.0 } else { 0.0 });
        let first = lines.positions.len() as u32;
        lines.positions.extend([a - before * beyond, b + after * beyond]);
        lines.triangles.push([first, first + 1, first + 1]);
    }
    let clear = |other: Option<&TriangleMesh>| intersections(mesh, other, 0).is_ok_and(|found| found.count == 0);
    let far = |p: &DVec3| {
        (lines.triangles.iter())
            .all(|t| distance_to_segment(*p, lines.positions[t[0] as usize], lines.positions[t[1] as usize]) > 0.02)
    };
    mesh.positions.iter().all(far)
        && mesh.positions.iter().all(|&p| nearby_limb(p, line, skeleton, bodies).is_none())
        && clear(None)
        && clear(Some(&lines))
        && size(skeleton) > 0.0
}
