//! What terms of their own would keep, which the library does not have: symmetry, and the size of openings.

use bespoke::geometry::closest_point::ClosestPoint;
use bespoke::geometry::mesh::{Topology, TriangleMesh};
use glam::DVec3;

/// The mean distance of the vertices, mirrored in the plane x = 0, from the surface.
pub fn asymmetry(mesh: &TriangleMesh) -> f64 {
    let surface = ClosestPoint::new(mesh);
    let sum: f64 = mesh.positions.iter().map(|&p| surface.distance(p * DVec3::new(-1.0, 1.0, 1.0))).sum();
    sum / mesh.positions.len().max(1) as f64
}

/// How much longer each boundary loop has become for how much the cloth beside it has grown, the root of the areas of
/// the triangles that touch it: 1 where both grow alike. The least and the greatest of the loops; none without a loop.
pub fn opening_growth(designed: &TriangleMesh, positions: &[DVec3]) -> Option<[f64; 2]> {
    let now = TriangleMesh { positions: positions.to_vec(), triangles: designed.triangles.clone() };
    let [area, area_now] = [designed, &now].map(TriangleMesh::areas);
    let growth = |curve: &[u32]| {
        let length = |mesh: &TriangleMesh| -> f64 {
            let next = curve.iter().cycle().skip(1);
            curve.iter().zip(next).map(|(&v, &w)| mesh.positions[v as usize].distance(mesh.positions[w as usize])).sum()
        };
        let touches = |t: &[u32; 3]| t.iter().any(|v| curve.contains(v));
        let beside = (0..).zip(&designed.triangles).filter(|(_, t)| touches(t)).map(|(k, _): (usize, _)| k);
        let (before, after) = beside.fold((0.0, 0.0), |(b, a), k| (b + area[k], a + area_now[k]));
        length(&now) / length(designed) / f64::sqrt(after / before)
    };
    let loops = Topology::new(designed.positions.len(), &designed.triangles).loops;
    let growths = loops.iter().map(|curve| growth(&curve.vertices));
    growths.fold(None, |range: Option<[f64; 2]>, growth| {
        let [least, most] = range.unwrap_or([growth; 2]);
        Some([least.min(growth), most.max(growth)])
    })
}
