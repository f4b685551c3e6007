//! Distances from points to many triangles, by brute force over those nearby, and winding numbers.

use std::collections::HashMap;

use glam::{DVec3, IVec3};

use closet::mesh::Mesh;

const CELL: f64 = 0.04;

/// Triangles in a grid.
pub struct Triangles<'a> {
    mesh: &'a Mesh,
    selected: Vec<u32>,
    cells: HashMap<IVec3, Vec<u32>>,
}

impl<'a> Triangles<'a> {
    /// The triangles of `mesh` that `select` accepts.
    pub fn new(mesh: &'a Mesh, select: impl Fn(u32) -> bool) -> Self {
        let selected: Vec<u32> = (0..mesh.triangles.len() as u32).filter(|&t| select(t)).collect();
        let mut cells: HashMap<IVec3, Vec<u32>> = HashMap::new();
        for &t in &selected {
            let [a, b, c] = mesh.corners(t);
            for cell in between(a.min(b).min(c), a.max(b).max(c)) {
                cells.entry(cell).or_default().push(t);
            }
        }
        Self { mesh, selected, cells }
    }

    /// The distance of `point`, or infinity beyond `reach`.
    pub fn distance(&self, point: DVec3, reach: f64) -> f64 {
        self.distance_unless(point, reach, |_| false)
    }

    /// The distance of `point` to the triangles that `skip` leaves, or infinity beyond `reach`.
    pub fn distance_unless(&self, point: DVec3, reach: f64, skip: impl Fn(&[u32; 3]) -> bool) -> f64 {
        let mut nearest = f64::INFINITY;
        for cell in between(point - reach, point + reach) {
            for &t in self.cells.get(&cell).into_iter().flatten() {
                if !skip(&self.mesh.triangles[t as usize]) {
                    nearest = nearest.min(to_triangle(point, self.mesh.corners(t)));
                }
            }
        }
        if nearest <= reach { nearest } else { f64::INFINITY }
    }

    /// How often the (closed) surface goes around `point`: the sum of the solid angles (van Oosterom and Strackee).
    pub fn winding_number(&self, point: DVec3) -> f64 {
        let angle = |&t: &u32| {
            let [a, b, c] = self.mesh.corners(t).map(|corner| corner - point);
            let (la, lb, lc) = (a.length(), b.length(), c.length());
            let denominator = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
            2.0 * a.dot(b.cross(c)).atan2(denominator)
        };
        self.selected.iter().map(angle).sum::<f64>() / (4.0 * std::f64::consts::PI)
    }
}

fn between(low: DVec3, high: DVec3) -> impl Iterator<Item = IVec3> {
    let (low, high) = ((low / CELL).floor().as_ivec3(), (high / CELL).floor().as_ivec3());
    (low.z..=high.z)
        .flat_map(move |z| (low.y..=high.y).flat_map(move |y| (low.x..=high.x).map(move |x| IVec3::new(x, y, z))))
}

/// The foot of the perpendicular if it is inside, else the nearest point of the three sides.
fn to_triangle(point: DVec3, [a, b, c]: [DVec3; 3]) -> f64 {
    let normal = (b - a).cross(c - a).normalize_or_zero();
    let inside = [(a, b), (b, c), (c, a)].iter().all(|&(p, q)| (q - p).cross(point - p).dot(normal) >= 0.0);
    if inside && normal != DVec3::ZERO {
        return (point - a).dot(normal).abs();
    }
    let to_side = |p: DVec3, q: DVec3| {
        let d = q - p;
        let t = ((point - p).dot(d) / d.length_squared().max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
        point.distance(p + t * d)
    };
    to_side(a, b).min(to_side(b, c)).min(to_side(c, a))
}
