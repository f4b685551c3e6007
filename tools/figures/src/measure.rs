//! What is measured on dressed bodies: heights of openings, clearance at the waist, the V of a neckline.

use bespoke::geometry::closest_point::ClosestPoint;
use bespoke::geometry::mesh::{Topology, TriangleMesh};
use glam::DVec3;

use crate::figure::Outcome;
use closet::Sample;
use closet::mesh::Mesh;
use closet::skeleton::{ARMS, NECK, ROOT, WAIST};
use gallery::pair;

/// A boundary loop whose mean is nearer than this to the middle of the body, in metres, is around it.
const MIDDLE: f64 = 0.03;

/// Vertices so far above and below the waist joint, in metres, are at the waist.
const WAISTBAND: f64 = 0.04;

/// Collar and hem: the highest and the lowest of the boundary loops around the middle, as vertices in order.
pub fn middle_loops(mesh: &Mesh) -> Outcome<[Vec<u32>; 2]> {
    let mean = |curve: &[u32]| curve.iter().map(|&v| mesh.positions[v as usize]).sum::<DVec3>() / curve.len() as f64;
    let loops = Topology::new(mesh.positions.len(), &mesh.triangles).loops;
    let mut middle: Vec<(f64, Vec<u32>)> = loops
        .into_iter()
        .map(|curve| (mean(&curve.vertices), curve.vertices))
        .filter(|(centre, _)| centre.x.abs() < MIDDLE)
        .map(|(centre, vertices)| (centre.z, vertices))
        .collect();
    middle.sort_by(|a, b| a.0.total_cmp(&b.0));
    match (middle.pop(), middle.into_iter().next()) {
        (Some((_, collar)), Some((_, hem))) => Ok([collar, hem]),
        _ => Err("the garment has no collar and hem around the middle of the body".into()),
    }
}

/// The mean height of a loop, in metres.
pub fn loop_height(x: &[DVec3], curve: &[u32]) -> f64 {
    curve.iter().map(|&v| x[v as usize].z).sum::<f64>() / curve.len() as f64
}

/// The mean distance from `body` of the garment's vertices around its waist, in metres.
pub fn waist_clearance(garment: &TriangleMesh, body: &Sample) -> f64 {
    let skin = ClosestPoint::new(&pair::mesh(&body.mesh));
    let (waist, shoulder) = (body.skeleton.joints[WAIST].z, body.skeleton.joints[ARMS[0][0]].x);
    let at_waist = |p: &&DVec3| (p.z - waist).abs() < WAISTBAND && p.x.abs() < 0.8 * shoulder;
    let distances: Vec<f64> = garment.positions.iter().filter(at_waist).map(|&p| skin.distance(p)).collect();
    distances.iter().sum::<f64>() / distances.len().max(1) as f64
}

/// The mean distance from `body` of a garment's surface, in metres.
pub fn mean_clearance(garment: &TriangleMesh, body: &Sample) -> f64 {
    mean_distance(garment, &ClosestPoint::new(&pair::mesh(&body.mesh)))
}

/// The mean distance of a garment's surface from that of `skin`.
pub fn mean_distance(garment: &TriangleMesh, skin: &ClosestPoint) -> f64 {
    let areas = garment.areas();
    let sum: f64 = (0..).zip(&areas).map(|(t, area)| area * skin.distance(garment.centre(t))).sum();
    sum / areas.iter().sum::<f64>()
}

