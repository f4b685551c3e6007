//! The verifier: counts intersecting pairs of triangles exactly. It uses none of the contact code; the same exact predicates
//! decide which triangles intersected at the start.
//!
//! Triangles are closed, so touching counts. Every decision is the sign of a determinant of the coordinates as
//! stored, taken with exact predicates. These are exact unless a product of coordinates underflows; both meshes are
//! therefore scaled by one common power of two (exactly) to the upper part of the range of doubles, where that
//! happens only when two coordinates that matter differ in size by more than about 1e166.

mod boxes;
mod triangles;

use glam::DVec3;
use rayon::prelude::*;

use crate::control::{Cancel, Cancelled};
use crate::error::{Error, ErrorKind, Result};
use crate::geometry::mesh::TriangleMesh;
use boxes::{Aabb, Tree};

/// The intersecting pairs of triangles of one mesh, or of two.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Intersections {
    /// Number of pairs.
    pub count: u64,
    /// The first of them in ascending order, as many as were asked for: the triangle in `a` and that in `b`; within
    /// one mesh, the lower index first.
    pub pairs: Vec<[u32; 2]>,
}

/// Triangles that one task tests. Fixed, so that the work is the same for any number of threads.
const CHUNK: usize = 64;

/// Counts the intersecting pairs between `a` and `b`, or within `a` without `b`, and lists the first `limit`.
///
/// Within one mesh, triangles that share a vertex count where the side opposite to it in one touches the other;
/// triangles that share an edge, where they have more than that edge in common (folded flat onto each other);
/// triangles with the same three corners always. Corners are shared by index: vertices at equal positions but
/// with different indices are a contact. A triangle without area is the segment or the point that it is.
///
/// # Errors
/// [`ErrorKind::InvalidMesh`]: a coordinate is not finite or an index is out of range, so that nothing can be verified.
pub fn intersections(a: &TriangleMesh, b: Option<&TriangleMesh>, limit: usize) -> Result<Intersections> {
    intersections_with_cancel(a, b, limit, &Cancel::new())
}

/// [`intersections`], with a cancellation token that is checked between chunks of triangles.
///
/// # Errors
/// As [`intersections`], and [`ErrorKind::Cancelled`].
pub fn intersections_with_cancel(
    a: &TriangleMesh,
    b: Option<&TriangleMesh>,
    limit: usize,
    cancel: &Cancel,
) -> Result<Intersections> {
    validate(a, "first mesh")?;
    if let Some(b) = b {
        validate(b, "second mesh")?;
    }
    let scale = Scale::of(a.positions.iter().chain(b.iter().flat_map(|b| &b.positions)));
    let (xa, xb) = (scale.apply(&a.positions), b.map(|b| scale.apply(&b.positions)));
    let boxes_a = bounds(&xa, &a.triangles);
    let boxes_b = b.zip(xb.as_ref()).map(|(b, xb)| bounds(xb, &b.triangles));
    let (points_b, triangles_b) = (xb.as_deref().unwrap_or(&xa), b.map_or(&a.triangles[..], |b| &b.triangles));
    let tree = Tree::new(boxes_b.as_deref().unwrap_or(&boxes_a));

    let partial: Result<Vec<Intersections>, Cancelled> = a
        .triangles
        .par_chunks(CHUNK)
        .enumerate()
        .map(|(chunk, triangles)| {
            cancel.check()?;
            let mut found = Intersections::default();
            let mut hits = Vec::new();
            for (s, i) in triangles.iter().zip(chunk * CHUNK..) {
                hits.clear();
                tree.for_each_overlap(&boxes_a[i], |j| {
                    let t = &triangles_b[j as usize];
                    let hit = if b.is_some() {
                        triangles::touch(corners(&xa, s), corners(points_b, t))
                    } else {
                        j as usize > i && triangles::touch_in_mesh(&xa, s, t)
                    };
                    if hit {
                        hits.push(j);
                    }
                });
                hits.sort_unstable();
                found.count += hits.len() as u64;
                let remaining = limit - found.pairs.len();
                found.pairs.extend(hits.iter().take(remaining).map(|&j| [i as u32, j]));
            }
            Ok(found)
        })
        .collect();

    let mut all = Intersections::default();
    for part in partial? {
        all.count += part.count;
        all.pairs.extend(part.pairs.into_iter().take(limit - all.pairs.len()));
    }
    Ok(all)
}

/// Those of `pairs` of triangles of one mesh that intersect, by the same rules as [`intersections`].
///
/// # Errors
/// As [`intersections`]; no index of a pair may be out of range.
pub fn intersecting(mesh: &TriangleMesh, pairs: &[[u32; 2]]) -> Result<Vec<[u32; 2]>> {
    validate(mesh, "mesh")?;
    let points = Scale::of(mesh.positions.iter()).apply(&mesh.positions);
    let triangle = |t: u32| &mesh.triangles[t as usize];
    let hit = |&[s, t]: &[u32; 2]| triangles::touch_in_mesh(&points, triangle(s), triangle(t));
    Ok(pairs.iter().copied().filter(hit).collect())
}

/// Refuses a mesh for which counts would be wrong or undefined. An empty mesh is fine: it intersects nothing.
fn validate(mesh: &TriangleMesh, name: &str) -> Result<()> {
    let fail = |message: String| Err(Error::new(ErrorKind::InvalidMesh, message));
    if let Some(v) = mesh.positions.iter().position(|p| !p.is_finite()) {
        return fail(format!("{name} to verify: vertex {v} is {}", mesh.positions[v]));
    }
    let count = mesh.positions.len();
    if let Some(t) = mesh.triangles.iter().position(|t| t.iter().any(|&v| v as usize >= count)) {
        return fail(format!("{name} to verify: triangle {t} has an index beyond its {count} vertices"));
    }
    Ok(())
}

#[inline]
fn corners(points: &[DVec3], triangle: &[u32; 3]) -> [DVec3; 3] {
    triangle.map(|v| points[v as usize])
}

fn bounds(points: &[DVec3], triangles: &[[u32; 3]]) -> Vec<Aabb> {
    triangles.iter().map(|t| Aabb::around(corners(points, t))).collect()
}

/// A multiplication by a power of two, in two factors since one may be out of range.
struct Scale([f64; 2]);

impl Scale {
    /// Brings the largest coordinate to about 2^300: its cube is still far from overflow.
    fn of<'a>(points: impl Iterator<Item = &'a DVec3>) -> Self {
        let largest = points.fold(0.0f64, |m, p| m.max(p.abs().max_element()));
        if largest == 0.0 {
            return Self([1.0, 1.0]);
        }
        // The exponent bits of subnormal numbers are zero: scale them first. 2^200 is exact.
        let (lifted, lift) = if largest < f64::MIN_POSITIVE { (largest * 2f64.powi(200), 200) } else { (largest, 0) };
        let exponent = (lifted.to_bits() >> 52) as i32 - 1023 - lift;
        let shift = 300 - exponent;
        Self([2f64.powi(shift / 2), 2f64.powi(shift - shift / 2)])
    }

    fn apply(&self, points: &[DVec3]) -> Vec<DVec3> {
        points.iter().map(|&p| p * self.0[0] * self.0[1]).collect()
    }
}
