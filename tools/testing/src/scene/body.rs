//! A body about a skeleton: a capsule around each bone, that passes through its neighbours at the joints, with bumps, open
//! ends, loose pieces, turned triangles, and triangles without area or given twice.

use bespoke::geometry::mesh::TriangleMesh;
use bespoke::input::skeleton::Skeleton;
use glam::DVec3;

use super::{below, between, chance, direction};
use crate::Random;

/// The body to dress and the one that the garment was designed on.
pub struct Bodies {
    pub on_target: TriangleMesh,
    pub on_source: TriangleMesh,
    /// The joint that moves each vertex of the target's body.
    pub joints: Vec<u32>,
    /// Thickness of each bone, bumps included, in the source's unit.
    pub source_radii: Vec<f64>,
}

struct Limb {
    radius: f64,
    bump: f64,
    waves: f64,
    sides: usize,
    rings: usize,
    open: bool,
    turned: bool,
}

impl Limb {
    fn random(random: &mut Random, radius: f64) -> Self {
        Self {
            radius,
            bump: between(random, 0.0, 0.2),
            waves: between(random, 1.0, 4.0).floor(),
            sides: 6 + below(random, 7),
            rings: 4 + below(random, 5),
            open: chance(random, 0.2),
            turned: chance(random, 0.15),
        }
    }

    /// Adds the capsule of `length` times the limb's unit around the bone from `a` to `b`.
    fn add(&self, mesh: &mut TriangleMesh, a: DVec3, b: DVec3, unit: f64) {
        let first = mesh.positions.len() as u32;
        let axis = (b - a).normalize();
        let (u, v) = axis.any_orthonormal_pair();
        let radius = self.radius * unit;
        let length = a.distance(b);
        let (rings, sides) = (self.rings as u32, self.sides as u32);
        // Ring by ring, half a circle of each cap in three.
        let profile = |k: u32| match k {
            0 => (-0.8, 0.6),
            1 => (-0.4, 0.9),
            k if k == rings + 2 => (0.4, 0.9),
            k if k == rings + 3 => (0.8, 0.6),
            _ => (0.0, 1.0),
        };
        for k in 0..rings + 4 {
            let (beyond, share) = profile(k);
            let inside = f64::from(k.clamp(2, rings + 1) - 2) / f64::from(rings - 1);
            for s in 0..sides {
                let angle = std::f64::consts::TAU * f64::from(s) / f64::from(sides);
                let bump = 1.0 + self.bump * (self.waves * angle + 9.0 * inside).sin();
                let around = angle.cos() * u + angle.sin() * v;
                mesh.positions.push(a + axis * (inside * length + beyond * radius) + around * (share * bump * radius));
            }
        }
        let mut push = |[a, b, c]: [u32; 3]| {
            let triangle = if self.turned { [a, c, b] } else { [a, b, c] };
            mesh.triangles.push(triangle.map(|v| first + v));
        };
        for k in 0..rings + 3 {
            for s in 0..sides {
                let [p, q] = [s, (s + 1) % sides].map(|s| k * sides + s);
                push([p, q, q + sides]);
                push([p, q + sides, p + sides]);
            }
        }
        if !self.open {
            let (low, high) = (sides * (rings + 4), sides * (rings + 4) + 1);
            for s in 0..sides {
                push([low, (s + 1) % sides, s]);
                push([high, sides * (rings + 3) + s, sides * (rings + 3) + (s + 1) % sides]);
            }
            mesh.positions.extend([a - axis * radius, b + axis * radius]);
        }
    }
}

impl Bodies {
    /// `thick` makes the limbs so thick that they run into each other.
    pub fn new(random: &mut Random, source: &Skeleton, target: &Skeleton, thick: bool) -> Self {
        let unit = size(target) / size(source);
        let mut bodies = Self {
            on_target: TriangleMesh::default(),
            on_source: TriangleMesh::default(),
            joints: Vec::new(),
            source_radii: Vec::new(),
        };
        for &bone in &source.bones {
            let radius = if thick { between(random, 0.2, 0.5) } else { between(random, 0.04, 0.12) };
            let limb = Limb::random(random, radius);
            let slim = Limb { radius: 0.7 * radius, ..limb };
            let ends = |s: &Skeleton| bone.map(|j| s.joints[j as usize]);
            let [a, b] = ends(target);
            let before = bodies.on_target.positions.len();
            limb.add(&mut bodies.on_target, a, b, unit);
            let nearer = |p: &DVec3| bone[usize::from(p.distance_squared(b) < p.distance_squared(a))];
            bodies.joints.extend(bodies.on_target.positions[before..].iter().map(nearer));
            let [a, b] = ends(source);
            slim.add(&mut bodies.on_source, a, b, 1.0);
            bodies.source_radii.push(radius * (1.0 + limb.bump));
        }
        if chance(random, 0.3) {
            bodies.add_piece(random, target, unit);
        }
        let triangles = &mut bodies.on_target.triangles;
        if chance(random, 0.2) {
            let again = triangles[below(random, triangles.len())];
            triangles.push(again);
        }
        if chance(random, 0.2) {
            let [a, b, _] = triangles[below(random, triangles.len())];
            triangles.push([a, b, a]);
        }
        bodies
    }

    /// A loose tetrahedron near the surface of a limb.
    fn add_piece(&mut self, random: &mut Random, target: &Skeleton, unit: f64) {
        let bone = below(random, target.bones.len());
        let [a, b] = target.bones[bone].map(|j| target.joints[j as usize]);
        let reach = self.source_radii[bone] * unit;
        let across = (b - a).normalize().cross(direction(random)).normalize();
        let place = a.lerp(b, between(random, 0.3, 0.7)) + across * reach * between(random, 0.8, 1.3);
        let first = self.on_target.positions.len() as u32;
        let corners = [[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]];
        self.on_target.positions.extend(corners.map(|c| place + 0.2 * reach * DVec3::from_array(c)));
        self.on_target.triangles.extend([[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]].map(|t| t.map(|v| first + v)));
        self.joints.extend([target.bones[bone][0]; 4]);
    }
}

/// The longest side of the joints' box, the unit in which the two skeletons are compared.
pub fn size(skeleton: &Skeleton) -> f64 {
    let low = skeleton.joints.iter().copied().reduce(DVec3::min).unwrap_or_default();
    let high = skeleton.joints.iter().copied().reduce(DVec3::max).unwrap_or_default();
    (high - low).max_element()
}
