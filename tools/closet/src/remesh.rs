//! Isotropic remeshing: split long edges, collapse short ones, flip towards regular triangles, relax along the surface.

use std::collections::HashSet;

use glam::DVec3;

use super::mesh::{Edge, Mesh, NONE};

/// The surface that is meshed.
pub trait Surface {
    /// The wanted edge length at a point, in metres.
    fn edge_length(&self, point: DVec3) -> f64;

    /// The point of the surface near `point`; with one bit in `mark`, of that boundary curve of the surface.
    fn settle(&self, point: DVec3, mark: u32) -> DVec3;

    /// The bits of the curves that run inside the surface; the others are boundary curves.
    fn seams(&self) -> u32;
}

/// An edge is split above and collapsed below these multiples of the wanted length.
const LONG: f64 = 4.0 / 3.0;
const SHORT: f64 = 4.0 / 5.0;

/// Passes of collapses in one round.
const MOST_PASSES: usize = 8;

/// Cosine of the smallest angle that is accepted for the sake of regular vertices.
const SHARP: f64 = 0.92;

/// The triangles around each vertex, one after the other.
struct Stars {
    first: Vec<u32>,
    triangles: Vec<u32>,
}

impl Stars {
    fn new(mesh: &Mesh) -> Self {
        let mut first = vec![0; mesh.positions.len() + 1];
        for v in mesh.triangles.iter().flatten() {
            first[*v as usize + 1] += 1;
        }
        for v in 1..first.len() {
            first[v] += first[v - 1];
        }
        let mut next = first.clone();
        let mut triangles = vec![0; 3 * mesh.triangles.len()];
        for (index, triangle) in mesh.triangles.iter().enumerate() {
            for v in triangle {
                triangles[next[*v as usize] as usize] = index as u32;
                next[*v as usize] += 1;
            }
        }
        Self { first, triangles }
    }

    fn of(&self, v: u32) -> &[u32] {
        &self.triangles[self.first[v as usize] as usize..self.first[v as usize + 1] as usize]
    }
}

/// Remeshes in place, `rounds` times. `marks` holds for each vertex the boundary curves it lies on, one bit each;
/// a vertex with several bits is a corner and stays.
pub fn remesh(mesh: &mut Mesh, marks: &mut Vec<u32>, surface: &dyn Surface, rounds: usize) {
    for round in 0..rounds {
        split(mesh, marks, surface);
        for _ in 0..MOST_PASSES {
            if collapse(mesh, marks, surface) * 200 < mesh.positions.len() {
                break;
            }
        }
        for _ in 0..2 {
            flip(mesh, marks, surface.seams(), 2 * round < rounds);
        }
        relax(mesh, marks, surface, false);
        flip(mesh, marks, surface.seams(), 2 * round < rounds);
        relax(mesh, marks, surface, true);
    }
    flip(mesh, marks, surface.seams(), false);
    relax(mesh, marks, surface, true);
}

/// Splits every edge that is too long at its middle, all at once.
fn split(mesh: &mut Mesh, marks: &mut Vec<u32>, surface: &dyn Surface) {
    let wanted = wanted_lengths(mesh, surface);
    let mut middles = vec![[NONE; 3]; mesh.triangles.len()];
    for edge in mesh.edges() {
        let [v, w] = edge.vertices;
        let (p, q) = (mesh.positions[v as usize], mesh.positions[w as usize]);
        let middle = p.midpoint(q);
        if p.distance(q) <= LONG * f64::midpoint(wanted[v as usize], wanted[w as usize]) {
            continue;
        }
        let both = marks[v as usize] & marks[w as usize];
        let mark = if edge.is_boundary() { both } else { both & surface.seams() };
        let new = mesh.positions.len() as u32;
        mesh.positions.push(middle);
        marks.push(mark);
        for triangle in edge.triangles.into_iter().filter(|&t| t != NONE) {
            let opposite = mesh.triangles[triangle as usize].iter().position(|&u| u != v && u != w);
            middles[triangle as usize][opposite.unwrap_or(0)] = new;
        }
    }
    let old = std::mem::take(&mut mesh.triangles);
    for (triangle, middles) in old.into_iter().zip(middles) {
        let count = middles.iter().filter(|&&m| m != NONE).count();
        // Turn the triangle so that the odd corner (opposite the one split edge, or the one whole edge) is first.
        let first = match count {
            1 => middles.iter().position(|&m| m != NONE),
            2 => middles.iter().position(|&m| m == NONE),
            _ => Some(0),
        };
        let first = first.unwrap_or(0);
        let [a, b, c] = [0, 1, 2].map(|i| triangle[(first + i) % 3]);
        let [ma, mb, mc] = [0, 1, 2].map(|i| middles[(first + i) % 3]);
        match count {
            0 => mesh.triangles.push(triangle),
            1 => mesh.triangles.extend([[a, b, ma], [a, ma, c]]),
            2 => mesh.triangles.extend([[a, mc, mb], [mc, b, mb], [b, c, mb]]),
            _ => mesh.triangles.extend([[a, mc, mb], [mc, b, ma], [mb, ma, c], [ma, mb, mc]]),
        }
    }
}

