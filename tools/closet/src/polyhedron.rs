//! Convex polyhedra, cut out of a box plane by plane: plates with bevelled edges, boulders and crystals.

use std::collections::{HashMap, HashSet};

use glam::DVec3;

use super::mesh::Mesh;
use super::random::Random;

/// A point this near to a plane (metres) lies on it.
const ON_PLANE: f64 = 1e-7;

/// Edges whose two faces turn by less than this (radians) need no bevel.
const FLAT: f64 = 0.2;

/// A plane face: its normal outwards and its corners, counter-clockwise from outside.
#[derive(Clone, Debug)]
struct Face {
    normal: DVec3,
    corners: Vec<usize>,
}

/// A convex solid with plane faces.
#[derive(Clone, Debug)]
pub struct Polyhedron {
    points: Vec<DVec3>,
    faces: Vec<Face>,
}

impl Polyhedron {
    /// A box around the origin with these half-axes in metres.
    pub fn cuboid(half: DVec3) -> Self {
        let signs = |c: usize| DVec3::from_array([0, 1, 2].map(|axis| if c >> axis & 1 == 1 { 1.0 } else { -1.0 }));
        let face = |normal, corners: [usize; 4]| Face { normal, corners: corners.to_vec() };
        let faces = vec![
            face(DVec3::NEG_X, [0, 4, 6, 2]),
            face(DVec3::X, [1, 3, 7, 5]),
            face(DVec3::NEG_Y, [0, 1, 5, 4]),
            face(DVec3::Y, [2, 6, 7, 3]),
            face(DVec3::NEG_Z, [0, 2, 3, 1]),
            face(DVec3::Z, [4, 5, 7, 6]),
        ];
        Self { points: (0..8).map(|c| half * signs(c)).collect(), faces }
    }

    /// A boulder around the origin: `faces` planes, spread evenly and shaken, that touch or cut an ellipsoid
    /// with these half-axes, and no farther out along them. With `even`, each plane has its mirror image across x = 0.
    pub fn boulder(radii: DVec3, faces: usize, even: bool, random: &mut Random) -> Self {
        let mut stone = Self::cuboid(radii);
        let golden = std::f64::consts::PI * (3.0 - 5f64.sqrt());
        let turn = std::f64::consts::PI * random.signed();
        for i in 0..faces {
            let z = 1.0 - (2.0 * i as f64 + 1.0) / faces as f64;
            let (sin, cos) = (turn + golden * i as f64).sin_cos();
            let ring = (1.0 - z * z).sqrt();
            let shake = DVec3::from_array([(); 3].map(|()| 0.22 * random.signed()));
            let normal = (DVec3::new(ring * cos, ring * sin, z) + shake).normalize();
            let offset = (0.92 + 0.08 * random.signed()) * (radii * normal).length();
            stone.cut(normal, offset);
            if even {
                stone.cut(normal * DVec3::new(-1.0, 1.0, 1.0), offset);
            }
        }
        stone
    }

    /// A crystal from the origin along z: six sides of about `radius`, the tip at `length`, the foot blunt.
    pub fn crystal(radius: f64, length: f64, random: &mut Random) -> Self {
        let mut crystal = Self::cuboid(DVec3::new(2.0 * radius, 2.0 * radius, length));
        let turn = std::f64::consts::PI * random.signed();
        for side in 0..6 {
            let (sin, cos) = (turn + side as f64 * std::f64::consts::FRAC_PI_3).sin_cos();
            // The sides open a little upwards; at two thirds of the length they turn in towards the tip.
            let wide = radius * (1.0 + 0.12 * random.signed());
            let spread = 0.35 * wide / (0.65 * length);
            crystal.cut(DVec3::new(cos, sin, -spread).normalize(), 0.65 * wide / spread.hypot(1.0));
            let slope = (1.0 + 0.1 * random.signed()) * wide / (0.35 * length);
            let tip = DVec3::new(cos, sin, slope).normalize();
            crystal.cut(tip, tip.z * length);
        }
        crystal.cut(DVec3::NEG_Z, 0.0);
        crystal
    }

