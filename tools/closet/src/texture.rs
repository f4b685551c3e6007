//! Texture coordinates: unrolled cylinders beside each other, with seams where they meet and where they close.

use std::collections::HashMap;
use std::f64::consts::TAU;

use glam::DVec3;

use super::mesh::Mesh;

/// Texture coordinates with their own indices, since a vertex on a seam has several.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Texture {
    /// Coordinates from 0 to 1.
    pub coordinates: Vec<[f64; 2]>,
    /// For each triangle of the mesh the coordinates of its corners.
    pub triangles: Vec<[u32; 3]>,
}

/// A piece of cloth around an axis.
pub struct Panel<'a> {
    /// From a point to the angle around the axis (-pi to pi) and the length along it (metres).
    pub coordinates: Box<dyn Fn(DVec3) -> (f64, f64) + 'a>,
    /// Mean radius in metres: what an angle of 1 measures.
    pub radius: f64,
    /// Where the panel lies in the atlas, in metres.
    pub corner: [f64; 2],
    /// Angle and length at that corner.
    pub origin: [f64; 2],
}

/// Unrolls each triangle with the panel that `which` gives for its centre; scales all to the unit square.
pub fn unwrap(mesh: &Mesh, panels: &[Panel], which: &dyn Fn(DVec3) -> usize) -> Texture {
    let mut texture = Texture::default();
    let mut known: HashMap<(u32, usize, i64), u32> = HashMap::new();
    for (index, &triangle) in mesh.triangles.iter().enumerate() {
        let corners = mesh.corners(index as u32);
        let centre = (corners[0] + corners[1] + corners[2]) / 3.0;
        let number = which(centre);
        let panel = &panels[number];
        let (middle, _) = (panel.coordinates)(centre);
        let mut indices = [0; 3];
        for i in 0..3 {
            let (angle, length) = (panel.coordinates)(corners[i]);
            // Whole turns that bring the corner next to the centre: not zero only across the closing seam.
            let turns = ((middle - angle) / TAU).round();
            indices[i] = *known.entry((triangle[i], number, turns as i64)).or_insert_with(|| {
                let u = panel.corner[0] + panel.radius * (angle + turns * TAU - panel.origin[0]);
                let v = panel.corner[1] + length - panel.origin[1];
                texture.coordinates.push([u, v]);
                texture.coordinates.len() as u32 - 1
            });
        }
        texture.triangles.push(indices);
    }
    let (low, high) =
        texture.coordinates.iter().fold(([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]), |(low, high), c| {
            ([low[0].min(c[0]), low[1].min(c[1])], [high[0].max(c[0]), high[1].max(c[1])])
        });
    let scale = 1.0 / (high[0] - low[0]).max(high[1] - low[1]);
    for c in &mut texture.coordinates {
        *c = [(c[0] - low[0]) * scale, (c[1] - low[1]) * scale];
    }
    texture
}