/// How freely a vertex moves: inside (0), along a curve (1), not at all (2).
fn rank(curve: bool, mark: u32) -> u32 {
    if !curve { 0 } else { mark.count_ones().clamp(1, 2) }
}

fn boundary_vertices(edges: &[Edge], count: usize) -> Vec<bool> {
    let mut boundary = vec![false; count];
    for edge in edges.iter().filter(|edge| edge.is_boundary()) {
        for v in edge.vertices {
            boundary[v as usize] = true;
        }
    }
    boundary
}

/// The vertices on the boundary or on a seam.
fn curve_vertices(edges: &[Edge], marks: &[u32], seams: u32) -> Vec<bool> {
    let mut curve = boundary_vertices(edges, marks.len());
    for (curve, mark) in curve.iter_mut().zip(marks) {
        *curve |= mark & seams != 0;
    }
    curve
}

/// True for an edge of the boundary or of a seam.
fn on_curve(edge: &Edge, marks: &[u32], seams: u32) -> bool {
    let [v, w] = edge.vertices.map(|v| marks[v as usize]);
    edge.is_boundary() || v & w & seams != 0
}

/// The wanted edge length at each vertex.
fn wanted_lengths(mesh: &Mesh, surface: &dyn Surface) -> Vec<f64> {
    mesh.positions.iter().map(|&p| surface.edge_length(p)).collect()
}

/// Collapses edges that are too short, the shortest first, no two next to each other; returns how many.
fn collapse(mesh: &mut Mesh, marks: &mut Vec<u32>, surface: &dyn Surface) -> usize {
    let wanted = wanted_lengths(mesh, surface);
    let edges = mesh.edges();
    let curve = curve_vertices(&edges, marks, surface.seams());
    let stars = Stars::new(mesh);
    let mut short: Vec<(f64, usize)> = Vec::new();
    for (index, edge) in edges.iter().enumerate() {
        let [p, q] = edge.vertices.map(|v| mesh.positions[v as usize]);
        let [v, w] = edge.vertices.map(|v| wanted[v as usize]);
        let relative = p.distance(q) / f64::midpoint(v, w);
        if relative < SHORT {
            short.push((relative, index));
        }
    }
    short.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    let mut touched = vec![false; mesh.positions.len()];
    let mut rings = [Vec::new(), Vec::new()];
    for (_, index) in short {
        let edge = edges[index];
        let [mut keep, mut gone] = edge.vertices;
        let mut ranks = [keep, gone].map(|v| rank(curve[v as usize], marks[v as usize]));
        if ranks[1] > ranks[0] {
            (keep, gone) = (gone, keep);
            ranks.swap(0, 1);
        }
        let across = ranks[1] == 1 && !on_curve(&edge, marks, surface.seams());
        if touched[keep as usize] || touched[gone as usize] || ranks[1] == 2 || across {
            continue;
        }
        if ranks == [1, 1] && marks[keep as usize] != marks[gone as usize] {
            continue;
        }
        let target = if ranks[0] == ranks[1] {
            mesh.positions[keep as usize].midpoint(mesh.positions[gone as usize])
        } else {
            mesh.positions[keep as usize]
        };
        if !may_collapse(mesh, &stars, &wanted, [keep, gone], edge.is_boundary(), target, &mut rings) {
            continue;
        }
        mesh.positions[keep as usize] = target;
        for &triangle in stars.of(gone) {
            for v in &mut mesh.triangles[triangle as usize] {
                // The triangles around these vertices are not what they were.
                touched[*v as usize] = true;
                if *v == gone {
                    *v = keep;
                }
            }
        }
    }
    let before = mesh.positions.len();
    let old = mesh.retain(|&[a, b, c]| a != b && b != c && c != a);
    *marks = old.iter().map(|&v| marks[v as usize]).collect();
    before - old.len()
}