/// The radius of a body's trunk around its waist, in metres: the mean of what is seen across the spine, without the farthest
/// quarter, for a tail is no part of it.
pub fn waist_radius(body: &Sample) -> f64 {
    const RAYS: u32 = 64;
    let joints = body.skeleton.joints;
    let skin = ClosestPoint::new(&pair::mesh(&body.mesh));
    let radius = |(from, to, along): (usize, usize, f64)| {
        let (u, v) = (joints[to] - joints[from]).normalize().any_orthonormal_pair();
        let seen = |k: u32| {
            let (sin, cos) = (std::f64::consts::TAU * f64::from(k) / f64::from(RAYS)).sin_cos();
            skin.first_hit(joints[from].lerp(joints[to], along), cos * u + sin * v)
        };
        let mut lengths: Vec<f64> = (0..RAYS).filter_map(seen).collect();
        lengths.sort_by(f64::total_cmp);
        lengths.truncate(lengths.len() * 3 / 4);
        lengths.iter().sum::<f64>() / lengths.len().max(1) as f64
    };
    let places = [(ROOT, WAIST, 0.7), (ROOT, WAIST, 1.0), (WAIST, NECK, 0.0), (WAIST, NECK, 0.1)];
    places.map(radius).iter().sum::<f64>() / places.len() as f64
}

/// The two sides of a V, from its point upwards.
pub struct Neckline {
    sides: [Vec<usize>; 2],
}

/// How a V looks.
pub struct NecklineShape {
    /// Between its sides as seen from the front, in degrees.
    pub angle: f64,
    /// The same of the quarter of its sides next to its point.
    pub at_point: f64,
    /// The farthest of its vertices from the straight line through its side, for the length of that: the mean of both.
    pub bend: f64,
}

impl Neckline {
    /// The V at the collar of `mesh`, as it is designed: the lowest point of the loop, and from there on either side up to two
    /// thirds of the height of its front.
    pub fn of(mesh: &Mesh) -> Outcome<Self> {
        let [collar, _] = middle_loops(mesh)?;
        let at = |k: usize| mesh.positions[collar[k % collar.len()] as usize];
        let point = (0..collar.len()).min_by(|&a, &b| at(a).z.total_cmp(&at(b).z)).unwrap_or(0);
        let top = (0..collar.len()).map(|k| at(k).z).fold(f64::MIN, f64::max);
        let end = at(point).z + (top - at(point).z) * 2.0 / 3.0;
        let side = |step: usize| -> Vec<usize> {
            let walked = (1..collar.len()).map(|k| point + k * step).take_while(|&k| at(k).z < end);
            walked.map(|k| collar[k % collar.len()] as usize).collect()
        };
        // A step back around the loop is one forwards of all but one.
        let sides = [side(1), side(collar.len() - 1)];
        if sides.iter().any(|side| side.len() < 4) {
            return Err("the garment's collar is no V: a side of it has fewer than four vertices".into());
        }
        Ok(Self { sides })
    }

    /// How it looks where the garment's vertices are `x`.
    pub fn shape(&self, x: &[DVec3]) -> NecklineShape {
        let lines = |share: usize| {
            self.sides.each_ref().map(|side| {
                // As it is seen from the front.
                let next = side.iter().take((side.len() / share).max(3));
                line(&next.map(|&v| x[v].with_y(0.0)).collect::<Vec<_>>())
            })
        };
        let between = |[left, right]: [(DVec3, f64); 2]| left.0.angle_between(right.0).to_degrees();
        let [left, right] = lines(1);
        NecklineShape { angle: between([left, right]), at_point: between(lines(4)), bend: 0.5 * (left.1 + right.1) }
    }
}

/// The direction of the line nearest to `points`, which go along it, and how far they are from it at most for its length.
fn line(points: &[DVec3]) -> (DVec3, f64) {
    let centre = points.iter().sum::<DVec3>() / points.len() as f64;
    // Power iteration from the way between the ends: the rest is small beside it.
    let mut direction = points[points.len() - 1] - points[0];
    let length = direction.length();
    for _ in 0..50 {
        direction =
            points.iter().map(|&p| (p - centre) * (p - centre).dot(direction)).sum::<DVec3>().normalize_or_zero();
    }
    let away = |p: &DVec3| (*p - centre).reject_from(direction).length();
    (direction, points.iter().map(away).fold(0.0, f64::max) / length)
}