    /// Takes away what lies beyond the plane of the points `p` with `normal . p = offset`.
    pub fn cut(&mut self, normal: DVec3, offset: f64) {
        let mut heights: Vec<f64> = self.points.iter().map(|p| normal.dot(*p) - offset).collect();
        for height in heights.iter_mut().filter(|height| height.abs() < ON_PLANE) {
            *height = 0.0;
        }
        let mut corners = self.faces.iter().flat_map(|face| &face.corners);
        if corners.clone().all(|&v| heights[v] <= 0.0) || corners.all(|&v| heights[v] >= 0.0) {
            return;
        }
        let mut crossings: HashMap<[usize; 2], usize> = HashMap::new();
        let mut faces = Vec::new();
        for face in &self.faces {
            let mut corners = Vec::new();
            for (i, &v) in face.corners.iter().enumerate() {
                let w = face.corners[(i + 1) % face.corners.len()];
                if heights[v] <= 0.0 {
                    corners.push(v);
                }
                if heights[v] * heights[w] < 0.0 {
                    // From the lower number to the higher, so that both faces find the same point.
                    let [a, b] = [v.min(w), v.max(w)];
                    corners.push(*crossings.entry([a, b]).or_insert_with(|| {
                        let t = heights[a] / (heights[a] - heights[b]);
                        self.points.push(self.points[a].lerp(self.points[b], t));
                        self.points.len() - 1
                    }));
                }
            }
            if corners.iter().any(|&v| heights.get(v).is_some_and(|&height| height < 0.0)) {
                faces.push(Face { normal: face.normal, corners });
            }
        }
        // The new face closes the sides that have lost their neighbour.
        let sides: HashSet<[usize; 2]> = faces.iter().flat_map(|face| sides(&face.corners)).collect();
        let open = faces.iter().flat_map(|face| sides_reversed(&face.corners));
        let next: HashMap<usize, usize> = open.filter(|side| !sides.contains(side)).map(|[v, w]| (v, w)).collect();
        let mut corners = Vec::new();
        if let Some(&first) = next.keys().min() {
            corners.push(first);
            let mut at = next[&first];
            while at != first && corners.len() < next.len() {
                corners.push(at);
                at = next[&at];
            }
        }
        faces.push(Face { normal, corners });
        self.faces = faces;
    }

    /// The same solid with its edges bevelled: `width` metres are taken from each face along each edge.
    pub fn bevelled(mut self, width: f64) -> Self {
        let mut owner = HashMap::new();
        for face in &self.faces {
            owner.extend(sides(&face.corners).into_iter().map(|side| (side, face.normal)));
        }
        let mut edges: Vec<_> = owner.iter().filter(|([v, w], _)| v < w).collect();
        edges.sort_unstable_by_key(|(side, _)| **side);
        let mut planes = Vec::new();
        for (&[v, w], &first) in edges {
            let Some(&second) = owner.get(&[w, v]) else { continue };
            if first.angle_between(second) > FLAT {
                let normal = (first + second).normalize();
                let depth = width * (0.5 * (1.0 - first.dot(second))).max(0.0).sqrt();
                planes.push((normal, normal.dot(self.points[v]) - depth));
            }
        }
        for (normal, offset) in planes {
            self.cut(normal, offset);
        }
        self
    }

    /// The same solid without edges shorter than `shortest` metres and without faces that give triangles much thinner
    /// than that: the ends of such an edge, or of such a face's shortest side, become one where it stays a solid.
    pub fn welded(mut self, shortest: f64) -> Self {
        loop {
            let mut worst: Vec<(f64, [usize; 2])> = Vec::new();
            for face in &self.faces {
                let thin = self.triangles(&face.corners).into_iter().any(|t| self.height(t) < 0.1 * shortest);
                let sides = sides(&face.corners).into_iter();
                worst.extend(sides.map(|side| (self.length(side), side)).filter(|side| thin || side.0 < shortest));
            }
            worst.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
            let Some(next) = worst.into_iter().find_map(|(_, side)| self.joined(side)) else { return self };
            self = next;
        }
    }

