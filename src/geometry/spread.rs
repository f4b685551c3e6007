//! Points spread evenly over a surface by area, so that they do not depend on how it is cut into triangles.

use glam::DVec3;

use super::mesh::TriangleMesh;

/// About `wanted` points, each with a vertex of its triangle. A triangle without area has none.
pub fn spread(mesh: &TriangleMesh, wanted: usize) -> Vec<(DVec3, u32)> {
    let corners = |t: &[u32; 3]| t.map(|v| mesh.positions[v as usize]);
    let areas = mesh.areas();
    let step = areas.iter().sum::<f64>() / wanted as f64;
    let mut points = Vec::with_capacity(wanted);
    let mut passed = 0.5 * step;
    for (triangle, area) in mesh.triangles.iter().zip(areas) {
        passed += area;
        if passed < step || step == 0.0 {
            continue;
        }
        // Of a large triangle several, along the line from a corner to the middle of the side opposite to it.
        let [a, b, c] = corners(triangle);
        let count = (passed / step).floor();
        passed -= count * step;
        let count = count.min(16.0) as usize;
        for k in 0..count {
            let along = ((k as f64 + 0.5) / count as f64).sqrt();
            points.push((a.lerp(0.5 * (b + c), along), triangle[0]));
        }
    }
    points
}