/// True where merging the two ends at `target` keeps the mesh manifold, turns no triangle over and makes no long
/// edge. `rings` is room for the neighbours of the two ends.
fn may_collapse(
    mesh: &Mesh,
    stars: &Stars,
    wanted: &[f64],
    ends: [u32; 2],
    boundary: bool,
    target: DVec3,
    rings: &mut [Vec<u32>; 2],
) -> bool {
    for (ring, v) in rings.iter_mut().zip(ends) {
        ring.clear();
        for &t in stars.of(v) {
            ring.extend(mesh.triangles[t as usize].iter().filter(|&&w| w != v));
        }
        ring.sort_unstable();
        ring.dedup();
    }
    let common = rings[1].iter().filter(|v| rings[0].binary_search(v).is_ok()).count();
    // The two ends count in each other's ring. Nothing smaller than an octahedron is made smaller.
    if common != if boundary { 1 } else { 2 } || rings[0].len() + rings[1].len() - common < 6 {
        return false;
    }
    for end in ends {
        for &t in stars.of(end) {
            let triangle = mesh.triangles[t as usize];
            if ends.iter().all(|v| triangle.contains(v)) {
                continue;
            }
            let old = mesh.corners(t);
            let new: [DVec3; 3] = std::array::from_fn(|i| if triangle[i] == end { target } else { old[i] });
            let (n0, n1) = (normal(old), normal(new));
            if n0.dot(n1) < 0.5 * n0.length() * n1.length() || n1.length() < 1e-9 {
                return false;
            }
            let too_long = |i: usize| {
                let k = (i + 1) % 3;
                let length = new[i].distance(new[k]);
                let [v, w] = [triangle[i], triangle[k]].map(|v| wanted[v as usize]);
                length > LONG * f64::midpoint(v, w) && length > old[i].distance(old[k])
            };
            if (0..3).any(too_long) {
                return false;
            }
        }
    }
    true
}

fn normal([a, b, c]: [DVec3; 3]) -> DVec3 {
    (b - a).cross(c - a)
}

/// The cosine of the smallest angle.
fn sharpest([a, b, c]: [DVec3; 3]) -> f64 {
    let [u, v, w] = [b - a, c - b, a - c].map(DVec3::normalize_or_zero);
    (-u.dot(w)).max(-u.dot(v)).max(-v.dot(w))
}

