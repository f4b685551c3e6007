//! A hat with its crown filled, through which the head goes that it was made for: so shallow below the filling that no start is found
//! with the head alone. Deeper ones need no second try.

use std::f64::consts::TAU;

use closet::mesh::Mesh;
use closet::rigs::{Body, Character, Naming, Role, character, y_up};
use glam::DVec3;

/// Vertices once around the hat.
const AROUND: u32 = 16;
/// The brim's height, from the head's joint to the top of the head, and its radius and the hat's height in radii of the head.
const BRIM: f64 = 0.7;
const WIDTH: f64 = 1.15;
const CROWN: f64 = 0.7;
/// Height of the filling, as a share.
const FILLING: f64 = 0.35;
/// Radius and height from the filling down the inner wall, over the brim and up to the crown, as shares.
const PROFILE: [[f64; 2]; 7] =
    [[0.94, FILLING], [0.96, 0.0], [1.0, 0.0], [1.0, 0.6], [0.9, 0.8], [0.5, 0.95], [0.1, 1.0]];

/// The hat, who wears it, and a body with a large head; no rig has a joint at the top of the head.
pub struct PiercedHat {
    /// On the source's joints.
    pub hat: Character,
    /// Whose head goes through it.
    pub source: Character,
    /// The body to dress.
    pub target: Character,
}

impl PiercedHat {
    /// Makes them.
    pub fn new() -> Self {
        let source = character(&Body::Mannequin.model(), Naming::Vrm).placed(y_up());
        let target = character(&Body::BigHead.model(), Naming::Vrm).placed(y_up());
        let head = source.joints.iter().find(|joint| joint.role == Role::Head).expect("a head").bind.translation.y;
        let points = &source.mesh.positions;
        let top = points.iter().map(|p| p.y).fold(head, f64::max);
        let skull: Vec<DVec3> = points.iter().copied().filter(|p| p.y > 0.5 * (head + top)).collect();
        let centre = skull.iter().sum::<DVec3>() / skull.len() as f64;
        let radius = skull.iter().map(|p| (p.x - centre.x).hypot(p.z - centre.z)).fold(0.0, f64::max);
        let mut mesh = Mesh::default();
        let height = |share: f64| head + BRIM * (top - head) + CROWN * radius * share;
        for [wide, high] in PROFILE {
            let y = height(high);
            let on_ring = |k: u32| {
                let (sin, cos) = (TAU * f64::from(k) / f64::from(AROUND)).sin_cos();
                let r = WIDTH * radius * wide;
                DVec3::new(centre.x + r * cos, y, centre.z + r * sin)
            };
            mesh.positions.extend((0..AROUND).map(on_ring));
        }
        for ring in 0..PROFILE.len() as u32 - 1 {
            for k in 0..AROUND {
                let [a, b] = [k, (k + 1) % AROUND].map(|k| ring * AROUND + k);
                mesh.triangles.extend([[a, a + AROUND, b], [b, a + AROUND, b + AROUND]]);
            }
        }
        // The middles of filling and crown.
        let middle = |share: f64| DVec3::new(centre.x, height(share), centre.z);
        mesh.positions.extend([middle(FILLING), middle(1.0)]);
        let rings = PROFILE.len() as u32;
        for k in 0..AROUND {
            let [a, b] = [k, (k + 1) % AROUND];
            let last = (rings - 1) * AROUND;
            mesh.triangles.extend([[rings * AROUND, a, b], [last + a, rings * AROUND + 1, last + b]]);
        }
        Self { hat: source.wears(&mesh), source, target }
    }
}

impl Default for PiercedHat {
    fn default() -> Self {
        Self::new()
    }
}