    fn length(&self, [v, w]: [usize; 2]) -> f64 {
        self.points[v].distance(self.points[w])
    }

    /// The height of a triangle over its longest side.
    fn height(&self, [a, b, c]: [usize; 3]) -> f64 {
        let longest = self.length([a, b]).max(self.length([b, c])).max(self.length([c, a]));
        let [a, b, c] = [a, b, c].map(|v| self.points[v]);
        (b - a).cross(c - a).length() / longest
    }

    /// The solid with the two ends of an edge as one; none if faces would touch along more than one edge.
    fn joined(&self, [v, w]: [usize; 2]) -> Option<Self> {
        let mut joined = self.clone();
        joined.points[v] = self.points[v].midpoint(self.points[w]);
        for face in &mut joined.faces {
            for corner in face.corners.iter_mut().filter(|corner| **corner == w) {
                *corner = v;
            }
            face.corners.dedup();
            if face.corners.first() == face.corners.last() {
                face.corners.pop();
            }
        }
        joined.faces.retain(|face| face.corners.len() > 2);
        let sound = joined.faces.iter().enumerate().all(|(i, face)| {
            let once = (1..face.corners.len()).all(|k| !face.corners[..k].contains(&face.corners[k]));
            once && joined.faces[..i].iter().all(|other| {
                let common: Vec<_> = face.corners.iter().filter(|v| other.corners.contains(v)).collect();
                let edge = || sides(&face.corners).iter().any(|side| common.iter().all(|v| side.contains(v)));
                common.len() < 2 || common.len() == 2 && edge()
            })
        });
        (sound && joined.faces.len() > 3).then_some(joined)
    }

    /// The surface in triangles.
    pub fn mesh(&self) -> Mesh {
        let mut number = HashMap::new();
        let mut mesh = Mesh::default();
        for face in &self.faces {
            for triangle in self.triangles(&face.corners) {
                mesh.triangles.push(triangle.map(|v| {
                    *number.entry(v).or_insert_with(|| {
                        mesh.positions.push(self.points[v]);
                        mesh.positions.len() as u32 - 1
                    })
                }));
            }
        }
        mesh
    }

    /// The triangulation of a face whose smallest angle is the largest.
    fn triangles(&self, corners: &[usize]) -> Vec<[usize; 3]> {
        let n = corners.len();
        let triangle = |i: usize, k: usize, j: usize| [corners[i], corners[k], corners[j]];
        // For the part between corner i and corner j: its smallest angle and where it is split.
        let mut best = vec![(f64::INFINITY, 0); n * n];
        for span in 2..n {
            for i in 0..n - span {
                let j = i + span;
                best[i * n + j].0 = f64::NEG_INFINITY;
                for k in i + 1..j {
                    let own = smallest_angle(triangle(i, k, j).map(|v| self.points[v]));
                    let angle = own.min(best[i * n + k].0).min(best[k * n + j].0);
                    if angle > best[i * n + j].0 {
                        best[i * n + j] = (angle, k);
                    }
                }
            }
        }
        let mut triangles = Vec::new();
        let mut parts = vec![(0, n - 1)];
        while let Some((i, j)) = parts.pop() {
            if j - i > 1 {
                let k = best[i * n + j].1;
                triangles.push(triangle(i, k, j));
                parts.extend([(i, k), (k, j)]);
            }
        }
        triangles
    }
}

/// The directed sides of a polygon.
fn sides(corners: &[usize]) -> Vec<[usize; 2]> {
    (0..corners.len()).map(|i| [corners[i], corners[(i + 1) % corners.len()]]).collect()
}

fn sides_reversed(corners: &[usize]) -> Vec<[usize; 2]> {
    sides(corners).into_iter().map(|[v, w]| [w, v]).collect()
}

fn smallest_angle([a, b, c]: [DVec3; 3]) -> f64 {
    let corner = |p: DVec3, q: DVec3, r: DVec3| (q - p).angle_between(r - p);
    corner(a, b, c).min(corner(b, c, a)).min(corner(c, a, b))
}
