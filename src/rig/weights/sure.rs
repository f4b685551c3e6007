//! Which weights are sure: those of garment vertices near the body, where both surfaces run alike. And how sure: the nearer
//! the body, the more.

use glam::DVec3;
use rayon::prelude::*;

use super::TransferOptions;
use crate::control::{Cancel, Cancelled};
use crate::error::{Error, ErrorKind, Result};
use crate::geometry::closest_point::{Closest, ClosestPoint, barycentric};
use crate::geometry::mesh::{NO_PIECE, TriangleMesh, label_pieces};
use crate::input::skin::SkinWeights;
use crate::maths;

/// Vertices of one task. Fixed, so that the work is the same for any number of threads.
const CHUNK: usize = 256;

/// What lies nearer to the body than this share of the diagonal of its bounding box lies on it, and has its weights
/// whichever way it runs.
const ON_THE_BODY: f64 = 1e-4;

/// The weights of the closest points of a body.
#[derive(Clone, Debug, PartialEq)]
pub struct Sure {
    /// Those of the closest point, for every vertex of the garment: of sum 1.
    pub weights: SkinWeights,
    /// How much each vertex is drawn to them, for a unit of area, in lengths of [`Self::size`]: 0 where they are not sure,
    /// infinite where they are held. In each connected piece of the garment one vertex at least has more than 0.
    pub pulls: Vec<f64>,
    /// The unit of length: the diagonal of the bounding box of the body.
    pub size: f64,
}

/// What the closest point of the body says to a garment vertex.
struct Match {
    distance: f64,
    is_sure: bool,
    weights: Vec<(u32, f64)>,
}

/// The weights of the closest points, and which of them are sure. In a piece of the garment that is nowhere near enough,
/// those of its nearest part are; vertices without a triangle are always.
///
/// # Errors
/// [`ErrorKind::InvalidWeights`] where no triangle of the body has weights, [`ErrorKind::Cancelled`].
pub fn sure_weights(
    garment: &TriangleMesh,
    body: &TriangleMesh,
    skin: &SkinWeights,
    options: &TransferOptions,
    cancel: &Cancel,
) -> Result<Sure> {
    let weighted = |t: &&[u32; 3]| t.iter().any(|&v| !skin.weights(v as usize).is_empty());
    let triangles: Vec<[u32; 3]> = body.triangles.iter().filter(weighted).copied().collect();
    if triangles.is_empty() {
        let message = "no triangle of the body has skin weights, so that the garment gets none from it";
        return Err(Error::new(ErrorKind::InvalidWeights, message));
    }
    let size = unit(triangles.iter().flatten().map(|&v| body.positions[v as usize]));
    let body =
        Body { normals: vertex_normals(&body.positions, &triangles), positions: &body.positions, triangles, skin };
    let tree =
        ClosestPoint::new(&TriangleMesh { positions: body.positions.to_vec(), triangles: body.triangles.clone() });
    let normals = vertex_normals(&garment.positions, &garment.triangles);
    let (near, least_cosine) = (options.nearness * size, maths::cos(options.normal_angle.to_radians()));

    let matches: Result<Vec<Vec<Match>>, Cancelled> = garment
        .positions
        .par_chunks(CHUNK)
        .zip(normals.par_chunks(CHUNK))
        .map(|(positions, normals)| {
            cancel.check()?;
            let of = |(&p, normal): (&DVec3, &DVec3)| {
                let closest = tree.closest(p)?;
                let (agrees, weights) = body.at(&closest, *normal, least_cosine);
                let is_sure = closest.distance <= ON_THE_BODY * size || (closest.distance <= near && agrees);
                Some(Match { distance: closest.distance, is_sure, weights })
            };
            Ok(positions.iter().zip(normals).filter_map(of).collect())
        })
        .collect();
    let matches: Vec<Match> = matches?.into_iter().flatten().collect();
    let is_sure = with_nearest_parts(garment, &matches, near);
    // A bilaplacian of weight 1 smooths over a length l where data has weight 1 / l^4.
    let pull = |(m, is_sure): (&Match, &bool)| match options.smoothing * m.distance / size {
        _ if !is_sure => 0.0,
        length if length <= ON_THE_BODY => f64::INFINITY,
        length => length.powi(-4),
    };
    let pulls = matches.iter().zip(&is_sure).map(pull).collect();
    let weights = SkinWeights::from_rows(skin.joint_count(), matches.into_iter().map(|m| m.weights));
    Ok(Sure { weights, pulls, size })
}

