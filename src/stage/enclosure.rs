//! Whether the garment is around the source skeleton, so that the shrunk avatar is inside it.

use glam::DVec3;
use rayon::prelude::*;

use super::initialize::ProjectedAvatar;
use crate::error::{Error, ErrorKind, Result};
use crate::input::mesh::TriangleMesh;
use crate::input::skeleton::{BoneGraph, Skeleton};
use crate::verify::intersections;

/// Garment vertices whose nearest places on the skeleton are looked at.
const PLACES: usize = 64;
/// Directions looked into from each place, evenly around the bone.
const DIRECTIONS: usize = 8;
/// A garment that fills fewer of them at every place lies beside its skeleton. Half, so that a cape still passes.
const AROUND: usize = 4;

/// Refuses a garment that lies beside the skeleton, or through which the avatar pokes where it is shrunk onto it.
///
/// # Errors
/// `NotEnclosed`, naming bone and triangles.
pub fn check(garment: &TriangleMesh, projected: &ProjectedAvatar, source: &Skeleton) -> Result<()> {
    check_crossings(garment, projected, source)?;
    let graph = BoneGraph::new(source);
    let corners: Vec<u32> = garment.triangles.iter().flatten().copied().collect();
    let around = corners
        .par_iter()
        .step_by(corners.len().div_ceil(PLACES).max(1))
        .any(|&v| directions_filled(garment, &graph, source, garment.positions[v as usize]) >= AROUND);
    if around {
        return Ok(());
    }
    Err(Error::new(
        ErrorKind::NotEnclosed,
        "garment: it lies beside the source skeleton and is around none of its bones; move one onto the other, and make \
         sure that both are in one space and unit",
    ))
}

/// In how many directions around the bone a look from the place on the skeleton nearest to `p` meets the garment.
fn directions_filled(garment: &TriangleMesh, graph: &BoneGraph, source: &Skeleton, p: DVec3) -> usize {
    let places = (0..source.bones.len() as u32).map(|bone| {
        let place = source.point_at(bone, graph.project(source, bone, p));
        (place.distance_squared(p), place, bone)
    });
    let Some((_, place, bone)) = places.min_by(|a, b| a.0.total_cmp(&b.0)) else { return 0 };
    let [a, b] = source.bones[bone as usize].map(|j| source.joints[j as usize]);
    let (u, v) = (b - a).try_normalize().unwrap_or(DVec3::Z).any_orthonormal_pair();
    (0..DIRECTIONS)
        .filter(|&k| {
            let angle = std::f64::consts::TAU * k as f64 / DIRECTIONS as f64;
            let direction = angle.cos() * u + angle.sin() * v;
            garment.triangles.iter().any(|t| ray_meets(place, direction, t.map(|v| garment.positions[v as usize])))
        })
        .count()
}

/// Whether the ray from `origin` meets the triangle (Möller and Trumbore 1997).
fn ray_meets(origin: DVec3, direction: DVec3, [a, b, c]: [DVec3; 3]) -> bool {
    let (e1, e2) = (b - a, c - a);
    let p = direction.cross(e2);
    let determinant = e1.dot(p);
    if determinant == 0.0 {
        return false;
    }
    let from = origin - a;
    let q = from.cross(e1);
    let (s, t) = (from.dot(p) / determinant, direction.dot(q) / determinant);
    s >= 0.0 && t >= 0.0 && s + t <= 1.0 && e2.dot(q) / determinant > 0.0
}

/// Where the shrunk avatar meets the garment, Step 2 cannot begin.
fn check_crossings(garment: &TriangleMesh, projected: &ProjectedAvatar, source: &Skeleton) -> Result<()> {
    let shrunk = TriangleMesh { positions: projected.start.clone(), triangles: projected.triangles.clone() };
    let found = intersections(garment, Some(&shrunk), usize::MAX)?;
    let Some(&[_, piece]) = found.pairs.first() else { return Ok(()) };
    let place = match projected.bones[piece as usize] {
        Some(bone) => {
            let [a, b] = source.bones[bone as usize];
            format!("at the bone between joints {a} and {b}")
        }
        None => "between bones that form a cycle".to_string(),
    };
    let mut triangles: Vec<u32> = found.pairs.iter().map(|p| p[0]).collect();
    triangles.sort_unstable();
    triangles.dedup();
    let count = triangles.len();
    let named: Vec<String> = triangles.iter().take(8).map(u32::to_string).collect();
    Err(Error::new(
        ErrorKind::NotEnclosed,
        format!(
            "garment: the avatar, shrunk onto the source skeleton, pokes through it {place}: through garment triangles \
             {}{} ({count} in all); move the garment or the skeleton so that the garment is around its bones",
            named.join(", "),
            if count > named.len() { ", ..." } else { "" },
        ),
    ))
}
