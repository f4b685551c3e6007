//! Cuts a mesh open, or lays an edge path into it, along the zero set of a function.

use std::collections::HashMap;

use glam::DVec3;

use super::mesh::Mesh;

/// Keeps the part of `mesh` where `function` is negative. The vertices of the new boundary get the bit `mark` in
/// `marks` (one entry a vertex).
pub fn clip(mesh: &mut Mesh, marks: &mut Vec<u32>, mark: u32, function: &dyn Fn(DVec3) -> f64) {
    divide(mesh, marks, mark, function, None);
}

/// Splits the triangles along the zero set of `function`. The new vertices get the bit `mark` where `within` is true;
/// `seams` are the bits of the paths that exist already.
pub fn score(
    mesh: &mut Mesh,
    marks: &mut Vec<u32>,
    mark: u32,
    seams: u32,
    function: &dyn Fn(DVec3) -> f64,
    within: &dyn Fn(DVec3) -> bool,
) {
    divide(mesh, marks, mark, function, Some((seams, within)));
}

/// What [`score`] does with the paths that exist and where it marks; nothing for [`clip`].
type Score<'a> = Option<(u32, &'a dyn Fn(DVec3) -> bool)>;

fn divide(mesh: &mut Mesh, marks: &mut Vec<u32>, mark: u32, function: &dyn Fn(DVec3) -> f64, score: Score) {
    let mut values: Vec<f64> = mesh.positions.iter().map(|&p| function(p)).collect();
    let old = std::mem::take(&mut mesh.triangles);
    let boundary: HashMap<[u32; 2], bool> = {
        let whole = Mesh { positions: mesh.positions.clone(), triangles: old.clone() };
        whole.edges().iter().map(|edge| (edge.vertices, edge.is_boundary())).collect()
    };
    let mut crossings = HashMap::new();
    for triangle in old {
        let kept = triangle.map(|v| values[v as usize] < 0.0);
        let count = kept.iter().filter(|&&k| k).count();
        if count == 0 || count == 3 {
            if count == 3 || score.is_some() {
                mesh.triangles.push(triangle);
            }
            continue;
        }
        // Rotate so that the corner that differs from the other two comes first.
        let first = (0..3).find(|&i| kept[i] == (count == 1)).unwrap_or(0);
        let [a, b, c] = [0, 1, 2].map(|i| triangle[(first + i) % 3]);
        let mut crossing = |v: u32, w: u32| {
            let (v, w) = (v.min(w), v.max(w));
            *crossings.entry([v, w]).or_insert_with(|| {
                let (fv, fw) = (values[v as usize], values[w as usize]);
                let (p, q) = (mesh.positions[v as usize], mesh.positions[w as usize]);
                mesh.positions.push(p.lerp(q, (fv / (fv - fw)).clamp(0.0, 1.0)));
                values.push(0.0);
                let both = marks[v as usize] & marks[w as usize];
                let shared = if boundary[&[v, w]] { both } else { both & score.map_or(0, |(seams, _)| seams) };
                let here = mesh.positions[mesh.positions.len() - 1];
                marks.push(shared | if score.is_none_or(|(_, within)| within(here)) { mark } else { 0 });
                marks.len() as u32 - 1
            })
        };
        let (ab, ac) = (crossing(a, b), crossing(a, c));
        if count == 1 || score.is_some() {
            mesh.triangles.push([a, ab, ac]);
        }
        if count == 2 || score.is_some() {
            mesh.triangles.push([ab, b, c]);
            mesh.triangles.push([ab, c, ac]);
        }
    }
    let old = mesh.retain(|_| true);
    *marks = old.iter().map(|&v| marks[v as usize]).collect();
}