/// Flips edges: towards six triangles around each vertex (`regular`), or else towards larger smallest angles.
fn flip(mesh: &mut Mesh, marks: &[u32], seams: u32, regular: bool) {
    let edges = mesh.edges();
    let boundary = boundary_vertices(&edges, mesh.positions.len());
    let mut surplus: Vec<i32> = boundary.iter().map(|&b| if b { -4 } else { -6 }).collect();
    for edge in &edges {
        for v in edge.vertices {
            surplus[v as usize] += 1;
        }
    }
    let mut touched = vec![false; mesh.triangles.len()];
    let mut new_edges = HashSet::new();
    for edge in &edges {
        if edge.is_boundary() || edge.triangles.iter().any(|&t| touched[t as usize]) {
            continue;
        }
        let [t0, t1] = edge.triangles;
        let old = [mesh.triangles[t0 as usize], mesh.triangles[t1 as usize]];
        let Some(first) = old[0].iter().position(|v| !edge.vertices.contains(v)) else { continue };
        let Some(&d) = old[1].iter().find(|v| !edge.vertices.contains(v)) else { continue };
        let [c, a, b] = [0, 1, 2].map(|i| old[0][(first + i) % 3]);
        // An edge of a seam stays, unless it cuts off a corner of the seam: the seam goes along the two other sides.
        let cuts_off = |corner: u32| {
            let [p, q, r] = [corner, a, b].map(|v| mesh.positions[v as usize]);
            marks[corner as usize] & marks[a as usize] & marks[b as usize] & seams != 0 && (q - p).dot(r - p) < 0.0
        };
        let stays = on_curve(edge, marks, seams) && !cuts_off(c) && !cuts_off(d);
        if stays || marks[c as usize] & marks[d as usize] & seams != 0 {
            continue;
        }
        let key = [c.min(d), c.max(d)];
        if c == d || new_edges.contains(&key) || edges.binary_search_by(|other| other.vertices.cmp(&key)).is_ok() {
            continue;
        }
        if surplus[a as usize] <= -2 || surplus[b as usize] <= -2 {
            continue;
        }
        let new = [[c, a, d], [c, d, b]];
        let corners = |t: [u32; 3]| t.map(|v| mesh.positions[v as usize]);
        let before = old.map(|t| normal(corners(t)).normalize_or_zero());
        let after = new.map(|t| normal(corners(t)).normalize_or_zero());
        let mean = before[0] + before[1];
        if before[0].dot(before[1]) < 0.3 || after.iter().any(|n| n.dot(mean) < 0.5 * mean.length()) {
            continue;
        }
        let cosine = |[t0, t1]: [[u32; 3]; 2]| sharpest(corners(t0)).max(sharpest(corners(t1)));
        let square = |v: u32, change: i32| (surplus[v as usize] + change).pow(2);
        let cost = |change: i32| square(a, -change) + square(b, -change) + square(c, change) + square(d, change);
        let better = if regular { cost(1) < cost(0) && cosine(new) < SHARP } else { cosine(new) < cosine(old) - 0.005 };
        if !better {
            continue;
        }
        for (v, change) in [(a, -1), (b, -1), (c, 1), (d, 1)] {
            surplus[v as usize] += change;
        }
        new_edges.insert(key);
        for (t, triangle) in edge.triangles.into_iter().zip(new) {
            touched[t as usize] = true;
            mesh.triangles[t as usize] = triangle;
        }
    }
}

/// Moves each vertex towards the middle of its neighbours, along the surface or along its curve; `settle`
/// brings it back onto them, which costs more than the move.
fn relax(mesh: &mut Mesh, marks: &[u32], surface: &dyn Surface, settle: bool) {
    const STEP: f64 = 0.6;
    let edges = mesh.edges();
    let curve = curve_vertices(&edges, marks, surface.seams());
    let normals = mesh.normals();
    let mut sum = vec![DVec3::ZERO; mesh.positions.len()];
    let mut weight = vec![0.0; mesh.positions.len()];
    for edge in &edges {
        for [v, w] in [edge.vertices, [edge.vertices[1], edge.vertices[0]]] {
            if !curve[v as usize] || on_curve(edge, marks, surface.seams()) {
                sum[v as usize] += mesh.positions[w as usize];
                weight[v as usize] += 1.0;
            }
        }
    }
    for v in 0..mesh.positions.len() {
        // The end of a seam stays too.
        let end = marks[v] & surface.seams() != 0 && weight[v] != 2.0;
        if end || rank(curve[v], marks[v]) == 2 {
            continue;
        }
        let position = mesh.positions[v];
        let mut step = STEP * (sum[v] / weight[v] - position);
        if !curve[v] {
            step -= normals[v] * step.dot(normals[v]);
        }
        mesh.positions[v] = if settle { surface.settle(position + step, marks[v]) } else { position + step };
    }
}