/// The part of the body that has weights.
struct Body<'a> {
    positions: &'a [DVec3],
    triangles: Vec<[u32; 3]>,
    normals: Vec<DVec3>,
    skin: &'a SkinWeights,
}

impl Body<'_> {
    /// Whether the body's normal at a closest point agrees with `normal`, and the weights there.
    fn at(&self, closest: &Closest, normal: DVec3, least_cosine: f64) -> (bool, Vec<(u32, f64)>) {
        let triangle = self.triangles[closest.triangle as usize];
        let shares = barycentric(closest.point, triangle.map(|v| self.positions[v as usize]));
        // The normal of the triangle counts as well: those of vertices are none where triangles face both ways.
        let smooth: DVec3 = triangle.iter().zip(shares).map(|(&v, share)| share * self.normals[v as usize]).sum();
        let agrees = |n: DVec3| normal.dot(n.normalize_or_zero()).abs() >= least_cosine;
        let shares = self.weighted_shares(triangle, shares);
        let mut own = Vec::new();
        for (&v, share) in triangle.iter().zip(shares).filter(|(_, share)| *share > 0.0) {
            let weights = self.skin.weights(v as usize);
            // Those of one vertex need not sum to 1.
            let sum: f64 = weights.iter().map(|&(_, weight)| weight).sum();
            own.extend(weights.iter().map(|&(joint, weight)| (joint, share * (weight / sum))));
        }
        own.retain(|&(_, weight)| weight > 0.0);
        (agrees(smooth) || agrees(closest.normal), own)
    }

    /// Shares of the corners of a triangle without those that have no weights: of sum 1. Where only those had any, the other
    /// corners have equal ones.
    fn weighted_shares(&self, triangle: [u32; 3], shares: [f64; 3]) -> [f64; 3] {
        let has = triangle.map(|v| !self.skin.weights(v as usize).is_empty());
        let sum_of = |shares: [f64; 3]| (0..3).filter(|&k| has[k]).map(|k| shares[k]).sum::<f64>();
        let shares = if sum_of(shares) > 1e-9 { shares } else { [1.0; 3] };
        let sum = sum_of(shares);
        std::array::from_fn(|k| if has[k] { shares[k] / sum } else { 0.0 })
    }
}

/// Which matches are sure; in a piece without any, those that are hardly farther from the body than its nearest vertex.
fn with_nearest_parts(garment: &TriangleMesh, matches: &[Match], near: f64) -> Vec<bool> {
    // A triangle that repeats an index takes no part in the Laplacian either.
    let proper = |t: &&[u32; 3]| t[0] != t[1] && t[1] != t[2] && t[2] != t[0];
    let sides = garment.triangles.iter().filter(proper).flat_map(|&[a, b, c]| [[a, b], [b, c]]);
    let (labels, count) = label_pieces(matches.len(), sides);
    let mut nearest = vec![f64::INFINITY; count];
    for (m, &label) in matches.iter().zip(&labels).filter(|(_, label)| **label != NO_PIECE) {
        let least = &mut nearest[label as usize];
        *least = least.min(if m.is_sure { f64::NEG_INFINITY } else { m.distance });
    }
    let of = |(m, &label): (&Match, &u32)| {
        m.is_sure || label == NO_PIECE || m.distance <= nearest[label as usize] + 0.25 * near
    };
    matches.iter().zip(&labels).map(of).collect()
}

/// The normals of vertices: the mean of those of their triangles, by area; zero where there is none.
fn vertex_normals(positions: &[DVec3], triangles: &[[u32; 3]]) -> Vec<DVec3> {
    let mut normals = vec![DVec3::ZERO; positions.len()];
    for &t in triangles {
        let [a, b, c] = t.map(|v| positions[v as usize]);
        let normal = (b - a).cross(c - a);
        t.iter().for_each(|&v| normals[v as usize] += normal);
    }
    normals.into_iter().map(|n| n.normalize_or_zero()).collect()
}

/// The diagonal of the bounding box of points; 1 where they are in one place.
fn unit(points: impl Iterator<Item = DVec3>) -> f64 {
    let (low, high) = points.fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(l, h), p| (l.min(p), h.max(p)));
    let diagonal = (high - low).length();
    if diagonal > 0.0 { diagonal } else { 1.0 }
}
