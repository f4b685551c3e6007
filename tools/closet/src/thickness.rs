//! Cloth with two faces: a garment modelled as the solid that it is, closed at cuffs, hem and collar.

use std::collections::HashMap;
use std::f64::consts::PI;

use glam::DVec3;

use super::mesh::Mesh;

/// How the two faces are joined at an opening.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rim {
    /// They share the edge of the opening.
    Fold,
    /// By a strip across the cloth.
    Strip,
    /// By a half-round of so many strips, at least two.
    Round(u32),
}

/// `mesh`, which is the outer face, with an inner one `thickness` below it; closed where every opening is. The vertices of the outer
/// face keep their indices, and its triangles theirs.
pub fn thickened(mesh: &Mesh, thickness: f64, rim: Rim) -> Mesh {
    let (normals, count) = (mesh.normals(), mesh.positions.len() as u32);
    let mut shell = mesh.clone();
    let below = |v: u32, depth: f64| mesh.positions[v as usize] - depth * normals[v as usize];
    let sides = |&[a, b, c]: &[u32; 3]| [[a, b], [b, c], [c, a]];
    let all: HashMap<[u32; 2], u32> =
        (0..).zip(&mesh.triangles).flat_map(|(t, corners)| sides(corners).map(|side| (side, t))).collect();
    let mut border: Vec<[u32; 2]> = all.keys().filter(|[a, b]| !all.contains_key(&[*b, *a])).copied().collect();
    border.sort_unstable();
    let mut inner: Vec<u32> = (count..2 * count).collect();
    shell.positions.extend((0..count).map(|v| below(v, thickness)));
    let rows = match rim {
        Rim::Fold => {
            border.iter().flatten().for_each(|&v| inner[v as usize] = v);
            0
        }
        Rim::Strip => 1,
        Rim::Round(rows) => rows,
    };
    shell.triangles.extend(mesh.triangles.iter().map(|t| t.map(|v| inner[v as usize])).map(|[a, b, c]| [a, c, b]));
    // Away from the cloth: the mean of both edges there.
    let mut away = HashMap::new();
    for &[a, b] in &border {
        let [p, q] = [a, b].map(|v| mesh.positions[v as usize]);
        for v in [a, b] {
            *away.entry(v).or_insert(DVec3::ZERO) += (q - p).cross(normals[v as usize]);
        }
    }
    let mut ring: HashMap<u32, u32> = border.iter().flatten().map(|&v| (v, v)).collect();
    for row in 1..=rows {
        let (sin, cos) = (PI * f64::from(row) / f64::from(rows)).sin_cos();
        let mut next: HashMap<u32, u32> = border.iter().flatten().map(|&v| (v, inner[v as usize])).collect();
        if row < rows {
            for &[v, _] in &border {
                let out = 0.5 * thickness * sin * away[&v].normalize_or_zero();
                next.insert(v, shell.positions.len() as u32);
                shell.positions.push(below(v, 0.5 * thickness * (1.0 - cos)) + out);
            }
        }
        for &[a, b] in &border {
            // The other way around than the triangle of the edge.
            shell.triangles.extend([[ring[&b], ring[&a], next[&a]], [ring[&b], next[&a], next[&b]]]);
        }
        ring = next;
    }
    if rim == Rim::Fold {
        // The inner copies of the border belong to no triangle.
        shell.retain(|_| true);
    }
    shell
}
